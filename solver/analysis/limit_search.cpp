#include "solver/analysis/limit_search.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace cupola {
namespace {

/// Values between the ends of a bracket at which trials did not converge: the one nearest to either end.
struct Unknown {
  double to_stable, to_moving;
};

/// Where to try next: half-way to what is not known, from the end that is further from it.
double next_value(const Bracket& bracket, const std::optional<Unknown>& unknown) {
  if (!unknown) return bracket.middle();
  const double left = 0.5 * (unknown->to_stable - bracket.stable.value);
  const double right = 0.5 * (unknown->to_moving - bracket.moving.value);
  return std::abs(left) >= std::abs(right) ? bracket.stable.value + left : bracket.moving.value + right;
}

/// What a trial between the ends changes.
void take(const LimitTrial& trial, Bracket* bracket, std::optional<Unknown>* unknown) {
  const auto distance = [&](const LimitTrial& end) { return std::abs(trial.value - end.value); };
  if (trial.verdict == Verdict::unconverged) {
    if (!*unknown)
      *unknown = Unknown{trial.value, trial.value};
    else if (distance(bracket->stable) < std::abs((*unknown)->to_stable - bracket->stable.value))
      (*unknown)->to_stable = trial.value;
    else
      (*unknown)->to_moving = trial.value;
    return;
  }
  const bool stands = trial.verdict == Verdict::equilibrium;
  LimitTrial& end = stands ? bracket->stable : bracket->moving;
  // What was not known now lies outside the bracket when this trial is beyond it.
  if (*unknown) {
    const double start = stands ? (*unknown)->to_stable : (*unknown)->to_moving;
    if (distance(end) > std::abs(start - end.value)) unknown->reset();
  }
  end = trial;
}

}  // namespace

Bracket bisect(double low, double high, const BracketWidth& wanted, const TryValue& try_value) {
  Bracket bracket;
  const auto attempt = [&](double value) {
    ++bracket.trials;
    return try_value(value);
  };
  bracket.message = "interrupted";
  const std::optional<LimitTrial> at_low = attempt(low);
  const std::optional<LimitTrial> at_high = at_low ? attempt(high) : std::nullopt;
  if (!at_high) return bracket;
  for (const LimitTrial& end : {*at_low, *at_high}) {
    if (end.verdict != Verdict::unconverged) continue;
    bracket.message = fmt::format("not converged at {:g}, an end of the bracket", end.value);
    return bracket;
  }
  const bool low_stands = at_low->verdict == Verdict::equilibrium;
  if (at_low->verdict == at_high->verdict) {
    bracket.message = fmt::format("{} at both ends of the bracket, {:g} and {:g}",
                                  low_stands ? "stands" : "moves", low, high);
    return bracket;
  }
  bracket.stable = low_stands ? *at_low : *at_high;
  bracket.moving = low_stands ? *at_high : *at_low;
  const auto width = [&] { return std::abs(bracket.stable.value - bracket.moving.value); };
  std::optional<Unknown> unknown;
  while (true) {
    const double enough = std::max(wanted.absolute, wanted.relative * std::abs(bracket.middle()));
    bracket.narrow = width() <= enough;
    if (bracket.narrow) break;
    const double value = next_value(bracket, unknown);
    if (value == bracket.stable.value || value == bracket.moving.value) break;  // adjacent doubles
    const double nearest =
        std::min(std::abs(value - bracket.stable.value), std::abs(value - bracket.moving.value));
    if (unknown && nearest < 0.5 * enough) break;
    const std::optional<LimitTrial> trial = attempt(value);
    if (!trial) return bracket;
    take(*trial, &bracket, &unknown);
  }
  bracket.found = true;
  bracket.message =
      fmt::format("stands at {:.6g} (|v|/(g h) = {:.1e}), moves at {:.6g} ({:.1e})", bracket.stable.value,
                  bracket.stable.speed_ratio, bracket.moving.value, bracket.moving.speed_ratio);
  if (unknown)
    bracket.message += fmt::format("; not known from {:.6g} to {:.6g}, where the solves do not converge",
                                   unknown->to_stable, unknown->to_moving);
  return bracket;
}

}  // namespace cupola
