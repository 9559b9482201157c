#pragma once

#include <cmath>
#include <optional>
#include <utility>

#include "solver/analysis/admissible/pull_solve.hpp"

namespace cupola {

/// Two values on either side of the root, which the secant method and bisection close. Values between them
/// that do not decide are left out: the search then closes in on them from both sides.
class PullSearch {
 public:
  /// Solves with pulls of different signs.
  PullSearch(PullSolve below, PullSolve above);
  double width() const { return std::abs(admissible.value - moving.value); }
  double middle() const { return 0.5 * (admissible.value + moving.value); }
  /// The next value to try: just before the root of the linear model, and just behind it once the moving end
  /// is that close; the middle if there is no such root, or if the last one did not halve f. Beside values
  /// that did not decide: the middle between them and the farther end.
  double next(double enough) const;
  /// True if the width is `enough`, or if further solves would hardly come closer to the values that did not
  /// decide.
  bool is_closed(double enough) const;
  void include(PullSolve solve);  ///< that decided
  void leave_out(double value);   ///< that did not decide
  /// The least and the greatest value that did not decide.
  const std::optional<std::pair<double, double>>& undecided() const { return undecided_; }
  PullSolve moving, admissible;

 private:
  /// Distance from the moving and from the admissible end to the nearest value that did not decide.
  std::pair<double, double> open_gaps() const;

  bool overshot_ = false;  ///< the last trial was admissible
  bool bisect_ = false;
  std::optional<std::pair<double, double>> undecided_;
};

}  // namespace cupola
