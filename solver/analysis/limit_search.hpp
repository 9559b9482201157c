#pragma once

#include <functional>
#include <optional>
#include <string>

#include "solver/analysis/static_solve.hpp"

namespace cupola {

/// What one static solve said at one value of the parameter.
struct LimitTrial {
  double value = 0.0;
  Verdict verdict = Verdict::unconverged;
  double speed_ratio = 0.0;  ///< |v| / (g h)
};

/// A bracket of the critical value.
struct Bracket {
  LimitTrial stable, moving;
  int trials = 0;
  bool found = false;   ///< both ends have their verdict
  bool narrow = false;  ///< and are as near to each other as wanted
  std::string message;  ///< how it ended
  double middle() const { return 0.5 * (stable.value + moving.value); }
};

/// When a bracket is narrow enough: the wider of the two.
struct BracketWidth {
  double relative = 1e-3;  ///< of its middle
  double absolute = 0.0;
};

/// What happens at a value; none: the search is given up.
using TryValue = std::function<std::optional<LimitTrial>(double value)>;

/// Bisects between a value at which the structure stands and one at which it moves, until the bracket is
/// narrow enough. A trial that does not converge says nothing: the bracket then closes in on it from either
/// side, stays wider than wanted, and the message tells what is not known. No bracket is found when both ends
/// behave alike or one of them does not converge.
Bracket bisect(double low, double high, const BracketWidth& wanted, const TryValue& try_value);

}  // namespace cupola
