#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "postproc/tables/csv_file.hpp"

namespace cupola {

/// The files of one finished run, read when asked for.
class RunFiles {
 public:
  explicit RunFiles(std::string folder);
  ~RunFiles();

  std::string status();  ///< of results/summary.json
  /// `results.KEY` or `post.KEY`; KEY descends with dots into maps and, by index, into lists. Booleans count
  /// as 0 and 1. InputError when there is no such number.
  double number(const std::string& key);
  const CsvFile& table(const std::string& name);  ///< post/NAME.csv
  /// Names of the tables that begin with `start`, sorted.
  std::vector<std::string> table_names(const std::string& start) const;

 private:
  struct Summaries;
  std::string folder_;
  std::unique_ptr<Summaries> summaries_;
  std::map<std::string, CsvFile> tables_;
};

/// Runs by name, each below the folder `out`.
class RunCache {
 public:
  explicit RunCache(std::string out) : out_(std::move(out)) {}
  bool finished(const std::string& name) const;  ///< solved and analysed
  RunFiles& run(const std::string& name);

 private:
  std::string out_;
  std::map<std::string, RunFiles> runs_;
};

}  // namespace cupola
