#include "postproc/studies/study.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "assembly/files/atomic_file.hpp"
#include "assembly/files/summary_file.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;

/// The forces of runs by name, each read once.
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

Summary read_summary(const std::string& runs, const std::string& name) {
  const std::string path = (fs::path(runs) / name / "results" / "summary.json").string();
  return summary_from_json(read_text(path), path);
}

}  // namespace

bool StudyRow::by_the_clock() const {
  return std::any_of(point.settings.begin(), point.settings.end(),
                     [](const std::string& setting) { return setting.starts_with("--threads="); });
}

double StudyRow::seconds() const {
  if (!summary) return 0.0;
  return by_the_clock() ? summary->wall_time_seconds : summary->cpu_time_seconds;
}

std::vector<StudyRow> measure_study(const std::vector<StudyPoint>& points, const std::string& runs) {
  const RunCache cache(runs);
  ForceCache forces(runs);
  std::vector<StudyRow> rows;
  for (const StudyPoint& point : points) {
    StudyRow row{point, {}, {}, {}};
    if (cache.finished(point.name) && cache.finished(point.reference)) {
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

std::vector<std::string> knobs_of(const std::vector<StudyRow>& rows) {
  std::vector<std::string> knobs;
  for (const StudyRow& row : rows)
    if (std::find(knobs.begin(), knobs.end(), row.point.knob) == knobs.end()) knobs.push_back(row.point.knob);
  return knobs;
}

std::vector<StudyRow> rows_of(const std::vector<StudyRow>& rows, const std::string& knob) {
  std::vector<StudyRow> chosen;
  for (const StudyRow& row : rows)
    if (row.point.knob == knob && row.finished() && !row.point.is_reference()) chosen.push_back(row);
  std::stable_sort(chosen.begin(), chosen.end(),
                   [](const StudyRow& a, const StudyRow& b) { return a.seconds() < b.seconds(); });
  return chosen;
}

std::vector<StudyRow> pareto_front(const std::vector<StudyRow>& rows) {
  std::vector<StudyRow> front;
  double best = std::numeric_limits<double>::infinity();
  for (const StudyRow& row : rows) {
    if (!row.reached() || !(row.error() < best)) continue;
    best = row.error();
    front.push_back(row);
  }
  return front;
}

Table study_table(const std::vector<StudyRow>& rows) {
  Table t{"tradeoff", "Every run of the study: what it cost and how far it is from its reference", {}, {}};
  t.columns = {{"knob", "", "what is varied"},
               {"run", "", "folder of the run"},
               {"reference", "", "run that it is measured against"},
               {"settings", "", "keys changed"},
               {"status", "", "of the run; not run where its files are missing"},
               {"cpu_time_s", "s", "processor time of cupola-solve"},
               {"wall_time_s", "s", "of cupola-solve"},
               {"threads", "", "of cupola-solve"},
               {"memory_MB", "MB", "peak"},
               {"contacts", "", ""},
               {"steps", "", ""},
               {"iterations", "", "of the contact method"},
               {"accuracy_asked", "", ""},
               {"accuracy_reached", "", ""},
               {"certified_force_error", "", "bound without a reference; NaN where there is none"},
               {"wrench_error_rms", "", "of the bed joints' wrenches, over their root mean square"},
               {"wrench_error_worst", "", "of the worst bed joint, over the root mean square"},
               {"thrust_line_error", "", "largest shift of a thrust line over the thickness"},
               {"base_thrust_error", "", "relative"},
               {"critical_value_error", "", "relative, of a limit analysis"}};
  for (const StudyRow& row : rows) {
    std::string settings;
    for (const std::string& setting : row.point.settings) settings += (settings.empty() ? "" : " ") + setting;
    const Summary s = row.summary.value_or(Summary{});
    const double none = std::numeric_limits<double>::quiet_NaN();
    const auto error = [&](double value) { return row.finished() ? value : none; };
    const auto force_error = [&](double value) {
      return row.finished() && !row.critical_error ? value : none;
    };
    t.rows.push_back({row.point.knob,
                      row.point.name,
                      row.point.reference,
                      settings,
                      row.finished() ? to_string(s.status) : std::string("not run"),
                      error(s.cpu_time_seconds),
                      error(s.wall_time_seconds),
                      s.threads,
                      error(static_cast<double>(s.peak_memory_bytes) / 1e6),
                      s.contacts,
                      s.steps,
                      s.iterations,
                      error(s.accuracy_asked),
                      error(s.accuracy_reached),
                      s.certified_force_error.value_or(none),
                      force_error(row.errors.wrench_rms),
                      force_error(row.errors.wrench_worst),
                      force_error(row.errors.thrust_line),
                      force_error(row.errors.base_thrust),
                      row.critical_error.value_or(none)});
  }
  return t;
}

}  // namespace cupola
