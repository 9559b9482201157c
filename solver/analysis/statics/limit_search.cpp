#include "solver/analysis/statics/limit_search.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// Interval inside a bracket in which trials did not converge.
struct Undecided {
  double to_stable, to_moving;  ///< its ends, towards the stable and the moving end of the bracket
};

/// The next value to try: the middle of the bracket or, if there is an undecided interval, the middle of the
/// wider of the two intervals beside it.
double next_value(const Bracket& bracket, const std::optional<Undecided>& undecided) {
  if (!undecided) return bracket.middle();
  const double left = 0.5 * (undecided->to_stable - bracket.stable.value);
  const double right = 0.5 * (undecided->to_moving - bracket.moving.value);
  return std::abs(left) >= std::abs(right) ? bracket.stable.value + left : bracket.moving.value + right;
}

/// Updates the bracket and the undecided interval with a trial inside the bracket.
void update(const LimitTrial& trial, Bracket* bracket, std::optional<Undecided>* undecided) {
  const auto distance = [&](const LimitTrial& end) { return std::abs(trial.value - end.value); };
  if (trial.outcome == StaticOutcome::unconverged) {
    if (!*undecided)
      *undecided = Undecided{trial.value, trial.value};
    else if (distance(bracket->stable) < std::abs((*undecided)->to_stable - bracket->stable.value))
      (*undecided)->to_stable = trial.value;
    else
      (*undecided)->to_moving = trial.value;
    return;
  }
  const bool stands = trial.outcome == StaticOutcome::equilibrium;
  LimitTrial& end = stands ? bracket->stable : bracket->moving;
  // If this trial lies beyond the undecided interval, the interval is now outside the bracket.
  if (*undecided) {
    const double start = stands ? (*undecided)->to_stable : (*undecided)->to_moving;
    if (distance(end) > std::abs(start - end.value)) undecided->reset();
  }
  end = trial;
}

}  // namespace

Sought at_both_ends(bool stands, double low, double high) {
  return {.reason = fmt::format("the structure {} at both ends of the bracket, {:g} and {:g}",
                                stands ? "stands" : "moves", low, high),
          .advice = stands ? "widen the bracket" : "it must stand at one"};
}

Sought concluded(Sought sought, Status status) {
  if (stands(status)) {
    if (sought.found.empty()) sought.found = "not found";
  } else if (moves(status)) {
    sought.found = sought.also.empty() ? "none" : "not found";
    sought.advice.clear();  // no other bracket helps what falls by itself
  } else {
    sought.found = "unknown";
  }
  return sought;
}

Bracket bisect(double low, double high, const BracketWidth& required, const TryValue& try_value) {
  CUPOLA_ASSERT(low <= high);
  Bracket bracket;
  const auto attempt = [&](double value) {
    ++bracket.trials;
    return try_value(value);
  };
  bracket.sought.reason = "interrupted";
  const std::optional<LimitTrial> at_low = attempt(low);
  const std::optional<LimitTrial> at_high = at_low ? attempt(high) : std::nullopt;
  if (!at_high) return bracket;
  for (const LimitTrial& end : {*at_low, *at_high}) {
    if (end.outcome != StaticOutcome::unconverged) continue;
    bracket.sought = {
        .reason = fmt::format("the solve at {:g}, one end of the bracket, did not converge", end.value),
        .advice = "move that end"};
    return bracket;
  }
  const bool low_stands = at_low->outcome == StaticOutcome::equilibrium;
  if (at_low->outcome == at_high->outcome) {
    bracket.at_both_ends = at_low->outcome;
    bracket.sought = at_both_ends(low_stands, low, high);
    return bracket;
  }
  bracket.stable = low_stands ? *at_low : *at_high;
  bracket.moving = low_stands ? *at_high : *at_low;
  const auto width = [&] { return std::abs(bracket.stable.value - bracket.moving.value); };
  std::optional<Undecided> undecided;
  while (true) {
    const double size = std::abs(bracket.middle());
    const double enough =
        std::max({required.absolute, required.relative * size, size <= required.zero ? required.zero : 0.0});
    bracket.narrow = width() <= enough;
    if (bracket.narrow) break;
    const double value = next_value(bracket, undecided);
    // Between adjacent doubles the middle is one of them.
    if (value == bracket.stable.value || value == bracket.moving.value) break;
    if (undecided && (value == undecided->to_stable || value == undecided->to_moving)) break;
    const double nearest =
        std::min(std::abs(value - bracket.stable.value), std::abs(value - bracket.moving.value));
    if (undecided && nearest < 0.25 * enough) break;
    const std::optional<LimitTrial> trial = attempt(value);
    if (!trial) return bracket;
    update(*trial, &bracket, &undecided);
  }
  bracket.found = true;
  bracket.sought.reason =
      fmt::format("stands at {:.6g} (|v|/(g h) = {:.1e}), moves at {:.6g} ({:.1e})", bracket.stable.value,
                  bracket.stable.speed_ratio, bracket.moving.value, bracket.moving.speed_ratio);
  if (undecided)
    bracket.sought.reason +=
        fmt::format("; undecided from {:.6g} to {:.6g}, where the solves did not converge",
                    undecided->to_stable, undecided->to_moving);
  return bracket;
}

}  // namespace cupola
