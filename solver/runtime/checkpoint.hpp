#pragma once

#include <optional>
#include <string>
#include <vector>

namespace cupola {

/// State of a run of cupola-solve after a step.
struct Checkpoint {
  std::string program_version, case_hash, assembly_hash;  ///< of the run that wrote it
  std::vector<double> frame_times;                        ///< s, of the frames written so far
  std::string history;                                    ///< text of history.csv so far
  std::string analysis;                                   ///< state of the analysis, as bytes
};

/// Writes a temporary file with a checksum and renames it, so that the last valid checkpoint survives any
/// failure.
void write_checkpoint(const std::string& path, const Checkpoint& checkpoint);

/// Returns nothing if the file does not exist. Throws InputError with the path if it is damaged.
std::optional<Checkpoint> read_checkpoint(const std::string& path);

}  // namespace cupola
