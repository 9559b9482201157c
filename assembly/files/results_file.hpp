#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "assembly/model/results.hpp"

namespace cupola {

/// Paces writing again what grows: it is due when it has grown by a hundredth since it was written, so that
/// the sum of all writing is proportional to its final size.
class Growth {
 public:
  bool is_due(std::size_t size) const { return size < written_ || 100 * (size - written_) >= size; }
  bool is_current(std::size_t size) const { return size == written_; }
  void written(std::size_t size) { written_ = size; }

 private:
  std::size_t written_ = 0;
};

/// True for what a run writes anew in its folder: summary.json, frames, their collections and tables.
bool is_result_file(const std::string& name);

/// Writes the frames of a results folder one by one: contacts_NNNN.vtp, blocks_NNNN.vtp, with ties
/// ties_NNNN.vtp, and their .pvd collections. These, and tables that grow with the frames, are written again
/// when they have grown by a hundredth and when the run ends or is interrupted, so that the cost of a run is
/// proportional to its frames; what a killed run leaves lacks at most its last hundredth.
class ResultsWriter {
 public:
  /// Creates the folder, or removes the results of an earlier run from it. Every frame gets `assembly_hash`
  /// and, if given, `case_hash`, by which a reader knows the frames of one run. `times` (s): frames that exist
  /// already when a run is resumed, as do its tables; InputError if a frame is missing.
  ResultsWriter(std::string folder, std::string assembly_hash, std::vector<double> times = {},
                std::string case_hash = {});
  /// SystemError if the frame before was removed, or an earlier one whose turn it is.
  void write_frame(const Frame& frame);
  void write_text(const std::string& name, const std::string& text);     ///< run.yaml, ranges.csv
  void write_growing(const std::string& name, const std::string& text);  ///< path.csv
  /// Writes the growing tables to their ends.
  void finish_tables();
  /// To be called last: a summary marks the folder as complete. It lists every text file with its hash.
  /// SystemError if a frame was removed.
  void write_summary(Summary summary);
  /// Instead of a summary.
  void write_interruption(const Interruption& interruption);

  const std::string& folder() const { return folder_; }

 private:
  std::string folder_;
  std::string assembly_hash_, case_hash_;
  std::vector<double> times_;
  int checked_ = 0;             // the earlier frame that was looked for last
  std::vector<int> with_ties_;  // frames
  Growth collections_;
  std::map<std::string, std::string> text_files_;  // name to hash
  std::map<std::string, Growth> growing_;          // by name
  std::map<std::string, std::string> pending_;     // name to text, of growing tables not written yet

  void write_collections();
};

/// Reads a results folder frame by frame. Throws InputError that names the file if it is missing, truncated
/// or belongs to another assembly or run.
class ResultsReader {
 public:
  /// `force`: also accepts results of another assembly, provided that all files belong to the same one.
  ResultsReader(std::string folder, const std::string& assembly_hash, bool force = false);
  const Summary& summary() const { return summary_; }
  /// s, one per frame, or the numbers of the frames where their times do not increase.
  const std::vector<double>& times() const { return times_; }
  Frame read_frame(int index) const;
  std::string read_text_file(const std::string& name) const;  ///< throws InputError if the bytes have changed

 private:
  std::string folder_;
  std::string assembly_hash_;
  Summary summary_;
  std::vector<double> times_;
  std::set<std::string> listed_ties_;  // their files
};

}  // namespace cupola
