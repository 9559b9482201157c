#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assembly/model/results.hpp"
#include "postproc/studies/run_errors.hpp"
#include "postproc/studies/settings_file.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// One run of the study with what it cost and how far it is from its reference.
struct StudyRow {
  StudyPoint point;
  std::optional<Summary> summary;  ///< none: not run
  ForceErrors errors;              ///< zero for a reference, and where one of the two is not run
  /// Of limit analyses: relative error of the critical value. Their last frames are of different loads, so
  /// that their wrenches are not compared.
  std::optional<double> critical_error;

  bool finished() const { return summary.has_value(); }
  bool reached() const { return finished() && summary->status != Status::unconverged; }
  /// What the study ranks by: of the critical value where there is one, else the wrenches' root mean square.
  double error() const { return critical_error.value_or(errors.wrench_rms); }
  /// Threads share the work: what they save shows on the clock alone.
  bool by_the_clock() const;
  /// Processor time, or wall time where threads are the knob.
  double seconds() const;
};

/// Measures the runs in the folders runs/NAME/results and runs/NAME/post. Runs whose own folder or whose
/// reference's is not complete come back without a summary.
std::vector<StudyRow> measure_study(const std::vector<StudyPoint>& points, const std::string& runs);

/// Knobs in the order in which they first come.
std::vector<std::string> knobs_of(const std::vector<StudyRow>& rows);
/// Rows of a knob that are finished and not references, fastest first.
std::vector<StudyRow> rows_of(const std::vector<StudyRow>& rows, const std::string& knob);
/// Of rows sorted by time those that no faster one beats in wrench error, unreached ones left out.
std::vector<StudyRow> pareto_front(const std::vector<StudyRow>& rows);

/// tradeoff.csv: one row per run.
Table study_table(const std::vector<StudyRow>& rows);

}  // namespace cupola
