#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/model/results.hpp"
#include "postproc/report/answers.hpp"
#include "postproc/studies/study_answers.hpp"
#include "postproc/studies/sweep.hpp"
#include "postproc/tables/csv_file.hpp"
#include "postproc/tables/range_values.hpp"
#include "postproc/tables/run_files.hpp"

namespace cupola {
namespace {

constexpr const char* kMissing = "missing";

/// A number of results/summary.json or post/summary.json; empty if the run does not have it.
Table::Cell number_or_empty(RunFiles& run, const std::string& key) {
  const std::optional<double> number = run.number_if_any(key);
  return number ? Table::Cell(*number) : Table::Cell(std::string());
}

/// A result of the solver or of the postprocessor. The latter lack it if the member was not evaluated.
Table::Cell result_of(RunFiles& run, const std::string& key) {
  if (key == "thrust_N") {
    const auto share = run.number_if_any("post.thrust_over_weight"),
               weight = run.number_if_any("post.weight_N");
    return share && weight ? Table::Cell(*share * *weight) : Table::Cell(std::string());
  }
  const bool of_post = key == "margin_factor" || key == "widest_crack_m";
  return number_or_empty(run, (of_post ? "post." : "results.") + key);
}

/// What the critical value of each member is one of; "" for those without one.
std::vector<std::string> limit_parameters(const std::vector<StudyRun>& members,
                                          const std::string& runs_folder) {
  std::vector<std::string> parameters(members.size());
  for (std::size_t i = 0; i < members.size(); ++i) {
    try {
      parameters[i] = RunFiles(runs_folder + "/" + members[i].name).text_of_results("critical_parameter");
    } catch (const InputError&) {  // not finished, or no limit analysis
    }
  }
  return parameters;
}

/// Gives the critical values their unit or, of several parameters, a column that says which. The states of
/// these members are those at them.
void add_limit_parameters(const std::vector<std::string>& parameters, Table* t) {
  std::set<std::string> found(parameters.begin(), parameters.end());
  found.erase("");
  const auto critical = static_cast<std::ptrdiff_t>(t->column_named("critical_value"));
  for (const char* of_state : {"thrust_N", "widest_crack_m", "max_displacement_m"})
    if (!found.empty()) t->columns[t->column_named(of_state)].meaning += ": at the critical value, if any";
  if (found.size() == 1) t->columns[critical].unit = limit_unit(*found.begin());
  if (found.size() < 2) return;
  t->columns.insert(t->columns.begin() + critical, {"critical_parameter", "", "critical value of"});
  for (std::size_t i = 0; i < parameters.size(); ++i)
    t->rows[i].insert(t->rows[i].begin() + critical, parameters[i]);
}

/// How a run ended: its status, or that a motion has not come to rest, which is no verdict.
std::string ending_of(RunFiles& run) {
  const std::string status = run.status();
  const bool in_time = run.number_if_any("results.max_speed_m_per_s").has_value();
  return in_time && status == to_string(Status::moving) ? "not at rest" : status;
}

/// What the report of a run says of its case, which of a limit is not its status.
std::string verdict_of(RunFiles& run, const std::string& folder) {
  if (std::filesystem::exists(folder + "/post/answers.json")) return run.answer("verdict.words");
  Summary summary;  // of a member that was not evaluated
  summary.status = enum_from_name<Status>(run.status()).value_or(Status::unconverged);
  summary.max_speed_m_per_s = run.number_if_any("results.max_speed_m_per_s");
  summary.bears_loads_until_s = run.number_if_any("results.bears_loads_until_s");
  return words_of_run(summary).words;
}

/// The last stage that a missing member completed, and why it went no further or what to do.
std::string progress(const std::string& runs_folder, const std::string& name) {
  const auto there = [&](const char* file) {
    return std::filesystem::exists(fmt::format("{}/{}/{}", runs_folder, name, file));
  };
  const std::string error = error_of_run(runs_folder, name);
  if (error.empty() && there("results/checkpoint")) return "interrupted: repeat the command to resume";
  return fmt::format("{}: {}", there("assembly.vtu") ? "no results" : "no assembly",
                     error.empty() ? "see the output of the run" : error);
}

/// A result that only some analyses have.
struct OptionalResult {
  Table::Column column;
  const char* key;                  ///< in the summaries
  const char* only_with = nullptr;  ///< shown only where there is this number, by default the result itself
};
const OptionalResult kOptionalResults[] = {
    {{"acceleration_g", "g", "least horizontal acceleration that makes it move"},
     "results.robustness.acceleration_g"},
    {{kStandsAtBothEnds, "",
      "without a critical value: 1 if it stands at both ends of the bracket, 0 if it moves"},
     "results.stands_at_both_ends"},
    {{"largest_pressure_Pa", "Pa", "largest pressure on a joint"},
     "post.largest_pressure_Pa",
     "post.largest_strength_use"},
    {{"largest_strength_use", "", "largest share of compressive or tensile strength that a joint uses"},
     "post.largest_strength_use"}};

/// Adds those that any of the members has.
void add_optional_results(const std::vector<StudyRun>& members, const std::string& runs_folder, Table* t) {
  for (const OptionalResult& result : kOptionalResults) {
    std::vector<Table::Cell> cells;
    bool any = false;
    for (const StudyRun& member : members) {
      RunFiles run(fmt::format("{}/{}", runs_folder, member.name));
      cells.push_back(number_or_empty(run, result.key));
      any |= run.number_if_any(result.only_with ? result.only_with : result.key).has_value();
    }
    if (!any) continue;
    t->columns.push_back(result.column);
    for (std::size_t i = 0; i < cells.size(); ++i) t->rows[i].push_back(cells[i]);
  }
}

/// The value that the member gives the key, of which the last setting holds.
std::string value_of(const StudyRun& member, const std::string& key) {
  std::string value;
  for (const std::string& setting : member.settings)
    if (setting.starts_with(key + "=")) value = setting.substr(key.size() + 1);
  return value;
}

/// The ranges of a finished member; none for other analyses.
std::vector<ForceRange> ranges_of_member(const std::string& folder) {
  RunFiles run(folder);
  return run.has_results_table("ranges") ? read_ranges(run.table("results/ranges"))
                                         : std::vector<ForceRange>();
}

}  // namespace

bool more_is_safer(const std::vector<StudyRun>& members, const std::string& runs_folder) {
  for (const StudyRun& member : members) {
    try {
      RunFiles run(runs_folder + "/" + member.name);
      const double stable = run.number("results.bracket.0"), moving = run.number("results.bracket.1");
      if (stable != moving) return stable < moving;
    } catch (const InputError&) {  // not finished, or no critical value
    }
  }
  return true;
}

std::vector<size_t> varying_columns(const Table& table) {
  static const std::set<std::string> kNoResults{"equilibrium_residual", "cpu_time_seconds",
                                                kStandsAtBothEnds};
  constexpr double kRounding = 1e-6;  // statics are solved to 1e-8 of the loads
  std::vector<size_t> columns;
  for (size_t k = 0; k < table.columns.size(); ++k) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const auto& row : table.rows)
      if (const double* value = std::get_if<double>(&row[k]); value && std::isfinite(*value)) {
        least = std::min(least, *value);
        most = std::max(most, *value);
      }
    const bool varies = most - least > kRounding * std::max(std::abs(least), std::abs(most));
    if (varies && !kNoResults.contains(table.columns[k].key)) columns.push_back(k);
  }
  return columns;
}

Table sweep_table(const std::vector<std::string>& keys, const std::vector<StudyRun>& members,
                  const std::string& runs_folder) {
  Table t{"sweep", "The members of the sweep", {{"member", "", "name of the run"}}, {}};
  for (const std::string& key : keys) t.columns.push_back({key, "", key});
  t.columns.push_back({"status", "", "how the run ended"});
  t.columns.push_back({"verdict", "", "verdict on the case"});
  t.columns.push_back({"remark", "", "how far a missing member got"});
  const std::vector<Table::Column> numbers = {
      {"critical_value", "", "critical value of a limit analysis: middle of the bracket"},
      {"margin_factor", "", "margin: factor of the case from its limit"},
      {"thrust_N", "N", "outward thrust"},
      {"widest_crack_m", "m", "widest crack"},
      {"max_displacement_m", "m", "largest displacement of a block"},
      {"equilibrium_residual", "", "largest unbalanced force over the mean block weight"},
      {"cpu_time_seconds", "s", "processor time of cupola-solve"}};
  t.columns.insert(t.columns.end(), numbers.begin(), numbers.end());
  std::vector<std::vector<ForceRange>> ranges;
  for (const StudyRun& member : members) {
    std::vector<Table::Cell> row = {member.name};
    for (const std::string& key : keys) row.emplace_back(value_of(member, key));
    const std::string folder = fmt::format("{}/{}", runs_folder, member.name);
    ranges.push_back(ranges_of_member(folder));
    if (std::filesystem::exists(folder + "/results/summary.json")) {
      RunFiles run(folder);
      row.emplace_back(ending_of(run));
      row.emplace_back(verdict_of(run, folder));
      row.emplace_back(std::string());
      for (const Table::Column& column : numbers) row.push_back(result_of(run, column.key));
    } else {
      row.emplace_back(std::string(kMissing));
      row.emplace_back(std::string(kMissing));
      row.emplace_back(progress(runs_folder, member.name));
      row.resize(t.columns.size(), std::string());
    }
    CUPOLA_ASSERT(row.size() == t.columns.size());
    t.rows.push_back(std::move(row));
  }
  add_limit_parameters(limit_parameters(members, runs_folder), &t);
  add_optional_results(members, runs_folder, &t);
  add_range_columns(ranges, &t);
  return t;
}

}  // namespace cupola
