#include "assembly/case/key_places.hpp"

#include <string_view>

#include "assembly/case/case_node.hpp"

namespace cupola {

InputError with_place_of_key(const InputError& error, const Case& scene) {
  constexpr std::string_view kWithoutPlace = "error: ";
  std::string_view message = error.what();
  if (!scene.keys || !message.starts_with(kWithoutPlace)) return error;
  message.remove_prefix(kWithoutPlace.size());
  const std::string_view key =
      message.substr(0, message.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789.[]"));
  const bool is_key = key.find('.') != std::string_view::npos || message.substr(key.size()).starts_with(":");
  if (!is_key || !scene.keys->find(key.substr(0, key.find_first_of(".[")))) return error;
  return {place_of(*scene.keys, key), std::string(message)};
}

}  // namespace cupola
