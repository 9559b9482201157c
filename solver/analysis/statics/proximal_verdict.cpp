#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/model/joint_rule.hpp"
#include "solver/analysis/statics/proximal_point.hpp"
#include "solver/analysis/statics/static_step.hpp"
#include "solver/contact/problem/kinematic_bound.hpp"

namespace cupola {
namespace {

/// Lower bound of the sum of normal forces of any equilibrium, over the sum found or the sum of the loads if
/// that is larger, from which a motion counts as proven.
constexpr double kProven = 100.0;

/// A lower bound with two digits, rounded down.
std::string times_text(double times) {
  constexpr double kReadable = 1e6;
  if (times > kReadable) return "a million";
  const double digit = std::pow(10.0, std::floor(std::log10(std::max(times, 1.0))) - 1.0);
  return fmt::format("{:g}", std::floor(times / digit) * digit);
}

}  // namespace

/// Lower bound of the sum of the normal forces of any equilibrium, from the motion, over the larger of the
/// sum found and the sum of the loads.
double ProximalPoint::proof(const StaticSolution& trial) const {
  double loads = 0.0;
  const VecX f = applied_forces(model_, start_, start_.time + options_.time_advance);
  for (Eigen::Index i = 0; i < f.size(); i += 6) loads += f.segment<3>(i).norm();
  return required_normal_force(step_.problem, trial.increment / trial.h) /
         std::max(loads, normal_force_sum(step_.problem, trial.step_solution.gamma));
}

/// True if `count` iterations in a row left the residual as it was and the blocks move.
bool ProximalPoint::moves_steadily(double contraction, int count) {
  constexpr double kSteady = 0.05;
  const bool steady = std::abs(contraction - 1.0) < kSteady && trial_.speed_ratio > kAtRest;
  num_steady_ = steady ? num_steady_ + 1 : 0;
  return num_steady_ >= count;
}

/// True if blocks have moved by 100 times the settlement since the residual last fell by a quarter below its lowest
/// value. During a collapse it fluctuates above that value.
bool ProximalPoint::moves_far() {
  constexpr double kFall = 0.75, kFar = 100.0;
  // Heads softer than the bed engage after a slip that is long compared with the settlement on the bed.
  constexpr double kShareOfBlock = 0.05;
  if (residual_ < kFall * lowest_residual_) {
    lowest_residual_ = residual_;
    travel_ = 0.0;
    return false;
  }
  travel_ += largest_speed(moved_);
  const double far = options_.follow_from_start
                         ? std::max(kFar * settlement_, kShareOfBlock * smallest_block_size(*model_.assembly))
                         : kFar * settlement_;
  return trial_.speed_ratio > kAtRest && travel_ > far;
}

StaticSolution ProximalPoint::finish(StaticOutcome outcome, std::string message) {
  StaticSolution answer = std::move(outcome == StaticOutcome::unconverged && best_.h > 0.0 ? best_ : trial_);
  answer.iterations = trial_.iterations;
  answer.outcome = outcome;
  answer.message = std::move(message);
  x_ = {};
  if (answer.h != trial_.h || answer.time_advance != options_.time_advance) {
    options_.time_advance = answer.time_advance;
    set_step(answer.h);
  }
  answer.step = std::move(step_);
  if (answer.increment.size() > 0)
    answer.step.problem.v_star += answer.step_solution.v - answer.increment / answer.h;
  return answer;
}

/// The verdict on a scene whose last iteration left the residual above half of the one before. None: go on.
std::optional<StaticSolution> ProximalPoint::judge_motion(double contraction) {
  constexpr int kMoving = 3, kUnproven = 15;  // steady iterations until the search ends
  const double needed = proof(trial_);
  const std::string acceleration =
      fmt::format("blocks accelerate at up to {:.3g} m/s2", trial_.speed_ratio * acceleration_);
  if (associated_ && needed >= kProven)
    return finish(
        StaticOutcome::moving,
        fmt::format("no equilibrium exists: {}; contact forces that balance the loads would have to be at "
                    "least {} times as large as the loads",
                    acceleration, times_text(needed)));
  const bool steady =
      !follows_path_ ? moves_steadily(contraction, associated_ ? kUnproven : kMoving) : moves_far();
  if (!steady) return {};
  if (associated_)
    return finish(
        StaticOutcome::unconverged,
        fmt::format(
            "{} in {}, but it is not proven that no equilibrium exists: contact forces {:.2g} times as "
            "large as the loads might balance them, and the proof requires {:g} times",
            acceleration, counted(kUnproven, "iteration"), needed, kProven));
  const std::string way =
      follows_path_ ? fmt::format(" and have moved by {:.3g} m, {:.0f} times their first settlement", travel_,
                                  travel_ / settlement_)
                    : "";
  return finish(
      StaticOutcome::moving,
      fmt::format("a steady motion was found: {}{}; not proven: other contact forces might balance the loads",
                  acceleration, way));
}

/// The verdict on a contact solve that is too inexact to start the next iteration from. None: the step was shortened.
std::optional<StaticSolution> ProximalPoint::judge_failed_solve() {
  if (trial_.solve.usable() && best_.h == 0.0) best_ = trial_;
  if (accepts(trial_)) return finish_accepted();
  if (shorten_step()) return {};
  return finish(StaticOutcome::unconverged,
                fmt::format("the contact problem was not solved: {}", trial_.solve.message));
}

StaticSolution ProximalPoint::finish_accepted() {
  std::string message = fmt::format("equilibrium residual {:.2e} <= tolerance {:.2e}",
                                    trial_.balance.residual, options_.tolerance);
  if (trial_.residuals.contact_law > options_.tolerance)  // accepted as rounding: say so
    message += "; " + residuals_text(trial_.residuals, options_.tolerance);
  return finish(StaticOutcome::equilibrium, message);
}

/// The last iterate becomes the start of the next one. Returns by how much it reduced the residual.
double ProximalPoint::advance() {
  constexpr double kFarFromBalance = 1e-6;  // residual above which the path keeps its momentum
  constexpr double kSlow = 0.7;             // contraction from which blocks slide slowly over a long way
  if (settlement_ == 0.0) settlement_ = trial_.h * largest_speed(trial_.step_solution.v);
  const double contraction = trial_.balance.residual / residual_;
  residual_ = trial_.balance.residual;
  x_ = trial_.step_solution;
  const bool slides = follows_path_ && contraction > kSlow && residual_ > kFarFromBalance;
  flow_ = slides ? VecX(moved_ / (trial_.h * trial_.h)) : VecX();
  if (best_.h == 0.0 || residual_ < best_.balance.residual) best_ = trial_;
  return contraction;
}

StaticSolution ProximalPoint::run() {
  constexpr int kMaxSolves = 40, kMaxSolvesOfPath = 250;
  constexpr double kNoProgress = 0.5;  // contraction from which blocks may be moving
  const int max_solves = follows_path_ ? kMaxSolvesOfPath : kMaxSolves;
  for (int k = 0; k < max_solves; ++k) {
    iterate();
    options_.log(fmt::format(
        "static  h {:9.3e} s  iterations {:3d}  momentum {:9.2e}  law {:9.2e}  equilibrium {:9.2e}  "
        "increment/(g h^2) {:9.2e}",
        trial_.h, trial_.solve.iterations, trial_.residuals.momentum, trial_.residuals.contact_law,
        trial_.balance.residual, trial_.speed_ratio));
    if (!is_accurate_enough(trial_)) {
      if (std::optional<StaticSolution> answer = judge_failed_solve()) return std::move(*answer);
      continue;
    }
    if (accepts(trial_)) return finish_accepted();
    const double contraction = advance();
    if (contraction > kNoProgress && trial_.speed_ratio > kAtRest && !options_.control)
      if (std::optional<StaticSolution> answer = judge_motion(contraction)) return std::move(*answer);
    speed_up(contraction);
  }
  if (options_.control && std::abs(reached_) > options_.control->displacement)
    return finish(
        StaticOutcome::unconverged,
        fmt::format("no time from {:g} to {:g} s gives the control displacement of the step, {:.3g} m",
                    options_.control->earliest, options_.control->latest, options_.control->displacement));
  return finish(StaticOutcome::unconverged,
                fmt::format("equilibrium residual {:.2e} > tolerance {:.2e} after {}", best_.balance.residual,
                            options_.tolerance, counted(max_solves, "solve")));
}

}  // namespace cupola
