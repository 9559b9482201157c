#include "postproc/studies/ensemble_results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/files/number_text.hpp"
#include "postproc/studies/saltelli.hpp"
#include "postproc/studies/sweep.hpp"

namespace cupola {
namespace {

constexpr const char* kNotShown = "No difference shown. ";
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::vector<double> column_of_numbers(const Table& table, size_t column) {
  std::vector<double> values;
  for (const auto& row : table.rows) {
    double value = kNone;
    if (const double* number = std::get_if<double>(&row[column]))
      value = *number;
    else if (double read = 0.0; read_number(to_display(row[column]), &read).empty())
      value = read;
    values.push_back(value);
  }
  return values;
}

void add_estimate(const IntervalEstimate& estimate, std::vector<Table::Cell>* row) {
  for (const double value : {estimate.value, estimate.interval ? estimate.interval->low : kNone,
                             estimate.interval ? estimate.interval->high : kNone})
    row->emplace_back(std::isfinite(value) ? value : kNone);
}

void add_estimate_columns(const std::string& key, const std::string& meaning, Table* table) {
  table->columns.push_back({key, "", meaning});
  table->columns.push_back({key + "_low", "", meaning + ", 95 % low"});
  table->columns.push_back({key + "_high", "", meaning + ", 95 % high"});
}

/// A number of a sentence.
std::string short_number(double value) {
  return fmt::format("{:.4g}", value);
}

/// A sentence about one difference; the headline is whether the interval contains zero.
std::string difference_sentence(const std::string& pair, const std::string& what, const IntervalEstimate& d) {
  if (!d.interval) return fmt::format("{}: {} differs by {} in the mean.", pair, what, short_number(d.value));
  const std::string numbers = fmt::format("{} ({} to {})", short_number(d.value),
                                          short_number(d.interval->low), short_number(d.interval->high));
  return d.interval->contains(0.0) ? fmt::format("{}{}: {} differs by {}.", kNotShown, pair, what, numbers)
                                   : fmt::format("{}: {} differs by {}.", pair, what, numbers);
}

/// Whether one of them is more sensitive; "" where the members do not tell.
std::string scatter_sentence(const IntervalEstimate& ratio) {
  if (!ratio.interval) return {};
  return fmt::format(" {}elative to their size, values of the first scatter {} times as much ({} to {}).",
                     ratio.interval->contains(1.0) ? "No difference of scatter shown: r" : "R",
                     short_number(ratio.value), short_number(ratio.interval->low),
                     short_number(ratio.interval->high));
}

/// The mean difference of a result. There is none where a member falls, or stands, throughout its bracket: the
/// mean of the other pairs would leave out the largest differences.
void add_difference(const EnsembleResults& a, const EnsembleResults& b, size_t in_a, size_t in_b,
                    Table* table, std::vector<std::string>* sentences) {
  const std::string pair = a.name + " less " + b.name, &key = a.members.columns[in_a].key;
  DrawnValues difference = a.values(in_a);
  const DrawnValues other = b.values(in_b);
  int pairs = 0, infinite = 0;
  double first = 0.0, second = 0.0;
  for (size_t i = 0; i < difference.values.size(); ++i) {
    const double value = difference.values[i], size = std::abs(value) + std::abs(other.values[i]);
    infinite += std::isinf(size);
    difference.values[i] = std::isfinite(size) ? value - other.values[i] : kNone;
    if (!std::isfinite(size)) continue;
    ++pairs;
    first += value;
    second += other.values[i];
  }
  if (infinite > 0) {
    table->rows.push_back({pair, key, pairs});
    table->rows.back().resize(table->columns.size(), kNone);
    sentences->push_back(fmt::format(
        "{}: {} has no mean difference: in {} of {} a member falls, or stands, throughout its bracket.", pair,
        key, infinite, counted(pairs + infinite, "pair")));
  }
  if (infinite > 0 || pairs == 0) return;
  const IntervalEstimate mean = mean_of(difference);
  std::vector<Table::Cell> row = {pair, key, pairs, first / pairs, second / pairs};
  const IntervalEstimate scatter = scatter_ratio(a.values(in_a), other);
  add_estimate(mean, &row);
  add_estimate(scatter, &row);
  row.emplace_back(kNone);
  table->rows.push_back(std::move(row));
  sentences->push_back(difference_sentence(pair, key, mean) + scatter_sentence(scatter));
}

/// Rows for one pair of ensembles of the same samples.
void add_pair(const EnsembleResults& a, const EnsembleResults& b, Table* table,
              std::vector<std::string>* sentences) {
  const std::string pair = a.name + " less " + b.name;
  const auto share = [](int count, int of) { return static_cast<double>(count) / of; };
  int in_a = 0, in_b = 0, only_a = 0, only_b = 0, both = 0;
  for (size_t i = 0; i < a.falls.size(); ++i) {
    if (a.falls[i] < 0 || b.falls[i] < 0) continue;
    ++both;
    in_a += a.falls[i];
    in_b += b.falls[i];
    only_a += a.falls[i] > b.falls[i];
    only_b += a.falls[i] < b.falls[i];
  }
  const bool limits = a.critical_column() || b.critical_column();
  if (!limits && (a.some_fall() || b.some_fall()) && both > 0) {
    const double p = mcnemar(only_a, only_b);
    table->rows.push_back({pair, std::string("falls"), both, share(in_a, both), share(in_b, both),
                           share(only_a - only_b, both), kNone, kNone, kNone, kNone, kNone, p});
    sentences->push_back(fmt::format(
        "{}{} and {}: of {} with a verdict in both, {} fall in the first only and {} in the second only "
        "(exact McNemar test: p = {:.2g}).",
        p > 0.05 ? kNotShown : "", a.name, b.name, counted(both, "member"), only_a, only_b, p));
  }
  for (const size_t column : a.results)
    if (const auto other = b.result_named(a.members.columns[column].key))
      add_difference(a, b, column, *other, table, sentences);
}

/// How far the members of a limit analysis stand.
std::string critical_sentence(const EnsembleResults& ensemble, size_t column) {
  const DrawnValues drawn = ensemble.values(column);
  const std::string unit =
      ensemble.members.columns[column].unit.empty() ? "" : " " + ensemble.members.columns[column].unit;
  if (!ensemble.censored())
    return fmt::format(
        "{}: critical value {}{} in the median; 5 % of the members lie below {}, 5 % above {}.",
        ensemble.name, short_number(quantile_of(drawn, 0.5).value), unit,
        short_number(quantile_of(drawn, 0.05).value), short_number(quantile_of(drawn, 0.95).value));
  int without[2] = {0, 0};  // a critical value: that stand, that fall
  for (const std::optional<bool>& stands : ensemble.throughout)
    if (stands) ++without[*stands ? 0 : 1];
  const auto text = [&](double p) {
    const double value = quantile_of(drawn, p).value;
    if (std::isfinite(value)) return short_number(value) + unit;
    return std::string(value < 0.0 ? "below the bracket" : "above the bracket");
  };
  std::vector<std::string> parts;
  if (without[1] > 0) parts.push_back(counted(without[1], "falls", "fall"));
  if (without[0] > 0) parts.push_back(counted(without[0], "stands", "stand"));
  const std::string ended = fmt::format("{}: of {} {} throughout the bracket.", ensemble.name,
                                        counted(drawn.values.size(), "member"), fmt::join(parts, " and "));
  if (std::ranges::none_of(drawn.values, [](double v) { return std::isfinite(v); })) return ended;
  return ended + fmt::format(
                     " With them, the 5 % quantile of the critical value is {}, the median {}, the 95 % "
                     "quantile {}.",
                     text(0.05), text(0.5), text(0.95));
}

}  // namespace

int EnsembleResults::replicates() const {
  if (!runs->design) return 0;
  return *runs->design == Ensemble::Design::monte_carlo ? static_cast<int>(runs->runs.size())
                                                        : Ensemble::kReplicates;
}

DrawnValues EnsembleResults::values(size_t column, size_t count) const {
  std::vector<double> all = column_of_numbers(members, column);
  if (column == critical_column())
    for (size_t i = 0; i < all.size(); ++i)
      if (throughout[i])
        all[i] = std::copysign(std::numeric_limits<double>::infinity(),
                               *throughout[i] == more_is_safer ? 1.0 : -1.0);
  if (count >= all.size()) return {std::move(all), replicates()};
  all.resize(count);
  return {std::move(all), independent() ? static_cast<int>(count) : 0};
}

std::optional<size_t> EnsembleResults::result_named(const std::string& key) const {
  for (const size_t column : results)
    if (members.columns[column].key == key) return column;
  return {};
}

std::optional<size_t> EnsembleResults::critical_column() const {
  const size_t k = members.column_named("critical_value");
  const auto is_number = [](double v) { return std::isfinite(v); };
  const auto is_known = [](const std::optional<bool>& stands) { return stands.has_value(); };
  if (std::ranges::any_of(column_of_numbers(members, k), is_number) ||
      std::ranges::any_of(throughout, is_known))
    return k;
  return {};
}

bool EnsembleResults::censored() const {
  const std::optional<size_t> critical = critical_column();
  return critical && std::ranges::any_of(values(*critical).values, [](double v) { return std::isinf(v); });
}

bool EnsembleResults::some_fall() const {
  const auto moves = [](const std::optional<bool>& stands) { return stands == false; };
  return std::ranges::count(falls, 1) > 0 || std::ranges::any_of(throughout, moves);
}

IntervalEstimate EnsembleResults::probability(size_t count) const {
  const auto end = falls.begin() + static_cast<std::ptrdiff_t>(std::min(count, falls.size()));
  const int n = static_cast<int>(end - falls.begin());
  const int fall = static_cast<int>(std::count(falls.begin(), end, 1));
  const int unknown = static_cast<int>(std::count(falls.begin(), end, -1));
  if (n == unknown) return {kNone, {}};
  IntervalEstimate estimate{static_cast<double>(fall) / (n - unknown), {}};
  // A member without a verdict may stand or fall.
  if (independent())
    estimate.interval = {clopper_pearson(fall, n).low, clopper_pearson(fall + unknown, n).high};
  return estimate;
}

EnsembleResults results_of(const SampledRuns& ensemble, const std::string& runs_folder) {
  EnsembleResults out{
      ensemble.name, &ensemble, sweep_table(ensemble.samples.keys, ensemble.runs, runs_folder), {}};
  out.members.name = ensemble.name;
  out.members.title = "The members of the ensemble";
  out.falls = falls_of(out.members);
  out.throughout = stands_throughout(out.members);
  out.more_is_safer = more_is_safer(ensemble.runs, runs_folder);
  return out;
}

void find_results(std::vector<EnsembleResults>* ensembles) {
  std::set<std::string> varying;
  for (const EnsembleResults& one : *ensembles)
    for (const size_t column : varying_columns(one.members)) varying.insert(one.members.columns[column].key);
  for (EnsembleResults& one : *ensembles) {
    const std::optional<size_t> critical = one.critical_column();
    one.results.clear();
    for (size_t column = 0; column < one.members.columns.size(); ++column) {
      const auto is_number = [&](const auto& row) { return std::holds_alternative<double>(row[column]); };
      if (critical ? column == *critical
                   : varying.contains(one.members.columns[column].key) &&
                         std::ranges::any_of(one.members.rows, is_number))
        one.results.push_back(column);
    }
  }
}

std::string result_sentence(const EnsembleResults& ensemble) {
  if (const auto column = ensemble.critical_column())
    return fmt::format("{} Verdicts: {}.", critical_sentence(ensemble, *column), endings(ensemble.members));
  const auto count = [&ensemble](int verdict) { return std::ranges::count(ensemble.falls, verdict); };
  std::string text =
      fmt::format("{}: {} of {} fall", ensemble.name, count(1), counted(ensemble.falls.size(), "member"));
  if (count(-1) > 0) text += fmt::format(", {} without a verdict", count(-1));
  const IntervalEstimate p = ensemble.probability(ensemble.falls.size());
  if (!p.interval) return text + ".";
  return text + fmt::format(": probability {:.3g} % ({:.3g} to {:.3g} %).", 100.0 * p.value,
                            100.0 * p.interval->low, 100.0 * p.interval->high);
}

Table statistics_table(const EnsembleResults& ensemble) {
  Table t{ensemble.name + "_statistics", "Statistics of the results", {}, {}};
  t.columns = {{"result", "", "Result"}, {"unit", "", "Unit"}, {"members", "", "Members"}};
  add_estimate_columns("mean", "Mean", &t);
  t.columns.push_back({"deviation", "", "Standard deviation"});
  for (const auto& [key, p] : {std::pair("q05", "5 % quantile"), {"q50", "Median"}, {"q95", "95 % quantile"}})
    add_estimate_columns(key, p, &t);
  for (const size_t column : ensemble.results) {
    const DrawnValues drawn = ensemble.values(column);
    const auto known = std::ranges::count_if(drawn.values, [](double v) { return std::isfinite(v); });
    const bool bounded = std::ranges::none_of(drawn.values, [](double v) { return std::isinf(v); });
    std::vector<Table::Cell> row = {ensemble.members.columns[column].key,
                                    ensemble.members.columns[column].unit, static_cast<int>(known)};
    add_estimate(bounded ? mean_of(drawn) : IntervalEstimate{kNone, {}}, &row);
    row.emplace_back(bounded ? deviation_of(drawn.values) : kNone);
    for (const double p : {0.05, 0.5, 0.95}) add_estimate(quantile_of(drawn, p), &row);
    t.rows.push_back(std::move(row));
  }
  return t;
}

namespace {

/// The table of a Saltelli design, of which every result of a member counts.
Table sobol_table(const EnsembleResults& ensemble, const SaltelliDesign& design) {
  Table t{ensemble.name + "_inputs", "What the inputs explain", {}, {}};
  t.columns = {{"input", "", "Input"}, {"result", "", "Result"}};
  add_estimate_columns("first_order_index", "First-order Sobol index", &t);
  add_estimate_columns("total_index", "Total Sobol index", &t);
  for (size_t input = 0; input < ensemble.runs->samples.keys.size(); ++input)
    for (const size_t column : ensemble.results) {
      const SobolIndices indices = sobol_indices(design, input, ensemble.values(column).values);
      std::vector<Table::Cell> row = {ensemble.runs->samples.keys[input],
                                      ensemble.members.columns[column].key};
      add_estimate(indices.first_order, &row);
      add_estimate(indices.total, &row);
      t.rows.push_back(std::move(row));
    }
  return t;
}

}  // namespace

Table inputs_table(const EnsembleResults& ensemble) {
  if (const auto design = saltelli_design(ensemble.runs->samples)) return sobol_table(ensemble, *design);
  Table t{ensemble.name + "_inputs", "What the inputs explain", {}, {}};
  t.columns = {{"input", "", "Input"},
               {"result", "", "Result"},
               {"rank_correlation", "", "Rank correlation"},
               {"first_order_index", "", "First-order Sobol index"},
               {"noise", "", "Noise: two standard errors of the index of an input without influence"}};
  const size_t status = ensemble.members.column_named("status");
  for (size_t input = 1; input < status; ++input) {
    if (ensemble.members.columns[input].key.ends_with("seed")) continue;  // their order means nothing
    const std::vector<double> x = column_of_numbers(ensemble.members, input);
    for (const size_t column : ensemble.results) {
      const std::vector<double> y = ensemble.values(column).values;
      std::vector<double> known_x, known_y;
      for (size_t i = 0; i < x.size(); ++i)
        if (std::isfinite(x[i]) && !std::isnan(y[i])) {
          known_x.push_back(x[i]);
          known_y.push_back(y[i]);
        }
      if (known_x.size() < 3 || std::set(known_x.begin(), known_x.end()).size() < 3) continue;
      t.rows.push_back({ensemble.members.columns[input].key, ensemble.members.columns[column].key,
                        rank_correlation(known_x, known_y), first_order_index(known_x, known_y),
                        2.0 / std::sqrt(static_cast<double>(known_x.size()))});
    }
  }
  return t;
}

Table ends_table(const EnsembleResults& ensemble) {
  constexpr size_t kEach = 3;
  Table t{ensemble.name + "_ends", "Members at the ends", {}, {}};
  t.columns = {{"why", "", "Why"}, {"value", "", "Value"}};
  const auto& columns = ensemble.members.columns;
  const size_t status = ensemble.members.column_named("status"),
               verdict = ensemble.members.column_named("verdict");
  t.columns.insert(t.columns.end(), columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(status));
  t.columns.push_back(columns[verdict]);
  const auto add = [&](const std::string& why, const Table::Cell& value, size_t member) {
    std::vector<Table::Cell> row = {why, value};
    const auto& cells = ensemble.members.rows[member];
    row.insert(row.end(), cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(status));
    row.push_back(cells[verdict]);
    t.rows.push_back(std::move(row));
  };
  size_t fallen = 0;
  for (size_t i = 0; i < ensemble.falls.size() && fallen < kEach; ++i)
    if (ensemble.falls[i] == 1) add("falls", std::string(), i), ++fallen;
  for (const size_t column : ensemble.results) {
    const std::vector<double> values = column_of_numbers(ensemble.members, column);
    std::vector<size_t> order;
    for (size_t i = 0; i < values.size(); ++i)
      if (std::isfinite(values[i])) order.push_back(i);
    std::ranges::stable_sort(order, {}, [&values](size_t i) { return values[i]; });
    const std::string& key = ensemble.members.columns[column].key;
    for (size_t i = 0; i < std::min(kEach, order.size()); ++i)
      add("smallest " + key, values[order[i]], order[i]);
    for (size_t i = 0; i < std::min(kEach, order.size()); ++i)
      add("largest " + key, values[order[order.size() - 1 - i]], order[order.size() - 1 - i]);
  }
  return t;
}

Table differences_table(const std::vector<EnsembleResults>& ensembles, std::vector<std::string>* sentences) {
  Table t{"differences", "Differences between ensembles, member by member", {}, {}};
  t.columns = {{"pair", "", "Pair"},
               {"result", "", "Result"},
               {"pairs", "", "Pairs of members"},
               {"first", "", "Mean of the first"},
               {"second", "", "Mean of the second"}};
  add_estimate_columns("difference", "Mean difference", &t);
  add_estimate_columns("scatter_ratio", "Relative scatter of the first over that of the second", &t);
  t.columns.push_back({"mcnemar_p", "", "p of the exact McNemar test"});
  for (size_t a = 0; a < ensembles.size(); ++a)
    for (size_t b = a + 1; b < ensembles.size(); ++b)
      if (ensembles[a].runs->samples == ensembles[b].runs->samples)
        add_pair(ensembles[a], ensembles[b], &t, sentences);
  std::stable_partition(sentences->begin(), sentences->end(),
                        [](const std::string& s) { return !s.starts_with(kNotShown); });
  return t;
}

}  // namespace cupola
