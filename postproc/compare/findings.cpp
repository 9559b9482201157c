#include "postproc/compare/reading.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace cupola {
namespace {

using Values = std::vector<std::optional<double>>;

std::optional<double> least_safety(const PostSummary& s) {
  if (s.thrust_lines.empty()) return std::nullopt;
  double least = std::numeric_limits<double>::infinity();
  for (const PostSummary::Line& line : s.thrust_lines) least = std::min(least, line.least_geometric_safety);
  return least;
}

/// The smaller the better.
double badness(const Measure& measure, double value) {
  switch (measure.best) {
    case Measure::Best::lowest:
      return value;
    case Measure::Best::highest:
      return -value;
    case Measure::Best::nearest_one:
      return std::abs(std::log(value));
  }
  return value;
}

bool is_negligible(const Measure& measure, const PostSummary& run, double value) {
  return measure.noise && std::abs(value) <= measure.noise(run);
}

/// "..., most even in A, by a factor of 3.7", or that there is nothing to choose.
std::string conclusion(const Measure& measure, const Values& values, const std::vector<PostSummary>& runs,
                       const std::vector<std::string>& labels) {
  constexpr double kSame = 1e-3;  // numbers that differ by less are read as equal
  std::vector<size_t> order;
  for (size_t i = 0; i < values.size(); ++i)
    if (values[i]) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](size_t i, size_t j) {
    return badness(measure, *values[i]) < badness(measure, *values[j]);
  });
  const double best = *values[order[0]], next = *values[order[1]];
  const bool best_is_noise = is_negligible(measure, runs[order[0]], best);
  if (best_is_noise && is_negligible(measure, runs[order[1]], next)) return "the best two are negligible";
  if (best == next || std::abs(best - next) <= kSame * std::max(std::abs(best), std::abs(next)))
    return "the best two are equal within 0.1 %";
  std::string text = measure.superlative + " in " + labels[order[0]];
  const double low = std::min(best, next), high = std::max(best, next);
  if (measure.best != Measure::Best::nearest_one && !best_is_noise && low > 0.0 && std::isfinite(high))
    text += fmt::format(", by a factor of {:.3g}", high / low);
  return text;
}

std::string sentence(const Measure& measure, const Values& values, const std::vector<PostSummary>& runs,
                     const std::vector<std::string>& labels) {
  const std::string unit = measure.unit.empty() ? "" : " " + measure.unit;
  std::string numbers;
  for (size_t i = 0; i < values.size(); ++i) {
    if (!values[i]) continue;
    if (!numbers.empty()) numbers += ", ";
    if (is_negligible(measure, runs[i], *values[i]))
      numbers += fmt::format("negligible (below {:.0e}{}, the accuracy of its forces) in {}",
                             measure.scale * measure.noise(runs[i]), unit, labels[i]);
    else
      numbers += fmt::format("{:.4g}{} in {}", measure.scale * *values[i], unit, labels[i]);
  }
  return fmt::format("{} {}: {}.", measure.subject, numbers, conclusion(measure, values, runs, labels));
}

}  // namespace

const std::vector<Measure>& measures() {
  using Best = Measure::Best;
  using S = PostSummary;
  using O = std::optional<double>;
  const auto of_ratio = [](const S& s) { return s.equilibrium_residual; };
  const auto of_arm = [](const S& s) { return s.equilibrium_residual * s.block_size_m; };
  static const std::vector<Measure> kMeasures{
      {"cv_pressure_percent", "%", 100.0, "Within a ring, bed pressures vary in the mean by",
       "How evenly the blocks of one ring share the load: 0 when all are pressed alike.", "most even",
       Best::lowest, [](const S& s) { return O(s.mean_cv_pressure); }, of_ratio},
      {"rib_over_mid_sail", "", 1.0, "The resultant of the rib over that of the mid-sail is",
       "Whether a corner of the vault carries more than the middle of a sail: 1 when alike.",
       "nearest to equal", Best::nearest_one, [](const S& s) { return s.rib_over_mid_sail; }},
      {"friction_use_percent", "%", 100.0, "Of its friction, the most used joint needs",
       "How near the joint that is worst off comes to sliding: at 100 % it slides.", "least used",
       Best::lowest, [](const S& s) { return O(s.largest_friction_use); }, of_ratio},
      {"critical_friction", "", 1.0, "The friction coefficient at which it falls is",
       "How slippery its joints may become before the vault falls: the lower, the safer.",
       "safest against sliding", Best::lowest, [](const S& s) { return s.critical_value; }},
      {"kern_use", "", 1.0, "Over the kern's edge, the bed forces' mean eccentricity is",
       "How centrally the beds are pressed: up to 1 the whole bed is, above it a part gapes.", "most central",
       Best::lowest, [](const S& s) { return O(s.mean_kern_use); }, of_ratio},
      {"geometric_safety", "", 1.0, "The least geometric safety of the thrust lines is",
       "How much thicker the shell is than the line of thrust needs: at 1 the line touches a face.",
       "largest", Best::highest, least_safety},
      {"thrust_over_weight", "", 1.0, "The outward thrust of the base over the weight is",
       "How hard the vault leans outwards on what it stands on.", "smallest", Best::lowest,
       [](const S& s) { return O(s.thrust_over_weight); }, of_ratio},
      {"couple_length_m", "m", 1.0, "The largest couple length of a block's wrench is",
       "How far off its axis a force twists the worst block.", "smallest", Best::lowest,
       [](const S& s) { return O(s.largest_couple_length_m); }, of_arm},
      {"displacement_mm", "mm", 1000.0, "The largest displacement of a block is",
       "How far mortar yields under the weight.", "stiffest", Best::lowest,
       [](const S& s) { return O(s.max_displacement_m); }},
  };
  return kMeasures;
}

std::vector<std::string> run_labels(size_t num_runs) {
  std::vector<std::string> labels;
  for (size_t i = 0; i < num_runs; ++i)
    labels.push_back(i < 26 ? std::string(1, static_cast<char>('A' + i)) : fmt::format("run {}", i + 1));
  return labels;
}

std::vector<std::string> reading(const std::vector<PostSummary>& runs) {
  const std::vector<std::string> labels = run_labels(runs.size());
  std::vector<std::string> sentences;
  for (size_t i = 0; i < runs.size(); ++i)
    if (runs[i].status != "stable")
      sentences.push_back(
          fmt::format("{} is {}: its forces are not those of an equilibrium (residual {:.1e}).", labels[i],
                      runs[i].status, runs[i].equilibrium_residual));
  for (const Measure& measure : measures()) {
    Values values;
    for (const PostSummary& run : runs) values.push_back(measure.value(run));
    if (std::count_if(values.begin(), values.end(), [](const auto& v) { return v.has_value(); }) >= 2)
      sentences.push_back(sentence(measure, values, runs, labels));
  }
  return sentences;
}

Table comparison_table(const std::vector<PostSummary>& runs) {
  Table t{"comparison",
          "The runs, measure by measure",
          {{"run", "", "run"}, {"title", "", "case"}, {"status", "", "status"}},
          {}};
  t.columns.push_back({"blocks", "", "free blocks"});
  t.columns.push_back({"friction", "", "friction coefficient"});
  for (const Measure& m : measures()) t.columns.push_back({m.key, m.unit, m.subject});
  const std::vector<std::string> labels = run_labels(runs.size());
  for (size_t i = 0; i < runs.size(); ++i) {
    std::vector<Table::Cell> row{labels[i], runs[i].title, runs[i].status, runs[i].blocks, runs[i].friction};
    for (const Measure& m : measures()) {
      const std::optional<double> value = m.value(runs[i]);
      row.push_back(m.scale * value.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    t.rows.push_back(std::move(row));
  }
  return t;
}

Table plain_table(const std::vector<PostSummary>& runs) {
  Table t{"numbers", "The numbers and what they tell", {{"measure", "", "what it tells"}}, {}};
  const std::vector<std::string> labels = run_labels(runs.size());
  for (size_t i = 0; i < runs.size(); ++i) t.columns.push_back({labels[i], labels[i], runs[i].title});
  for (const Measure& m : measures()) {
    std::vector<Table::Cell> row{m.plainly};
    bool any = false;
    for (const PostSummary& run : runs) {
      const std::optional<double> value = m.value(run);
      any = any || value.has_value();
      if (!value)
        row.emplace_back("-");
      else if (is_negligible(m, run, *value))
        row.emplace_back("negligible");
      else
        row.emplace_back(to_display(m.scale * *value) + (m.unit.empty() ? "" : " " + m.unit));
    }
    if (any) t.rows.push_back(std::move(row));
  }
  return t;
}

}  // namespace cupola
