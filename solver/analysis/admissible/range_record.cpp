#include "solver/analysis/admissible/range_record.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "assembly/files/number_text.hpp"

namespace cupola {
namespace {

const char* const kRangeTable =
    "quantity,unit,min,max,min_bound,max_bound,chosen,min_outcome,max_outcome,min_frame,max_frame,block_a,"
    "block_b\n";

}  // namespace

std::string ranges_csv(const std::vector<ForceRange>& ranges) {
  const auto number = [](const auto& value) {
    return value ? fmt::format("{:.17g}", *value) : std::string();
  };
  const auto frame = [](const std::optional<int>& value) { return value ? std::to_string(*value) : ""; };
  const auto block = [](const auto& joint, int side) {
    return joint ? std::to_string(side == 0 ? joint->first : joint->second) : std::string();
  };
  std::string csv = kRangeTable;
  for (const ForceRange& r : ranges)
    csv += fmt::format("\"{}\",{},{},{},{},{},{},{},{},{},{},{},{}\n", r.quantity, r.unit,
                       number(r.min.value), number(r.max.value), number(r.min.bound), number(r.max.bound),
                       number(r.chosen), to_string(r.min.outcome), to_string(r.max.outcome),
                       frame(r.min.frame), frame(r.max.frame), block(r.joint, 0), block(r.joint, 1));
  return csv;
}

std::string describe(const std::vector<ForceRange>& ranges) {
  const ForceRange& r = ranges.front();
  const auto end = [&r](const RangeEnd& e) {
    if (e.outcome == RangeOutcome::unbounded) return std::string("without limit");
    if (!e.value) return std::string("unknown");
    return r.unit == "N" ? readable_force(*e.value) : fmt::format("{:.5g} {}", *e.value, r.unit);
  };
  std::string text =
      fmt::format("an admissible state exists, which says nothing about the history; {}: {} ... {}",
                  r.quantity, end(r.min), end(r.max));
  if (r.chosen)
    text += fmt::format(", chosen by the compliances {}", end({RangeOutcome::bounded, r.chosen, {}, {}}));
  const auto unknown = std::count_if(ranges.begin(), ranges.end(), [](const ForceRange& range) {
    return range.min.outcome == RangeOutcome::unconverged || range.max.outcome == RangeOutcome::unconverged;
  });
  if (unknown > 0) text += fmt::format("; {} of {} ranges are incomplete", unknown, ranges.size());
  return text;
}

}  // namespace cupola
