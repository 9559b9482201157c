#include "solver/analysis/limit_search.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace cupola {

Bracket bisect(double low, double high, const BracketWidth& wanted,
               const std::function<LimitTrial(double value)>& try_value) {
  Bracket bracket;
  const auto attempt = [&](double value) {
    ++bracket.trials;
    return try_value(value);
  };
  const LimitTrial at_low = attempt(low), at_high = attempt(high);
  for (const LimitTrial& end : {at_low, at_high}) {
    if (end.verdict != Verdict::unconverged) continue;
    bracket.message = fmt::format("not converged at {:g}, an end of the bracket", end.value);
    return bracket;
  }
  if (at_low.verdict == at_high.verdict) {
    bracket.message = fmt::format("{} at both ends of the bracket, {:g} and {:g}",
                                  at_low.verdict == Verdict::equilibrium ? "stands" : "moves", low, high);
    return bracket;
  }
  bracket.stable = at_low.verdict == Verdict::equilibrium ? at_low : at_high;
  bracket.moving = at_low.verdict == Verdict::equilibrium ? at_high : at_low;
  const auto width = [&] { return std::abs(bracket.stable.value - bracket.moving.value); };
  while (width() > std::max(wanted.absolute, wanted.relative * std::abs(bracket.middle()))) {
    const double middle = bracket.middle();
    if (middle == bracket.stable.value || middle == bracket.moving.value) break;  // adjacent doubles
    const LimitTrial trial = attempt(middle);
    if (trial.verdict == Verdict::unconverged) {
      bracket.message = fmt::format("not converged at {:g}", trial.value);
      return bracket;
    }
    (trial.verdict == Verdict::equilibrium ? bracket.stable : bracket.moving) = trial;
  }
  bracket.found = true;
  bracket.message =
      fmt::format("stands at {:.6g} (|v|/(g h) = {:.1e}), moves at {:.6g} ({:.1e})", bracket.stable.value,
                  bracket.stable.speed_ratio, bracket.moving.value, bracket.moving.speed_ratio);
  return bracket;
}

}  // namespace cupola
