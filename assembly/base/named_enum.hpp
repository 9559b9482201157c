#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assembly/base/error.hpp"

namespace cupola {

/// An enumeration whose values have names, used in case files, results and messages alike. The names are
/// listed once, beside the enumeration and in the order of its values, which count from 0:
///
///     enum class Status { stable, moving };
///     constexpr auto enum_names(Status) { return std::array{"stable", "moving"}; }
template <class E>
concept NamedEnum = requires(E value) {
  enum_names(value);
};

template <NamedEnum E>
std::string to_string(E value) {
  constexpr auto names = enum_names(E{});
  const auto index = static_cast<std::size_t>(value);
  CUPOLA_ASSERT(index < names.size());
  return names[index];
}

/// All names of an enumeration, in the order of its values.
template <NamedEnum E>
std::vector<std::string> names_of() {
  constexpr auto names = enum_names(E{});
  return {names.begin(), names.end()};
}

/// The value with this name; none if there is no such value.
template <NamedEnum E>
std::optional<E> enum_from_name(std::string_view name) {
  constexpr auto names = enum_names(E{});
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<E>(found - names.begin());
}

}  // namespace cupola
