#pragma once

#include <string>
#include <vector>

#include "assembly/case/section.hpp"
#include "postproc/studies/study_run.hpp"

namespace cupola {

/// One run of a trade-off: the knob that it turns, its settings and its reference.
struct TradeoffRun {
  std::string knob;       ///< e.g. "tolerance"
  std::string name;       ///< of the run and its folder, unique
  std::string reference;  ///< name of the run to compare with; a reference names itself
  /// With a name, the reference is extrapolated to a time step of zero: 2 `reference` - `coarse`, for a
  /// method of first order and twice the time step in `coarse`.
  std::string coarse;
  std::vector<std::string> settings;  ///< key.path=value, or --option=value of cupola-solve
  std::string folder;                 ///< of the run, below the folder of all runs
  bool is_reference() const { return name == reference && coarse.empty(); }
  /// "exact", or "2 x step_1ms - step_2ms".
  std::string reference_text() const;
};

/// Runs that turn one knob, compared with one reference. Runs whose names agree up to the last underscore
/// form one line of the plot.
struct TradeoffKnob {
  std::string knob, reference, coarse;
  std::vector<std::string> only;      ///< cases for which the knob is turned; empty: all
  std::vector<std::string> settings;  ///< of all runs of the knob
  std::vector<TradeoffRun> runs;
};
void declare_tradeoff_knob(Section& s, TradeoffKnob& knob);

/// The runs of all knobs for one case, in order. Throws InputError at the place of a knob in `list` whose
/// reference is not defined, whose run has the name of another run, or which extrapolates from runs whose
/// `analysis.time_step` does not differ by a factor of two.
std::vector<TradeoffRun> runs_of(const std::vector<TradeoffKnob>& knobs, const CaseNode& list,
                                 const std::string& case_name, const std::string& folder);

}  // namespace cupola
