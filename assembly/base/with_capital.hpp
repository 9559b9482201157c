#pragma once

#include <cctype>
#include <string>

namespace cupola {

/// The text with a capital first letter.
inline std::string with_capital(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace cupola
