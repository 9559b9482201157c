#pragma once

#include <string>
#include <vector>

namespace cupola {

/// One run of a trade-off study: the knob that it turns, its settings and its reference.
struct StudyPoint {
  std::string knob;       ///< e.g. "tolerance"
  std::string name;       ///< of the run and its folder, unique
  std::string reference;  ///< name of the run to compare with; a reference names itself
  /// With a name, the reference is extrapolated to a time step of zero: 2 `reference` - `coarse`, for a
  /// method of first order and twice the time step in `coarse`.
  std::string coarse;
  std::vector<std::string> settings;  ///< key.path=value, or --option=value of cupola-solve
  bool is_reference() const { return name == reference && coarse.empty(); }
  /// "exact", or "2 x step_1ms - step_2ms".
  std::string reference_text() const;
};

/// Reads files with lines of the form
///
///     KNOB  NAME  REFERENCE  key.path=value ... --threads=N
///
/// REFERENCE is the name of a run, or FINE+COARSE for a reference extrapolated from two runs. Empty lines and
/// lines that begin with # are skipped. Throws InputError with file and line for an incomplete line, a
/// repeated name, a reference that is not defined as its own reference, or an extrapolation from runs whose
/// `analysis.time_step` does not differ by a factor of two.
std::vector<StudyPoint> read_study(const std::vector<std::string>& paths);

}  // namespace cupola
