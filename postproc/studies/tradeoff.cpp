#include "postproc/studies/tradeoff.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/summary_file.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;

/// Forces of the runs by name; each run is read once.
class ForceCache {
 public:
  explicit ForceCache(const std::string& runs) : runs_(runs) {}
  const RunForces& forces(const std::string& name) {
    const auto found = forces_.find(name);
    if (found != forces_.end()) return found->second;
    RunFiles files((fs::path(runs_) / name).string());
    return forces_.emplace(name, read_forces(files)).first->second;
  }

 private:
  std::string runs_;
  std::map<std::string, RunForces> forces_;
};

bool is_faster(const TradeoffRow& a, const TradeoffRow& b) {
  return a.seconds() < b.seconds();
}

Summary read_summary(const std::string& runs, const std::string& name) {
  const std::string path = (fs::path(runs) / name / "results" / "summary.json").string();
  return summary_from_json(read_text(path), path);
}

}  // namespace

bool TradeoffRow::uses_wall_time() const {
  return std::any_of(point.settings.begin(), point.settings.end(),
                     [](const std::string& setting) { return setting.starts_with("--threads="); });
}

double TradeoffRow::seconds() const {
  if (!summary) return 0.0;
  return uses_wall_time() ? summary->wall_time_seconds : summary->cpu_time_seconds;
}

std::vector<TradeoffRow> measure_tradeoff(const std::vector<TradeoffRun>& points, const std::string& runs) {
  const RunCache cache(runs);
  ForceCache forces(runs);
  std::vector<TradeoffRow> rows;
  for (const TradeoffRun& point : points) {
    TradeoffRow row{point, {}, {}, {}};
    const bool finished = cache.finished(point.name) && cache.finished(point.reference);
    if (finished && !point.coarse.empty() && cache.finished(point.coarse)) {
      row.summary = read_summary(runs, point.name);
      row.errors = compare_forces(extrapolated(forces.forces(point.reference), forces.forces(point.coarse)),
                                  forces.forces(point.name));
    } else if (finished && point.coarse.empty()) {
      row.summary = read_summary(runs, point.name);
      const Summary reference = read_summary(runs, point.reference);
      if (row.summary->critical && reference.critical)
        row.critical_error = std::abs(row.summary->critical->value / reference.critical->value - 1.0);
      else if (!point.is_reference())
        row.errors = compare_forces(forces.forces(point.reference), forces.forces(point.name));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<std::string> knobs_of(const std::vector<TradeoffRow>& rows) {
  std::vector<std::string> knobs;
  for (const TradeoffRow& row : rows)
    if (std::find(knobs.begin(), knobs.end(), row.point.knob) == knobs.end()) knobs.push_back(row.point.knob);
  return knobs;
}

std::vector<TradeoffRow> rows_of(const std::vector<TradeoffRow>& rows, const std::string& knob) {
  std::vector<TradeoffRow> chosen;
  for (const TradeoffRow& row : rows)
    if (row.point.knob == knob && row.finished() && !row.point.is_reference()) chosen.push_back(row);
  std::stable_sort(chosen.begin(), chosen.end(), is_faster);
  return chosen;
}

std::vector<TradeoffRow> pareto_front(const std::vector<TradeoffRow>& rows) {
  CUPOLA_ASSERT(std::is_sorted(rows.begin(), rows.end(), is_faster));
  std::vector<TradeoffRow> front;
  double best = std::numeric_limits<double>::infinity();
  for (const TradeoffRow& row : rows) {
    if (!row.reached() || !(row.error() < best)) continue;
    best = row.error();
    front.push_back(row);
  }
  return front;
}

Table tradeoff_table(const std::vector<TradeoffRow>& rows) {
  Table t{"tradeoff", "Cost and errors of every run of the study", {}, {}};
  t.columns = {{"knob", "", "the setting that is varied"},
               {"run", "", "folder of the run"},
               {"reference", "", "run that it is compared with, or extrapolation from two runs"},
               {"settings", "", "keys changed from the case file"},
               {"status", "", "how the run ended; not run: files are missing"},
               {"cpu_time_s", "s", "processor time of cupola-solve"},
               {"wall_time_s", "s", "wall time of cupola-solve"},
               {"threads", "", "threads of cupola-solve"},
               {"memory_MB", "MB", "peak memory"},
               {"contacts", "", "contact points"},
               {"steps", "", "steps of the analysis"},
               {"iterations", "", "iterations of the contact method"},
               {"accuracy_asked", "", "accuracy requested"},
               {"accuracy_reached", "", "accuracy reached"},
               {"certified_force_error", "", "bound on the force error that needs no reference; NaN: none"},
               {"wrench_error_rms", "", "root mean square error of the bed-joint wrenches, relative"},
               {"wrench_error_worst", "", "error of the worst bed joint over the root mean square wrench"},
               {"thrust_line_error", "", "largest shift of a thrust line over the thickness"},
               {"critical_value_error", "", "relative error of the critical value, limit analyses"}};
  for (const TradeoffRow& row : rows) {
    std::string settings;
    for (const std::string& setting : row.point.settings) settings += (settings.empty() ? "" : " ") + setting;
    const Summary s = row.summary.value_or(Summary{});
    const double none = std::numeric_limits<double>::quiet_NaN();
    const auto error = [&](double value) { return row.finished() ? value : none; };
    const auto force_error = [&](double value) {
      return row.finished() && !row.critical_error ? value : none;
    };
    t.rows.push_back({row.point.knob, row.point.name, row.point.reference_text(), settings,
                      row.finished() ? to_string(s.status) : std::string("not run"),
                      error(s.cpu_time_seconds), error(s.wall_time_seconds), s.threads,
                      error(static_cast<double>(s.peak_memory_bytes) / 1e6), s.contacts, s.steps,
                      s.iterations, error(s.accuracy.asked), error(s.accuracy.reached),
                      s.certified_force_error.value.value_or(none), force_error(row.errors.wrench_rms),
                      force_error(row.errors.wrench_worst), force_error(row.errors.thrust_line),
                      row.critical_error.value_or(none)});
  }
  return t;
}

}  // namespace cupola
