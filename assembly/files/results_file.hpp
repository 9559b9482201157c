#pragma once

#include <map>
#include <string>
#include <vector>

#include "assembly/model/results.hpp"

namespace cupola {

/// Writes the frames of a results folder as they come: contacts_NNNN.vtp, blocks_NNNN.vtp and the two .pvd
/// collections, rewritten after each frame.
class ResultsWriter {
 public:
  /// Creates the folder. `assembly_hash` goes into every file. `times` (s) of the frames that are there
  /// already when a run is resumed.
  ResultsWriter(std::string folder, std::string assembly_hash, std::vector<double> times = {});
  void write_frame(const Frame& frame);
  void write_text(const std::string& name, const std::string& text);  ///< run.yaml, history.csv
  /// Last: a summary says that the folder is complete. It names every text file with its hash.
  void write_summary(Summary summary);

  const std::string& folder() const { return folder_; }

 private:
  std::string folder_;
  std::string assembly_hash_;
  std::vector<double> times_;
  std::map<std::string, std::string> text_files_;  ///< name to hash
};

/// A results folder, read frame by frame. Throws InputError naming the file when something is missing,
/// truncated, or belongs to another assembly.
class ResultsReader {
 public:
  /// `force`: takes results of another assembly, as long as they are all of the same one.
  ResultsReader(std::string folder, const std::string& assembly_hash, bool force = false);
  const Summary& summary() const { return summary_; }
  const std::vector<double>& times() const { return times_; }  ///< s, one per frame
  Frame read_frame(int index) const;
  std::string read_text_file(const std::string& name) const;  ///< refuses other bytes than were written

 private:
  std::string folder_;
  std::string assembly_hash_;
  Summary summary_;
  std::vector<double> times_;
};

}  // namespace cupola
