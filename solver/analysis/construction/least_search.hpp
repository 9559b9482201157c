#pragma once

#include <optional>
#include <utility>

#include "solver/analysis/statics/limit_search.hpp"

namespace cupola {

/// Searches for the least value of a property with which each of a sequence of structures stands. The bracket
/// of the last one is tried first, because neighbours need about the same.
class LeastSearch {
 public:
  /// `first`: value tried first; `most`: largest value tried.
  LeastSearch(double first, double most, const BracketWidth& width)
      : first_(first), most_(most), width_(width) {}

  struct Result {
    bool needs_none = false;  ///< stands at zero
    Bracket bracket;          ///< if it does not
  };
  /// Result::bracket.found is false, with the reason, if no value up to `most` is found with which it stands,
  /// or if a solve at zero does not converge. If it moves at `most`, that is the moving end of the bracket.
  Result find(const TryValue& solve);

  /// For checkpoints: the last bracket found, values at which a structure stands and moves.
  const std::optional<std::pair<double, double>>& last() const { return last_; }
  void start_from(const std::optional<std::pair<double, double>>& last) { last_ = last; }

 private:
  double first_, most_;
  BracketWidth width_;
  std::optional<std::pair<double, double>> last_;
};

}  // namespace cupola
