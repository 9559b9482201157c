#pragma once

#include <string>
#include <vector>

namespace cupola {

/// One run of a trade-off study: a knob, one position of it, and the run that it is measured against.
struct StudyPoint {
  std::string knob;       ///< e.g. "tolerance"
  std::string name;       ///< of the run and its folder; unique
  std::string reference;  ///< name of the run with the right answer; its own name where it is one itself
  std::vector<std::string> settings;  ///< key.path=value, or --option=value of cupola-solve
  bool is_reference() const { return name == reference; }
};

/// Reads files of lines
///
///     KNOB  NAME  REFERENCE  key.path=value ... --threads=N
///
/// Empty lines and lines that begin with # do not count. Throws InputError with file and line for a line that
/// is too short, a name that comes twice, or a reference that no line defines as its own.
std::vector<StudyPoint> read_study(const std::vector<std::string>& paths);

}  // namespace cupola
