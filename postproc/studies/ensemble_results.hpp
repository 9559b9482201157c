#pragma once

#include <optional>
#include <string>
#include <vector>

#include "postproc/studies/ensemble_statistics.hpp"
#include "postproc/studies/study_run.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// The members of an ensemble with their results.
struct EnsembleResults {
  std::string name;
  const SampledRuns* runs = nullptr;
  Table members;                                     ///< sweep_table()
  std::vector<int> falls;                            ///< falls_of() the members
  std::vector<std::optional<bool>> throughout = {};  ///< stands_throughout() of the members
  std::vector<size_t> results = {};                  ///< columns of `members` that find_results() found
  bool more_is_safer = true;                         ///< of critical values

  /// Number of independent replicates, see DrawnValues.
  int replicates() const;
  /// Each member is independent of all others.
  bool independent() const { return replicates() == static_cast<int>(falls.size()); }
  /// Numbers of a column, of the first `count` members only. Critical values of members that fall, or stand,
  /// throughout their bracket are infinite.
  DrawnValues values(size_t column, size_t count = static_cast<size_t>(-1)) const;
  /// The column of a result; nothing if it has no such result.
  std::optional<size_t> result_named(const std::string& key) const;
  /// Column of the critical values; nothing without any. They, not how many fall, are the answer of limits:
  /// members may have no value to compare with them.
  std::optional<size_t> critical_column() const;
  /// Some critical values are infinite: they have quantiles, but no mean.
  bool censored() const;
  bool some_fall() const;  ///< as they are, or throughout their bracket
  /// Share of the first `count` members with a verdict that fall. Members without a verdict widen the
  /// interval both ways; no interval unless members are independent.
  IntervalEstimate probability(size_t count) const;
};

EnsembleResults results_of(const SampledRuns& ensemble, const std::string& runs_folder);

/// Finds the results of ensembles to be compared: the numbers that vary in one of them; of limits only the
/// critical value, because the state in which they end says nothing about the structure under its own loads.
void find_results(std::vector<EnsembleResults>* ensembles);

/// Of limit analyses the median and two quantiles of the critical value, how many members have none, and the
/// verdicts; else how many fall: "12 of 200 members fall: probability 6 % (3.1 to 10.2 %)". Members without a
/// verdict widen the interval both ways.
std::string result_sentence(const EnsembleResults& ensemble);

/// A row per result: mean, standard deviation and quantiles, each with its interval.
Table statistics_table(const EnsembleResults& ensemble);

/// A row per input and result. Of a Saltelli design: first-order and total Sobol indices. Else, of inputs
/// that are numbers and no seeds: rank correlation and first-order index.
Table inputs_table(const EnsembleResults& ensemble);

/// The members with the three smallest and the three largest values of each result, and the first three that
/// fall.
Table ends_table(const EnsembleResults& ensemble);

/// Rows for the collapse and every result of two ensembles of the same samples: first less second, member by
/// member. `sentences` gets a sentence per row, first those of differences that are shown.
Table differences_table(const std::vector<EnsembleResults>& ensembles, std::vector<std::string>* sentences);

}  // namespace cupola
