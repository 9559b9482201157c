#include "solver/analysis/construction/least_search.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

namespace cupola {

LeastSearch::Result LeastSearch::find(const TryValue& solve) {
  using enum StaticOutcome;
  std::map<double, LimitTrial> known;
  int solves = 0;
  const TryValue attempt = [&](double value) -> std::optional<LimitTrial> {
    if (const auto found = known.find(value); found != known.end()) return found->second;
    ++solves;
    const std::optional<LimitTrial> trial = solve(value);
    if (trial) known.emplace(value, *trial);
    return trial;
  };
  Result result;
  if (!last_) {  // many structures need none
    const std::optional<LimitTrial> at_zero = attempt(0.0);
    result.needs_none = at_zero && at_zero->outcome == equilibrium;
    if (!at_zero || result.needs_none) return result;
  }
  double low = last_ ? last_->second : 0.0, high = last_ ? last_->first : first_;
  // 1. Upwards to a value at which it stands
  double growth = last_ ? 1.0 + 2.0 * width_.relative : 2.0;
  while (true) {
    const std::optional<LimitTrial> trial = attempt(high);
    if (!trial) return result;
    if (trial->outcome == equilibrium) break;
    if (trial->outcome == moving) low = std::max(low, high);
    if (high >= most_) {
      if (trial->outcome == moving) result.bracket.moving = *trial;
      result.bracket.message =
          fmt::format("{} at {:g}, the largest value tried", to_string(trial->outcome), high);
      return result;
    }
    high = std::min(most_, growth * high);
    growth = 2.0;
  }
  // 2. Downwards to a value at which it moves
  while (true) {
    const std::optional<LimitTrial> trial = attempt(low);
    if (!trial) return result;
    if (trial->outcome == moving) break;
    result.needs_none = low == 0.0 && trial->outcome == equilibrium;
    if (result.needs_none) return result;
    if (trial->outcome == equilibrium) high = std::min(high, low);
    if (low == 0.0) {
      result.bracket.message = "the solve at 0 did not converge";
      return result;
    }
    low = 0.0;
  }
  // 3. Between the two
  result.bracket = bisect(low, high, width_, attempt);
  result.bracket.trials = solves;
  if (result.bracket.found) last_ = {result.bracket.stable.value, result.bracket.moving.value};
  return result;
}

}  // namespace cupola
