#pragma once

#include <functional>
#include <optional>
#include <string>

#include "assembly/model/results.hpp"
#include "solver/analysis/statics/static_solve.hpp"

namespace cupola {

/// Result of the static solve at one value of the parameter.
struct LimitTrial {
  double value = 0.0;
  StaticOutcome outcome = StaticOutcome::unconverged;
  double speed_ratio = 0.0;  ///< |v| / (g h)
};

/// Bracket of the critical value, and how the search for it ended.
struct Bracket {
  LimitTrial stable, moving;  ///< the two ends
  int trials = 0;
  bool found = false;                         ///< one end stands, the other moves
  bool narrow = false;                        ///< found, and of the required width
  std::optional<StaticOutcome> at_both_ends;  ///< of an interval both of whose ends stand, or move
  Sought sought;                              ///< how the search ended, and what to try: two clauses
  double middle() const { return 0.5 * (stable.value + moving.value); }
};

/// A limit of at most this share of the bracket given is zero but for rounding, and has no relative width. A
/// mechanism is looked for a tenth of it beyond.
inline constexpr double kZeroLimit = 1e-8;
inline constexpr const char* kNormOfZero = "width of its bracket, relative to the bracket given";

/// Required width of a bracket; the largest of the three counts.
struct BracketWidth {
  double relative = 1e-3;  ///< of the middle of the bracket
  double absolute = 0.0;
  double zero = 0.0;  ///< where the middle is no larger
};

/// Result at a value; none if the search is to be abandoned.
using TryValue = std::function<std::optional<LimitTrial>(double value)>;

/// The structure stands, or moves, at both ends of the bracket: why, and what to try.
Sought at_both_ends(bool stands, double low, double high);

/// The record of a search without a critical value, by the status of the case itself: unconverged if the case
/// does otherwise than the search says. A search itself finds at most that there is no limit.
Sought concluded(Sought sought, Status status);

/// Bisects between a value at which the structure stands and one at which it moves, until the bracket has the
/// required width. A trial that does not converge decides nothing: the bracket then closes in on that value
/// from both sides and stays wider than required, and the message gives the undecided interval. No bracket is
/// found if the structure stands at both ends, moves at both ends, or if the solve at one end does not
/// converge.
Bracket bisect(double low, double high, const BracketWidth& required, const TryValue& try_value);

}  // namespace cupola
