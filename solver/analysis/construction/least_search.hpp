#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "solver/analysis/statics/limit_search.hpp"

namespace cupola {

/// Searches for the least value of a property with which each of a sequence of structures stands. The bracket
/// of the last one is tried first, because neighbours need about the same.
class LeastSearch {
 public:
  /// Whether a structure that stands also does with more of the property. Otherwise every search starts from
  /// `first`, and goes on below it if it moves there and at all larger values tried.
  enum class MoreBears { more, less_at_times };
  /// `first`: value tried first; `most`: largest value tried.
  LeastSearch(double first, double most, const BracketWidth& width, MoreBears more_bears = MoreBears::more)
      : first_(first), most_(most), width_(width), more_bears_(more_bears) {}

  struct Result {
    bool needs_none = false;  ///< stands at zero
    Bracket bracket;          ///< if it does not
  };
  /// Result::bracket.found is false, with the reason, if no value up to `most` is found with which it stands,
  /// or if a solve at zero does not converge: the stable end is then the least value found. If it moves at
  /// `most` and therefore everywhere, that is the moving end.
  Result find(const TryValue& solve);

  /// For checkpoints: the last bracket found, values at which a structure stands and moves.
  const std::optional<std::pair<double, double>>& last() const { return last_; }
  void start_from(const std::optional<std::pair<double, double>>& last) { last_ = last; }

 private:
  std::vector<double> values_to_try() const;

  double first_, most_;
  BracketWidth width_;
  MoreBears more_bears_;
  std::optional<std::pair<double, double>> last_;
};

}  // namespace cupola
