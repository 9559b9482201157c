#pragma once

#include <limits>
#include <string>
#include <vector>

namespace cupola {

/// A value and the range in which it is expected. The ranges are wider than those of built masonry, so that
/// only mistakes fall outside: confused units differ by factors of 10 and more.
struct PlausibleRange {
  std::string key;  ///< to Section::expect(): below its section; with a blank in front: of the section
  double value;
  std::string unit;  ///< "" for ratios
  double low;        ///< minus infinity: no lower end
  double high;
  std::string if_low, if_high;  ///< the likely cause, with what to write instead
};

/// A sentence for each value outside its range: key, value, unit, range and likely cause.
std::vector<std::string> sentences(const std::vector<PlausibleRange>& ranges);

inline constexpr double kNoLowerEnd = -std::numeric_limits<double>::infinity();
inline constexpr const char* kMillimetres = "in millimetres? Lengths are in m";
inline constexpr const char* kKilometres = "in kilometres? Lengths are in m";
inline constexpr const char* kRadians = "in radians? Keys that end in _deg are in degrees";

}  // namespace cupola
