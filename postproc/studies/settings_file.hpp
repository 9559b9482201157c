#pragma once

#include <string>
#include <vector>

namespace cupola {

/// One run of a trade-off study: the knob that it turns, its settings and its reference.
struct StudyPoint {
  std::string knob;                   ///< e.g. "tolerance"
  std::string name;                   ///< of the run and its folder, unique
  std::string reference;              ///< name of the run to compare with; a reference names itself
  std::vector<std::string> settings;  ///< key.path=value, or --option=value of cupola-solve
  bool is_reference() const { return name == reference; }
};

/// Reads files with lines of the form
///
///     KNOB  NAME  REFERENCE  key.path=value ... --threads=N
///
/// Empty lines and lines that begin with # are skipped. Throws InputError with file and line for an
/// incomplete line, a repeated name, or a reference that is not defined as its own reference.
std::vector<StudyPoint> read_study(const std::vector<std::string>& paths);

}  // namespace cupola
