#pragma once

#include <optional>
#include <string>
#include <vector>

#include "postproc/tables/post_summary.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// One number by which runs are compared, and the words to report it with.
struct Measure {
  enum class Best { lowest, highest, nearest_one };
  std::string key;          ///< column of the table
  std::string unit;         ///< as displayed: "%", "m", ...
  double scale = 1.0;       ///< factor from the SI value to the displayed unit
  std::string subject;      ///< beginning of the sentence, up to the number
  std::string explanation;  ///< meaning, for readers who build rather than compute
  std::string superlative;  ///< describes the best run: "... in A"
  Best best = Best::lowest;
  std::optional<double> (*value)(const PostSummary&) = nullptr;  ///< none if a run lacks the number
};
const std::vector<Measure>& measures();

/// Labels of the runs in sentences and graphs: A, B, C ... in the given order, by number from run 27 on.
std::vector<std::string> run_labels(size_t num_runs);

/// One sentence per measure that at least two runs have. Each sentence gives the number of every run and
/// names the best run. Zeros are called negligible: the summary of a run sets to zero what is below its
/// floor, because a ratio of two rounding errors means nothing. Runs that are not stable are reported first,
/// then different friction laws and frictions, which explain other differences.
std::vector<std::string> findings(const std::vector<PostSummary>& runs);

/// One row per run and one column per measure, for the CSV file.
Table comparison_table(const std::vector<PostSummary>& runs);

/// One row per measure with its explanation and one column per run, for the reader.
Table plain_table(const std::vector<PostSummary>& runs);

}  // namespace cupola
