#pragma once

#include <optional>
#include <string>
#include <vector>

#include "postproc/tables/post_summary.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// One number that tells bond patterns apart, and how to speak of it.
struct Measure {
  enum class Best { lowest, highest, nearest_one };
  std::string key;          ///< column of the table
  std::string unit;         ///< as shown: "%", "m", ...
  double scale = 1.0;       ///< from the summary's SI value to the unit
  std::string subject;      ///< beginning of the sentence, up to the number
  std::string plainly;      ///< what it tells, for readers who build rather than compute
  std::string superlative;  ///< of the run that is best by this measure
  Best best = Best::lowest;
  std::optional<double> (*value)(const PostSummary&) = nullptr;  ///< none where a run has no such number
  /// The value below which it says nothing: what an error of all forces by the run's equilibrium residual
  /// makes of it. None for measures that are not zero where forces are exact and even.
  double (*noise)(const PostSummary&) = nullptr;
};
const std::vector<Measure>& measures();

/// What sentences and graphs call the runs: A, B, C ... in the order given, run 27 and later by number.
std::vector<std::string> run_labels(size_t num_runs);

/// What the numbers say, a sentence per measure that at least two runs have. Each sentence holds the number
/// of every run and names the best one; numbers below their noise are called negligible, for a ratio of two
/// roundings means nothing; runs that are not at rest are said first.
std::vector<std::string> reading(const std::vector<PostSummary>& runs);

/// One row per run, one column per measure: for the CSV.
Table comparison_table(const std::vector<PostSummary>& runs);

/// One row per measure with what it tells, one column per run: for the reader.
Table plain_table(const std::vector<PostSummary>& runs);

}  // namespace cupola
