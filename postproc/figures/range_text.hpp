#pragma once

#include <string>

#include "assembly/model/results.hpp"

namespace cupola {

/// The unit in which the values of a range are read: N, kN or MN by its largest value, m, or "" for ratios.
struct RangeUnit {
  double per_si = 1.0;
  std::string name;
  std::string after_blank() const { return name.empty() ? "" : " " + name; }
};
RangeUnit range_unit(const ForceRange& range);

/// The quantity in words: "outward thrust", "share of the ribs".
std::string range_name(const ForceRange& range);

/// A value of the range in that unit, to four digits; up to 1e-6 of its largest value it is 0.
std::string range_number(double value, const ForceRange& range);

/// "12.1 to 40 MN", or "40 MN" where both ends read alike: with ∞ where there is no limit, ? behind an end
/// whose search did not end, and "unknown" where it found no state.
std::string range_ends(const ForceRange& range);

}  // namespace cupola
