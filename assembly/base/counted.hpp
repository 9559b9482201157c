#pragma once

#include <string>
#include <string_view>

namespace cupola {

/// A count with its noun: "1 block", "3 blocks". `plural` is for nouns that take more than an s: "2 bodies".
template <class Integer>
std::string counted(Integer count, std::string_view noun, std::string_view plural = "") {
  const bool one = count == Integer{1};
  std::string text = std::to_string(count) + " ";
  text += one || plural.empty() ? noun : plural;
  return one || !plural.empty() ? text : text + "s";
}

}  // namespace cupola
