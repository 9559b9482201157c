#include "postproc/compare/findings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assembly/base/error.hpp"
#include "assembly/model/status.hpp"
#include "postproc/compare/range_findings.hpp"
#include "postproc/tables/range_values.hpp"

namespace cupola {
namespace {

constexpr const char *kCritical = "critical_value", *kMargin = "margin_factor";

using Values = std::vector<std::optional<double>>;

std::optional<double> least_safety(const PostSummary& s) {
  if (s.thrust_lines.empty()) return std::nullopt;
  double least = std::numeric_limits<double>::infinity();
  for (const PostSummary::Line& line : s.thrust_lines) least = std::min(least, line.least_geometric_safety);
  return least;
}

/// Ranks the runs: the best run has the smallest value.
double rank_value(const Measure& measure, double value) {
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

/// "most even in A, by a factor of 3.7", or a statement that the best two runs do not differ.
std::string conclusion(const Measure& measure, const Values& values, const std::vector<std::string>& labels) {
  constexpr double kEqual = 1e-3;  // relative difference up to which numbers are called equal
  std::vector<size_t> order;
  for (size_t i = 0; i < values.size(); ++i)
    if (values[i]) order.push_back(i);
  CUPOLA_ASSERT(order.size() >= 2);
  std::stable_sort(order.begin(), order.end(), [&](size_t i, size_t j) {
    return rank_value(measure, *values[i]) < rank_value(measure, *values[j]);
  });
  const double best = *values[order[0]], next = *values[order[1]];
  const std::string pair = order.size() == 2 ? "both are" : "the best two are";
  if (best == 0.0 && next == 0.0) return pair + " negligible";
  if (best == next || std::abs(best - next) <= kEqual * std::max(std::abs(best), std::abs(next)))
    return pair + " equal to within 0.1 %";
  std::string text = measure.superlative + " in " + labels[order[0]];
  const double low = std::min(best, next), high = std::max(best, next);
  if (measure.best == Measure::Best::nearest_one || low <= 0.0 || !std::isfinite(high)) return text;
  constexpr double kFactor = 1.1;  // below, a percentage says more than "by a factor of 1"
  return text + (high >= kFactor * low ? fmt::format(", by a factor of {:.3g}", high / low)
                                       : fmt::format(", by {:.2g} %", 100.0 * (high / low - 1.0)));
}

/// The unit of a measure of a run, after a blank.
std::string unit_text(const Measure& measure, const PostSummary& run) {
  const std::string& unit =
      measure.unit.empty() && measure.key == kCritical ? run.critical_unit : measure.unit;
  return unit.empty() ? "" : " " + unit;
}

/// What a measure of a run is of: a critical value, a margin, or a state, which of a limit is not the case's.
std::string subject_of(const Measure& measure, const PostSummary& run) {
  if (measure.key == kMargin || measure.key == kCritical) return run.critical_parameter;
  return run.critical_parameter.empty() ? "the case" : "the critical " + run.critical_parameter;
}

/// Limits of one parameter are called by its name.
std::string subject_of_all(const Measure& measure, const std::string& subject) {
  if (measure.key == kCritical && !subject.empty()) return fmt::format("The critical {} is", subject);
  if (measure.key == kMargin && !subject.empty())
    return fmt::format("The margin of the case, as a factor on the {}, is", subject);
  return measure.subject;
}

std::string sentence(const Measure& measure, const Values& values, const std::vector<PostSummary>& runs,
                     const std::vector<std::string>& labels) {
  if (std::all_of(values.begin(), values.end(), [](const auto& v) { return v == 0.0; }))
    return measure.subject + " negligible in all runs.";
  std::string numbers;
  for (size_t i = 0; i < values.size(); ++i) {
    if (!values[i]) continue;
    if (!numbers.empty()) numbers += ", ";
    if (*values[i] == 0.0)
      numbers += "negligible in " + labels[i];
    else
      numbers +=
          fmt::format("{:.4g}{} in {}", measure.scale * *values[i], unit_text(measure, runs[i]), labels[i]);
  }
  std::set<std::string> subjects;
  for (size_t i = 0; i < values.size(); ++i)
    if (values[i]) subjects.insert(subject_of(measure, runs[i]));
  if (subjects.size() > 1)
    return fmt::format("{} {}: of {}, which do not compare.", measure.subject, numbers,
                       fmt::join(subjects, ", "));
  const std::string& subject = *subjects.begin();
  return fmt::format("{} {}: {}{}.", subject_of_all(measure, subject), numbers,
                     conclusion(measure, values, labels),
                     subject.starts_with("the critical ") ? ", at " + subject : "");
}

/// "The friction law is associated in A, coulomb in B."; "" where it is the same in all runs.
std::string difference(const std::string& name, const std::vector<std::string>& values,
                       const std::vector<std::string>& labels) {
  if (std::ranges::all_of(values, [&values](const std::string& v) { return v == values.front(); })) return "";
  std::vector<std::string> of_runs;
  for (size_t i = 0; i < values.size(); ++i) of_runs.push_back(values[i] + " in " + labels[i]);
  return fmt::format("The {} is {}.", name, fmt::join(of_runs, ", "));
}

/// What the runs were given differently, before what they found.
std::vector<std::string> differences(const std::vector<PostSummary>& runs,
                                     const std::vector<std::string>& labels) {
  std::vector<std::string> laws, frictions, sentences;
  for (const PostSummary& run : runs) {
    laws.push_back(run.friction_law);
    frictions.push_back(fmt::format("{:.4g}", run.friction));
  }
  for (const std::string& text :
       {difference("friction law", laws, labels), difference("friction of the case", frictions, labels)})
    if (!text.empty()) sentences.push_back(text);
  return sentences;
}

/// Says where the runs differ in contact points while compliance is given per point; "" elsewhere.
std::string points_warning(const std::vector<PostSummary>& runs, const std::vector<std::string>& labels) {
  constexpr double kEqual = 0.01;  // relative difference of stiffness that cannot be seen in a comparison
  double fewest = std::numeric_limits<double>::infinity(), most = 0.0;
  std::string counts;
  for (size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].compliance_per != "point" || !runs[i].points_per_base_joint) continue;
    fewest = std::min(fewest, *runs[i].points_per_base_joint);
    most = std::max(most, *runs[i].points_per_base_joint);
    counts +=
        fmt::format("{}{:.3g} in {}", counts.empty() ? "" : ", ", *runs[i].points_per_base_joint, labels[i]);
  }
  if (most <= (1.0 + kEqual) * fewest) return "";
  return "The compliance is per contact point, so a joint with more points is stiffer. The mean number of "
         "points of a base joint is " +
         counts +
         ": this alone makes displacements and shares of force differ. Compare runs with "
         "joints.compliance.per: area.";
}

}  // namespace

const std::vector<Measure>& measures() {
  using Best = Measure::Best;
  using S = PostSummary;
  static const std::vector<Measure> kMeasures{
      {"cv_pressure_percent", "%", 100.0, "The mean variation of the bed pressure within a ring is",
       "How evenly the blocks of a ring share the load; 0 if the pressure is the same on every block.",
       "most even", Best::lowest, [](const S& s) { return s.mean_cv_pressure; }},
      {"rib_over_mid_sail", "", 1.0, "The ratio of the resultant in the rib to that at mid-sail is",
       "Whether a corner of the vault carries more than the middle of a sail; 1 if both carry the same.",
       "closest to 1", Best::nearest_one, [](const S& s) { return s.rib_over_mid_sail; }},
      {"friction_use_percent", "%", 100.0, "The largest friction utilisation of a joint is",
       "How close the joint with the highest demand is to sliding; at 100 % it is at its friction limit.",
       "lowest", Best::lowest, [](const S& s) { return s.largest_friction_use; }},
      {kCritical, "", 1.0, "The critical value is",
       "The limit between standing and falling. For friction, thickness and fresh mortar, lower is safer; "
       "for load, tilt, acceleration and spread, higher is safer.",
       "lowest", Best::lowest, [](const S& s) { return s.critical_value; }},
      {"kern_use", "", 1.0, "The mean eccentricity of the bed forces relative to the edge of the kern is",
       "How far off-centre the beds are loaded, on average; a bed above 1 is partly unloaded.",
       "most central", Best::lowest, [](const S& s) { return s.mean_kern_use; }},
      {"geometric_safety", "", 1.0,
       "The smallest ratio of half the thickness to the eccentricity of the thrust lines is",
       "How far from the faces the thrust lines of these states run; at 1 one touches a face. It is no "
       "geometric safety factor, which belongs to the safest state (analysis.limit.parameter: joint_extent).",
       "largest", Best::highest, least_safety},
      {"thrust_over_weight", "", 1.0, "The ratio of the outward base thrust to the weight is",
       "How hard the vault pushes outwards on its supports, compared with its weight.", "lowest",
       Best::lowest, [](const S& s) { return s.thrust_over_weight; }},
      {"thrust_kN", "kN", 1e-3, "The outward base thrust is",
       "How hard the vault pushes outwards on its supports.", "lowest", Best::lowest,
       [](const S& s) {
         return s.thrust_over_weight ? std::optional(*s.thrust_over_weight * s.weight_N) : std::nullopt;
       }},
      {kMargin, "", 1.0, "The margin of the case, as a factor, is",
       "How far the case is from the limit that was computed: 2 if half the friction or twice the load is "
       "still borne.",
       "largest", Best::highest, [](const S& s) { return s.margin_factor; }},
      {"widest_crack_mm", "mm", 1000.0, "The widest crack is",
       "How far the joint that opens most has opened.", "smallest", Best::lowest,
       [](const S& s) { return s.widest_crack_m; }},
      {"couple_length_m", "m", 1.0,
       "The largest couple length of the wrench on a block from the course below is",
       "How strongly the force on a block also twists it: couple over force, for the worst block.",
       "smallest", Best::lowest, [](const S& s) { return s.largest_couple_length_m; }},
      {"displacement_mm", "mm", 1000.0, "The largest displacement of a block is",
       "How far the block that moves most has moved under the load.", "smallest", Best::lowest,
       [](const S& s) { return s.max_displacement_m; }},
  };
  return kMeasures;
}

std::vector<std::string> run_labels(size_t num_runs) {
  std::vector<std::string> labels;
  for (size_t i = 0; i < num_runs; ++i)
    labels.push_back(i < 26 ? std::string(1, static_cast<char>('A' + i)) : fmt::format("run {}", i + 1));
  return labels;
}

std::vector<std::string> findings(const std::vector<PostSummary>& runs) {
  const std::vector<std::string> labels = run_labels(runs.size());
  std::vector<std::string> sentences;
  for (size_t i = 0; i < runs.size(); ++i)
    if (!stands(runs[i].status))
      sentences.push_back(
          fmt::format("{} ended with the status `{}`{}.", labels[i], runs[i].status,
                      runs[i].largest_friction_use ? "" : ": it has no equilibrium to compare"));
  for (std::string& given : differences(runs, labels)) sentences.push_back(std::move(given));
  if (std::string warning = points_warning(runs, labels); !warning.empty())
    sentences.push_back(std::move(warning));
  for (const Measure& measure : measures()) {
    Values values;
    for (const PostSummary& run : runs) values.push_back(measure.value(run));
    if (std::count_if(values.begin(), values.end(), [](const auto& v) { return v.has_value(); }) >= 2)
      sentences.push_back(sentence(measure, values, runs, labels));
  }
  for (std::string& finding : range_findings(runs, labels)) sentences.push_back(std::move(finding));
  return sentences;
}

Table comparison_table(const std::vector<PostSummary>& runs) {
  Table t{"comparison",
          "Every run with every measure",
          {{"run", "", "label"}, {"title", "", "title of the case"}, {"status", "", "status"}},
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
  add_range_columns(ranges_of(runs), &t);
  return t;
}

Table plain_table(const std::vector<PostSummary>& runs) {
  Table t{"numbers", "The measures and their meaning", {{"measure", "", "meaning"}}, {}};
  const std::vector<std::string> labels = run_labels(runs.size());
  for (size_t i = 0; i < runs.size(); ++i) t.columns.push_back({labels[i], labels[i], runs[i].title});
  for (const Measure& m : measures()) {
    std::vector<Table::Cell> row{m.explanation};
    bool any = false;
    for (const PostSummary& run : runs) {
      const std::optional<double> value = m.value(run);
      any = any || value.has_value();
      if (!value)
        row.emplace_back("-");
      else if (*value == 0.0)
        row.emplace_back("negligible");
      else
        row.emplace_back(to_display(m.scale * *value) + unit_text(m, run));
    }
    if (any) t.rows.push_back(std::move(row));
  }
  add_range_rows(runs, &t);
  return t;
}

}  // namespace cupola
