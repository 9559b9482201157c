#pragma once

#include <optional>
#include <string>
#include <vector>

namespace cupola {

/// A run of cupola-solve as it stood after a step: the analysis' own bytes and what was written so far.
struct Checkpoint {
  std::string program_version, case_hash, assembly_hash;  ///< of the run it belongs to
  std::vector<double> frame_times;                        ///< s
  std::string history;                                    ///< text of history.csv
  std::string analysis;                                   ///< bytes of the analysis
};

/// Writes it aside, with a checksum, and renames it: whatever happens, the last good one stays.
void write_checkpoint(const std::string& path, const Checkpoint& checkpoint);

/// None when there is no such file. Throws InputError with the path when it is damaged.
std::optional<Checkpoint> read_checkpoint(const std::string& path);

}  // namespace cupola
