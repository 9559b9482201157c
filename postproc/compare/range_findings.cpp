#include "postproc/compare/range_findings.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "postproc/figures/range_text.hpp"
#include "postproc/tables/range_values.hpp"

namespace cupola {
std::vector<std::vector<ForceRange>> ranges_of(const std::vector<PostSummary>& runs) {
  std::vector<std::vector<ForceRange>> ranges;
  for (const PostSummary& run : runs) ranges.push_back(run.ranges);
  return ranges;
}

std::vector<std::string> range_findings(const std::vector<PostSummary>& runs,
                                        const std::vector<std::string>& labels) {
  std::vector<std::string> sentences;
  for (const ForceRange& quantity : quantities_of(ranges_of(runs))) {
    std::vector<std::string> ranges;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    double narrowest = kInfinity, next = kInfinity;
    std::string where;
    for (size_t i = 0; i < runs.size(); ++i) {
      const ForceRange* range = range_named(quantity.quantity, runs[i].ranges);
      if (range == nullptr) continue;
      ranges.push_back(fmt::format("{} in {}", range_ends(*range), labels[i]));
      const double width = greatest(*range) - least(*range);
      if (width < narrowest) {
        next = narrowest;
        narrowest = width;
        where = labels[i];
      } else if (width < next) {
        next = width;
      }
    }
    if (ranges.size() < 2) continue;
    constexpr double kEqual = 1e-3;  // relative difference up to which widths are called equal
    if (std::isfinite(next) && next - narrowest <= kEqual * next) where.clear();
    sentences.push_back(fmt::format("The range of the {} over all admissible states is {}{}.",
                                    range_name(quantity), fmt::join(ranges, ", "),
                                    where.empty() ? "" : fmt::format(": narrowest in {}", where)));
  }
  return sentences;
}

void add_range_rows(const std::vector<PostSummary>& runs, Table* table) {
  for (const ForceRange& quantity : quantities_of(ranges_of(runs))) {
    std::vector<Table::Cell> row{
        fmt::format("Between which values the {} lies, whatever the history.", range_name(quantity))};
    for (const PostSummary& run : runs) {
      const ForceRange* range = range_named(quantity.quantity, run.ranges);
      row.emplace_back(range ? range_ends(*range) : std::string("-"));
    }
    table->rows.push_back(std::move(row));
  }
}

}  // namespace cupola
