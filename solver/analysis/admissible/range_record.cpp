#include "solver/analysis/admissible/range_record.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "assembly/files/csv_columns.hpp"
#include "assembly/files/number_text.hpp"

namespace cupola {
namespace {

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.17g}", *value) : "";
}
std::string number(const std::optional<int>& value) {
  return value ? std::to_string(*value) : "";
}

constexpr CsvColumn<ForceRange> kRangeColumns[] = {
    {"quantity", [](const ForceRange& r) { return r.quantity; }},
    {"unit", [](const ForceRange& r) { return r.unit; }},
    {"min", [](const ForceRange& r) { return number(r.min.value); }},
    {"max", [](const ForceRange& r) { return number(r.max.value); }},
    {"min_bound", [](const ForceRange& r) { return number(r.min.bound); }},
    {"max_bound", [](const ForceRange& r) { return number(r.max.bound); }},
    {"chosen", [](const ForceRange& r) { return number(r.chosen); }},
    {"min_outcome", [](const ForceRange& r) { return to_string(r.min.outcome); }},
    {"max_outcome", [](const ForceRange& r) { return to_string(r.max.outcome); }},
    {"min_frame", [](const ForceRange& r) { return number(r.min.frame); }},
    {"max_frame", [](const ForceRange& r) { return number(r.max.frame); }},
    {"block_a", [](const ForceRange& r) { return r.joint ? std::to_string(r.joint->first) : ""; }},
    {"block_b", [](const ForceRange& r) { return r.joint ? std::to_string(r.joint->second) : ""; }},
};

}  // namespace

std::string ranges_csv(const std::vector<ForceRange>& ranges) {
  std::string csv = csv_header(kRangeColumns) + "\n";
  for (const ForceRange& range : ranges) csv += csv_row(kRangeColumns, range) + "\n";
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
