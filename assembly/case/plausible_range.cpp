#include "assembly/case/plausible_range.hpp"

#include <fmt/format.h>

namespace cupola {

std::vector<std::string> sentences(const std::vector<PlausibleRange>& ranges) {
  std::vector<std::string> out;
  for (const PlausibleRange& r : ranges) {
    if (r.value >= r.low && r.value <= r.high) continue;
    const bool one_sided = r.low == kNoLowerEnd || r.low == 0.0;
    const std::string unit = r.unit.empty() ? "" : " " + r.unit;
    out.push_back(fmt::format("{} = {:g}{}: {}{:g}{} expected; {}", r.key, r.value, unit,
                              one_sided ? "at most " : fmt::format("{:g} to ", r.low), r.high, unit,
                              r.value < r.low ? r.if_low : r.if_high));
  }
  return out;
}

}  // namespace cupola
