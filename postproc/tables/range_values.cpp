#include "postproc/tables/range_values.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double value_of(const RangeEnd& end, double unbounded) {
  if (end.outcome == RangeOutcome::unbounded) return unbounded;
  return end.value.value_or(kNone);
}

/// A cell; none if it is empty or infinite.
std::optional<double> number_in(const CsvFile& csv, size_t row, const std::string& column) {
  const double value = csv.number(row, csv.column(column));
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

RangeEnd end_in(const CsvFile& csv, size_t row, const std::string& end) {
  const std::string& outcome = csv.rows[row][csv.column(end + "_outcome")];
  const auto named = enum_from_name<RangeOutcome>(outcome);
  if (!named)
    throw InputError(FileLocation{csv.path, static_cast<int>(row) + 2, 0},
                     fmt::format("{}_outcome = `{}`: must be one of {}", end, outcome,
                                 fmt::join(names_of<RangeOutcome>(), ", ")));
  RangeEnd out{*named, number_in(csv, row, end), number_in(csv, row, end + "_bound"), {}};
  if (const auto frame = number_in(csv, row, end + "_frame"); frame && *frame >= 0.0)
    out.frame = static_cast<int>(*frame);
  return out;
}

/// The name of a column: lower case, words joined by underscores, unit last. Numbers keep their signs and
/// points, minus_0p5, so that each direction has a name of its own.
std::string range_key(const std::string& quantity, const std::string& value, const std::string& unit) {
  const std::string text = quantity + " " + value;
  const auto is_in = [](int (*kind)(int), char c) { return kind(static_cast<unsigned char>(c)) != 0; };
  std::string key;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool after_word = i > 0 && is_in(std::isalnum, text[i - 1]),
               in_number = i + 1 < text.size() && is_in(std::isdigit, text[i + 1]);
    if (is_in(std::isalnum, c))
      key += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (c == '.' && after_word && in_number)
      key += 'p';
    else if (!key.empty() && key.back() != '_')
      key += '_';
    if (c == '-' && !after_word && in_number) key += "minus_";
  }
  return unit.empty() ? key : key + "_" + unit;
}

}  // namespace

double least(const ForceRange& range) {
  return value_of(range.min, -std::numeric_limits<double>::infinity());
}

double greatest(const ForceRange& range) {
  return value_of(range.max, std::numeric_limits<double>::infinity());
}

bool has_chosen(const std::vector<ForceRange>& ranges) {
  return std::any_of(ranges.begin(), ranges.end(),
                     [](const ForceRange& range) { return range.chosen.has_value(); });
}

double size_of(const ForceRange& range) {
  double size = 0.0;
  for (const std::optional<double>& value : {range.min.value, range.chosen, range.max.value})
    if (value && std::isfinite(*value)) size = std::max(size, std::abs(*value));
  return size;
}

double relative_range(const ForceRange& range) {
  for (const RangeEnd* end : {&range.min, &range.max})
    if (end->outcome == RangeOutcome::unbounded) return std::numeric_limits<double>::infinity();
  for (const RangeEnd* end : {&range.min, &range.max})
    if (end->outcome != RangeOutcome::bounded || !end->value) return kNone;
  const double mean = 0.5 * std::abs(*range.max.value + *range.min.value);
  return mean > 0.0 ? (*range.max.value - *range.min.value) / mean : kNone;
}

double margin_of(const ForceRange& range) {
  for (const RangeEnd* end : {&range.min, &range.max})
    if (end->outcome != RangeOutcome::bounded || !end->value) return kNone;
  const double width = *range.max.value - *range.min.value;
  if (!range.chosen || !(width > 0.0)) return kNone;
  return std::min(*range.chosen - *range.min.value, *range.max.value - *range.chosen) / width;
}

std::vector<double> relative_ranges(const std::vector<ForceRange>& ranges,
                                    const std::vector<JointWrench>& joints) {
  std::map<std::pair<int, int>, double> of_joint;
  for (const ForceRange& range : ranges)
    if (range.joint) of_joint.emplace(*range.joint, relative_range(range));
  std::vector<double> values;
  if (of_joint.empty()) return values;
  for (const JointWrench& joint : joints) {
    const auto found = of_joint.find(std::minmax({joint.block_a, joint.block_b}));
    values.push_back(found == of_joint.end() ? std::nan("") : found->second);
  }
  return values;
}

const ForceRange* range_named(const std::string& quantity, const std::vector<ForceRange>& ranges) {
  const auto found = std::find_if(ranges.begin(), ranges.end(),
                                  [&quantity](const ForceRange& r) { return r.quantity == quantity; });
  return found == ranges.end() ? nullptr : &*found;
}

std::vector<ForceRange> read_ranges(const CsvFile& csv) {
  std::vector<ForceRange> ranges;
  for (size_t row = 0; row < csv.rows.size(); ++row) {
    ForceRange& range = ranges.emplace_back();
    range.quantity = csv.rows[row][csv.column("quantity")];
    range.unit = csv.rows[row][csv.column("unit")];
    range.min = end_in(csv, row, "min");
    range.max = end_in(csv, row, "max");
    range.chosen = number_in(csv, row, "chosen");
    const auto a = number_in(csv, row, "block_a"), b = number_in(csv, row, "block_b");
    if (a && b && *a >= 0.0) range.joint = std::pair{static_cast<int>(*a), static_cast<int>(*b)};
  }
  return ranges;
}

std::vector<ForceRange> quantities_of(const std::vector<std::vector<ForceRange>>& runs) {
  std::vector<ForceRange> all;
  for (const std::vector<ForceRange>& ranges : runs)
    for (const ForceRange& range : ranges)
      if (range_named(range.quantity, all) == nullptr) all.push_back(range);
  return all;
}

void add_range_columns(const std::vector<std::vector<ForceRange>>& runs, Table* table) {
  CUPOLA_ASSERT(runs.size() == table->rows.size());
  for (const ForceRange& quantity : quantities_of(runs)) {
    for (const char* value : {"min", "chosen", "max"})
      table->columns.push_back({range_key(quantity.quantity, value, quantity.unit), quantity.unit,
                                fmt::format("{}: {} over all admissible states", quantity.quantity, value)});
    for (size_t i = 0; i < runs.size(); ++i) {
      const ForceRange* range = range_named(quantity.quantity, runs[i]);
      const std::initializer_list<Table::Cell> cells = {range ? least(*range) : kNone,
                                                        range ? range->chosen.value_or(kNone) : kNone,
                                                        range ? greatest(*range) : kNone};
      table->rows[i].insert(table->rows[i].end(), cells);
    }
  }
}

}  // namespace cupola
