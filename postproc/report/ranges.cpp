#include "postproc/report/ranges.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "postproc/figures/range_text.hpp"
#include "postproc/report/html.hpp"
#include "postproc/report/loads_text.hpp"
#include "postproc/tables/range_values.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {
namespace {

/// Share of the largest value up to which an end and its bound are one number, and a range is one value.
constexpr double kSame = 1e-3;

bool is_bounded(const RangeEnd& end) {
  return end.outcome == RangeOutcome::bounded && end.value.has_value();
}

/// The limit that is proven: the value attained, or the bound where it differs visibly.
double limit(const RangeEnd& end, const ForceRange& range) {
  const double bound = end.bound.value_or(*end.value);
  return std::abs(bound - *end.value) <= kSame * size_of(range) ? *end.value : bound;
}

std::string with_unit(double value, const ForceRange& range) {
  return range_number(value, range) + range_unit(range).after_blank();
}

/// Where the quantity certainly lies; "" if neither end is bounded.
std::string certain_clause(const ForceRange& range) {
  if (range.min.outcome == RangeOutcome::undefined)
    return "is undefined: in every state it is a ratio to nothing";
  const std::string whatever = " for every history of the building that the friction admits";
  const bool low = is_bounded(range.min), high = is_bounded(range.max);
  if (low && high) {
    const double from = limit(range.min, range), to = limit(range.max, range);
    if (to - from <= kSame * size_of(range))
      return fmt::format("is {}{}, to within {:g} %", with_unit(0.5 * (from + to), range), whatever,
                         100.0 * kSame);
    return fmt::format("lies between {} and {}{}", range_number(from, range), with_unit(to, range), whatever);
  }
  if (low) return "is at least " + with_unit(limit(range.min, range), range) + whatever;
  if (high) return "is at most " + with_unit(limit(range.max, range), range) + whatever;
  return "";
}

/// Why an end is no limit, or how far the states found fall short of the limit.
std::string end_clause(const RangeEnd& end, bool is_min, const ForceRange& range) {
  const char* name = is_min ? "minimum" : "maximum";
  if (end.outcome == RangeOutcome::unbounded)
    return fmt::format("has no {}: {} {} it without limit", name,
                       range.unit == "N" ? "self-stresses that need no load, as in a jammed wedge,"
                                         : "states in which its denominator vanishes",
                       is_min ? "lower" : "raise");
  if (end.outcome == RangeOutcome::undefined) return "";
  if (!is_bounded(end)) {
    std::string text = fmt::format("has an unknown {}, because the search did not converge", name);
    if (end.value) text += fmt::format(" beyond a state with {}", with_unit(*end.value, range));
    return text;
  }
  if (limit(end, range) == *end.value) return "";
  return fmt::format("attains {} in the state found for the {}", with_unit(*end.value, range), name);
}

/// "; the compliances of this case choose 20 MN"; "" without a chosen state.
std::string chosen_clause(const ForceRange& range) {
  if (!range.chosen) return "";
  std::string text = "; the compliances of this case choose " + with_unit(*range.chosen, range);
  const double slack = kSame * size_of(range);
  const bool below = is_bounded(range.min) && *range.chosen < limit(range.min, range) - slack;
  const bool above = is_bounded(range.max) && *range.chosen > limit(range.max, range) + slack;
  return below || above
             ? text + ", outside the range: their forces are in error, or their contact points differ"
             : text;
}

Table display_table(const std::vector<ForceRange>& ranges) {
  Table table{
      "",
      "",
      {{"", "", "Quantity"}, {"", "", "Minimum"}, {"", "", "Chosen"}, {"", "", "Maximum"}, {"", "", "Unit"}},
      {}};
  for (const ForceRange& range : ranges) {
    const auto cell = [&range](double value, RangeOutcome outcome) {
      std::string text = std::isinf(value)   ? (value > 0.0 ? "∞" : "-∞")
                         : std::isnan(value) ? ""
                                             : range_number(value, range);
      return Table::Cell(outcome == RangeOutcome::unconverged ? text + "?" : text);
    };
    table.rows.push_back({range_name(range), cell(least(range), range.min.outcome),
                          range.chosen ? range_number(*range.chosen, range) : std::string("none"),
                          cell(greatest(range), range.max.outcome), range_unit(range).name});
  }
  return table;
}

}  // namespace

std::string range_sentence(const ForceRange& range) {
  std::vector<std::string> clauses;
  for (std::string clause :
       {certain_clause(range), end_clause(range.min, true, range), end_clause(range.max, false, range)})
    if (!clause.empty()) clauses.push_back((clauses.empty() ? "" : "it ") + std::move(clause));
  return fmt::format("The {} {}{}.", range_name(range), fmt::join(clauses, "; "), chosen_clause(range));
}

std::vector<std::string> range_conditions(const Evaluation& e) {
  std::vector<std::string> out;
  out.push_back(fmt::format(
      "The limits are certain: every force state in which these blocks can stand lies inside them, "
      "whatever the order of construction, the settlement of the supports or the stiffness of the joints. "
      "They hold for forces of up to 1000 times the largest of the states found. The shape of the blocks, "
      "their rigidity, their loads and {} are assumed.",
      friction_text(e.scene.joints)));
  if (has_chosen(e.summary.ranges))
    out.push_back(
        "The chosen value belongs to one state of the range, which the compliances of the joints select: "
        "other compliances, another order of construction or a settlement select another.");
  if (stands(e.summary.status))
    out.push_back(
        "That it stands means that an admissible state exists. It does not mean that the history of the "
        "building led to one.");
  out.push_back(
      "All friction laws admit the same forces, and the ranges hold for each of them. Under the associated "
      "law blocks with an admissible state stand; under Coulomb's law they may still fall.");
  return out;
}

std::string ranges_section(const Evaluation& e, const std::string& picture) {
  const std::vector<ForceRange>& ranges = e.summary.ranges;
  if (ranges.empty()) return "";
  constexpr size_t kMostRows = 30;  // ranges.csv holds all
  const auto last = ranges.begin() + static_cast<std::ptrdiff_t>(std::min(ranges.size(), kMostRows));
  const std::vector<ForceRange> shown(ranges.begin(), last);
  std::string out = "<h2>Ranges over all admissible states</h2>\n" + html_table(display_table(shown));
  if (shown.size() < ranges.size())
    out += fmt::format(
        "<p>The first {} of {} quantities; all are in <a href=\"ranges.csv\">ranges.csv</a>.</p>\n",
        shown.size(), ranges.size());
  out += picture + "<ul>\n";
  for (const ForceRange& range : shown) out += "<li>" + html_text(range_sentence(range)) + "</li>\n";
  out += "</ul>\n";
  for (const std::string& condition : range_conditions(e)) out += "<p>" + html_text(condition) + "</p>\n";
  return out;
}

}  // namespace cupola
