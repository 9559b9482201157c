#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {

/// A height or coordinate, m, among places that spread over `spread`, with so many digits that they differ
/// however far from zero they lie: "432.14". `digits`: significant ones of the spread, or of a smaller value.
inline std::string place_text(double value, double spread, int digits = 3) {
  CUPOLA_ASSERT(spread > 0.0);
  constexpr double kLeast = 0.01;  // of the spread: digits of smaller values are not counted
  const double scale = std::clamp(std::abs(value), kLeast * spread, spread);
  const int decimals = std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(scale))));
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (decimals > 0) text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

}  // namespace cupola
