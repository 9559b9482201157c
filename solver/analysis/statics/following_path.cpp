#include "solver/analysis/statics/following_path.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace cupola {

FollowingPath::FollowingPath(const Model& model, const State& start, const ContactSet& contacts,
                             const ContactMemories& memories, const StaticOptions& options,
                             double least_motion, std::function<StaticSolution()> shortcut)
    : ProximalPoint(model, start, contacts, memories, options, {250, 0.1, 0.03}),
      least_motion_(least_motion),
      shortcut_(std::move(shortcut)) {}

void FollowingPath::iterate() {
  constexpr int kIterations = 15;    // within which a point of the path converges, or h is too large
  constexpr double kMomentum = 0.5;  // doubles the speed of a slow slide; 0.7 overshoots
  ContactSolverOptions solve = solve_options();
  solve.lag_factor = false;
  if (!solve.max_iterations) solve.max_iterations = kIterations;
  const VecX before = x_.v.size() > 0 ? x_.v : VecX::Zero(step_.problem.v_star.size());
  const bool slides = flow_.size() > 0;
  const VecX free = slides ? VecX(before + kMomentum * trial_.h * flow_) : before;
  trial_.step_solution = x_;
  if (slides) trial_.step_solution.v = free;
  attempt(solve, before, free);
}

bool FollowingPath::shorten_step() {
  constexpr int kMaxShortened = 60;
  constexpr double kFactor = 0.4;
  constexpr double kSettling = 0.0126;  // g h^2 is then of the size of the settlement (first_static_step())
  if (++num_shortened_ > kMaxShortened) return false;
  failed_h_ = trial_.h;
  set_step(trial_.h * (num_shortened_ == 1 ? kSettling : kFactor));
  return true;
}

/// After an iteration that reduced the residual by less than a digit: the step follows the number of Newton
/// iterations.
void FollowingPath::adapt(double contraction) {
  constexpr double kSlow = 0.1, kBelowFailed = 0.7, kForgetting = 1.2, kNear = 1e-4;
  if (contraction <= kSlow) return;
  const int n = trial_.solve.iterations;
  const double factor = n <= 3 ? 2.5 : n <= 6 ? 1.6 : n <= 9 ? 1.0 : 0.7;
  // Just below a step that failed the next one fails too, until the structure has moved on.
  const double limit = std::min(largest_h_, std::max(kBelowFailed * failed_h_, trial_.h));
  failed_h_ *= residual_ < kNear ? factor : kForgetting;  // near equilibrium few contacts change their state
  const double h = std::min(limit, factor * trial_.h);
  if (h != trial_.h) set_step(h);
}

double FollowingPath::advance() {
  constexpr double kFarFromBalance = 1e-6;  // residual above which the path keeps its momentum
  constexpr double kSlow = 0.7;             // contraction from which blocks slide slowly over a long way
  if (settlement_ == 0.0) settlement_ = trial_.h * largest_speed(trial_.step_solution.v);
  const double contraction = ProximalPoint::advance();
  const bool slides = contraction > kSlow && residual_ > kFarFromBalance;
  flow_ = slides ? VecX(moved_ / (trial_.h * trial_.h)) : VecX();
  return contraction;
}

/// True if blocks have moved by 100 times the settlement since the residual last fell by a quarter below its
/// lowest value. During a collapse it fluctuates above that value.
bool FollowingPath::moves_slowly() {
  constexpr double kFall = 0.75, kFar = 100.0;
  if (residual_ < kFall * lowest_residual_) {
    lowest_residual_ = residual_;
    travel_ = 0.0;
    return false;
  }
  travel_ += largest_speed(moved_);
  return trial_.speed_ratio > kAtRest && travel_ > kFar * settlement_;
}

std::optional<StaticSolution> FollowingPath::judge_motion(double) {
  if (!moves_slowly()) return {};
  if (travel_ > least_motion_)
    return finish_moving(fmt::format(" and have moved by {:.3g} m, {:.0f} times their first settlement",
                                     travel_, travel_ / settlement_));
  if (!shortcut_) return {};
  StaticSolution found = std::exchange(shortcut_, nullptr)();
  trial_.iterations += found.iterations;
  if (found.outcome != StaticOutcome::equilibrium) return {};
  found.iterations = trial_.iterations;
  return found;
}

}  // namespace cupola
