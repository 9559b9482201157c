#include "solver/analysis/construction/least_search.hpp"

#include <algorithm>
#include <functional>
#include <map>

#include <fmt/format.h>

namespace cupola {
namespace {

using enum StaticOutcome;

/// Solves no value twice.
class KnownTrials {
 public:
  explicit KnownTrials(const TryValue& solve) : solve_(solve) {}
  std::optional<LimitTrial> operator()(double value) {
    if (const auto found = known_.find(value); found != known_.end()) return found->second;
    ++solves;
    const std::optional<LimitTrial> trial = solve_(value);
    if (trial) known_.emplace(value, *trial);
    return trial;
  }
  /// The largest value below `high` at which it moves, if that is above `low`.
  double moving_below(double high, double low) const {
    for (const auto& [value, trial] : known_)
      if (trial.outcome == moving && value < high) low = std::max(low, value);
    return low;
  }
  int solves = 0;

 private:
  const TryValue& solve_;
  std::map<double, LimitTrial> known_;
};

/// Lowers `low` to a value at which it moves, and `high` to the least at which a trial stands. False, with
/// the reason in `result`, if it moves nowhere.
bool find_motion(KnownTrials* attempt, double* low, double* high, LeastSearch::Result* result) {
  for (const double value : {*low, 0.0}) {
    const std::optional<LimitTrial> trial = (*attempt)(value);
    if (!trial) return false;
    if (trial->outcome == moving) {
      *low = value;
      return true;
    }
    if (trial->outcome == equilibrium) *high = std::min(*high, value);
  }
  result->needs_none = *high == 0.0;
  if (result->needs_none) return false;
  result->bracket.stable = *(*attempt)(*high);
  result->bracket.sought.reason = "the solve at 0 did not converge";
  return false;
}

}  // namespace

/// Upwards from where the last structure stood or from the first value, then downwards if that may help.
std::vector<double> LeastSearch::values_to_try() const {
  std::vector<double> values = {last_ ? last_->first : first_};
  const double start = values.front();
  for (double growth = last_ ? 1.0 + 2.0 * width_.relative : 2.0; values.back() < most_; growth = 2.0)
    values.push_back(std::min(most_, growth * values.back()));
  if (more_bears_ == MoreBears::more) return values;
  for (double value = 0.5 * start; value > width_.absolute; value *= 0.5) values.push_back(value);
  return values;
}

LeastSearch::Result LeastSearch::find(const TryValue& solve) {
  KnownTrials attempt(solve);
  Result result;
  if (!last_) {  // many structures need none
    const std::optional<LimitTrial> at_zero = attempt(0.0);
    result.needs_none = at_zero && at_zero->outcome == equilibrium;
    if (!at_zero || result.needs_none) return result;
  }
  // 1. To a value at which it stands
  const std::vector<double> values = values_to_try();
  std::optional<LimitTrial> trial;
  for (const double value : values) {
    trial = attempt(value);
    if (!trial) return result;
    if (trial->outcome == equilibrium) break;
  }
  if (trial->outcome != equilibrium) {
    if (more_bears_ == MoreBears::more && trial->outcome == moving) result.bracket.moving = *trial;
    result.bracket.sought.reason =
        more_bears_ == MoreBears::more
            ? fmt::format("{} at {:g}, the largest value tried", to_string(trial->outcome), trial->value)
            : fmt::format("it stands at no value tried from {:g} to {:g}, of which more can bear less",
                          std::ranges::min(values), std::ranges::max(values));
    return result;
  }
  // 2. Downwards to a value at which it moves
  double high = trial->value, low = attempt.moving_below(high, last_ ? last_->second : 0.0);
  if (!find_motion(&attempt, &low, &high, &result)) return result;
  // 3. Between the two
  result.bracket = bisect(low, high, width_, std::ref(attempt));
  result.bracket.trials = attempt.solves;
  if (result.bracket.found && more_bears_ == MoreBears::more)
    last_ = {result.bracket.stable.value, result.bracket.moving.value};
  return result;
}

}  // namespace cupola
