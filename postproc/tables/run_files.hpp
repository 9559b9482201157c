#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assembly/case/case_node.hpp"
#include "postproc/tables/csv_file.hpp"

namespace cupola {

/// The files of one finished run, each read on first use.
class RunFiles {
 public:
  explicit RunFiles(std::string folder);
  ~RunFiles();

  std::string status();   ///< of results/summary.json
  std::string message();  ///< of results/summary.json: why the run ended with this status
  /// "no limit above 0.15": what the search of the run found instead of a value; else the message.
  std::string found_instead();
  std::vector<std::string> warnings();                  ///< of post/summary.json, as its page shows them
  std::string text_of_results(const std::string& key);  ///< of results/summary.json; InputError without it
  std::string revision();  ///< of cupola-solve, from the `program_version` in results/summary.json
  /// Text of post/answers.json, e.g. `verdict.words`; "" if the run has no such answer.
  std::string answer(const std::string& key);
  /// A list of texts, e.g. `margin.details`.
  std::vector<std::string> answers(const std::string& key);
  /// Number `results.KEY` or `post.KEY` of the two summaries, or `case.KEY` of the case as it was run. Dots
  /// in KEY descend into maps and, by index, into lists. Booleans count as 0 and 1. InputError if there is no
  /// such number.
  double number(const std::string& key);
  std::optional<double> number_if_any(
      const std::string& key);  ///< the same; nothing if there is no such number
  /// True if results/NAME.csv is of this run, and not of an earlier one: results/summary.json lists it.
  bool has_results_table(const std::string& name);
  const CsvFile& table(const std::string& name);  ///< post/NAME.csv; for the name results/NAME that file
  /// Sorted names of the tables whose name begins with `start`.
  std::vector<std::string> table_names(const std::string& start) const;

 private:
  double number_of_case(const std::string& key);

  struct Summaries;
  std::string folder_;
  std::unique_ptr<Summaries> summaries_;
  std::optional<CaseNode> case_;  // as it was run
  std::map<std::string, CsvFile> tables_;
};

/// Runs by name, each in a folder of that name in `out`.
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
