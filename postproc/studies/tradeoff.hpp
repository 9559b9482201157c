#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assembly/model/results.hpp"
#include "postproc/studies/run_errors.hpp"
#include "postproc/studies/tradeoff_runs.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// One run of the study with its cost and its errors against the reference.
struct TradeoffRow {
  TradeoffRun point;
  std::optional<Summary> summary;  ///< none: the run or its reference is not finished
  ForceErrors errors;              ///< zero for a reference or if one of the two is not finished
  /// Limit analyses only: relative error of the critical value. Their wrenches are not compared because their
  /// last frames belong to different loads.
  std::optional<double> critical_error;

  bool finished() const { return summary.has_value(); }
  /// False if the run did not reach its requested accuracy.
  bool reached() const { return finished() && cupola::reached(summary->status); }
  /// The error used for ranking: of the critical value if there is one, otherwise wrench_rms.
  double error() const { return critical_error.value_or(errors.wrench_rms); }
  /// True if the run sets --threads: threads reduce the wall time, not the processor time.
  bool uses_wall_time() const;
  /// Processor time, or wall time if uses_wall_time().
  double seconds() const;
};

/// Reads and compares the runs in the folders `runs`/NAME/results and `runs`/NAME/post. A row whose run or
/// reference is incomplete has no summary.
std::vector<TradeoffRow> measure_tradeoff(const std::vector<TradeoffRun>& points, const std::string& runs);

/// The knobs in the order of their first appearance.
std::vector<std::string> knobs_of(const std::vector<TradeoffRow>& rows);
/// The finished rows of a knob without its references, fastest first.
std::vector<TradeoffRow> rows_of(const std::vector<TradeoffRow>& rows, const std::string& knob);
/// The Pareto front of rows sorted by time: converged runs with a smaller error() than every faster one.
std::vector<TradeoffRow> pareto_front(const std::vector<TradeoffRow>& rows);

/// tradeoff.csv: one row per run.
Table tradeoff_table(const std::vector<TradeoffRow>& rows);

}  // namespace cupola
