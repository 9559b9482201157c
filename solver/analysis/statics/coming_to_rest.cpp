#include "solver/analysis/statics/coming_to_rest.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "solver/contact/methods/newton.hpp"
#include "solver/contact/problem/cone.hpp"

// The verdict on motions is in proximal_verdict.cpp.

namespace cupola {
namespace {

// Nearby the first solve is to be the last. The usual first step suits structures that settle under all their
// weight.
constexpr double kLonger = 30.0;

}  // namespace

ComingToRest::ComingToRest(const Model& model, const State& start, const ContactSet& contacts,
                           const ContactMemories& memories, const StaticOptions& options, Start from)
    : ProximalPoint(
          model, start, contacts, memories, options,
          from == Start::nearby ? Pace{40, options.tolerance, 1e-3, kLonger} : Pace{40, 1e-4, 1e-3}) {}

bool ComingToRest::start_from_rest(const std::vector<int>& new_blocks) {
  const ContactProblem& problem = step_.problem;
  if (first_rigid_contact(problem)) return false;
  x_.v = VecX::Zero(problem.v_star.size());
  for (const int block : new_blocks) {
    Mat6 H = problem.M[block];
    Eigen::Matrix<double, 6, 1> impulse = H * problem.v_star.segment<6>(6 * block);
    for (int i = 0; i < problem.num_contacts(); ++i) {
      if (problem.block_a[i] != block && problem.block_b[i] != block) continue;
      const Mat63& D = problem.block_a[i] == block ? problem.D_a[i] : problem.D_b[i];
      const Mat63 DG = D * sticking_stiffness(contact_law(problem, i));
      H += DG * D.transpose();
      impulse -= DG * problem.b.segment<3>(3 * i);
    }
    x_.v.segment<6>(6 * block) = H.llt().solve(impulse);
  }
  return true;
}

void ComingToRest::iterate() {
  ContactSolverOptions solve = solve_options();
  solve.tolerance *= tightening_;
  // After the first iteration few joints change their state, and the last factor is a good preconditioner.
  solve.lag_factor = x_.v.size() > 0 && !has_many_blocks(step_.problem);
  const VecX before = x_.v.size() > 0 ? x_.v : VecX::Zero(step_.problem.v_star.size());
  trial_.step_solution = x_;
  if (!options_.control) return attempt(solve, before, before);
  constexpr double kSmallest = 1e-13;  // tolerance that rounding admits
  const double share = control_share();
  solve.tolerance = std::max(kSmallest, std::min(solve.tolerance, kSolveShare * share));
  seek_time(share * trial_.h * trial_.h * acceleration_, [&] { attempt(solve, before, before); });
}

bool ComingToRest::shorten_step() {
  constexpr int kMaxShortened = 4;
  constexpr double kFactor = 0.1;
  if (++num_shortened_ > kMaxShortened) return false;
  set_step(trial_.h * kFactor);
  return true;
}

/// After an iteration that reduced the residual by less than a digit: lengthens the step, because an elastic
/// mode of eigenvalue lambda contracts by 1 / (1 + h^2 lambda). Rigid joints do not contract; what remains at
/// rest is the error of the contact solve, summed over the courses.
void ComingToRest::adapt(double contraction) {
  constexpr double kSlow = 0.1, kWanted = 1e-2, kSmallest = 2.0, kLargest = 10.0, kTightening = 0.1;
  if (contraction <= kSlow) return;
  if (std::isinf(largest_h_)) {
    if (trial_.speed_ratio <= kAtRest) tightening_ *= kTightening;
    return;
  }
  const double growth = contraction < 1.0 ? std::sqrt(contraction / (1.0 - contraction) / kWanted) : kLargest;
  const double h = std::min(largest_h_, std::clamp(growth, kSmallest, kLargest) * trial_.h);
  if (h > trial_.h) set_step(h);
}

/// By how much the next iterate may miss the control displacement, over g h^2: in the iteration after it, the
/// rest appears as inertia.
double ComingToRest::control_share() const {
  constexpr double kShare = 1e-2;  // of the residual, and of the displacement
  const double largest = kShare * options_.control->displacement / (trial_.h * trial_.h * acceleration_);
  return std::min(largest, std::max(kSolveShare * options_.tolerance, kShare * residual_) *
                               weight_over_load(model_, acceleration_));
}

/// Finds the time at which the iterate has the control displacement, to a tolerance (m).
void ComingToRest::seek_time(double tolerance, const std::function<void()>& attempt_now) {
  const LengthControl& control = *options_.control;
  std::optional<double> last_time;
  const auto missing = [&](double time) -> std::optional<double> {
    if (time - start_.time != options_.time_advance) {
      options_.time_advance = time - start_.time;
      set_step(trial_.h);
    }
    attempt_now();
    if (!trial_.solve.usable()) return std::nullopt;
    const double before = reached_;
    reached_ = control_displacement(model_, start_, control, time, trial_.h * trial_.step_solution.v) -
               control.displacement;
    if (last_time) time_slope_ = std::abs((reached_ - before) / (time - *last_time));
    last_time = time;
    return reached_;
  };
  RootSearch search{control.earliest,  control.latest, start_.time + options_.time_advance,
                    control.time_step, time_slope_,    tolerance};
  find_root(search, missing);
}

/// True if no time gave the control displacement. At the latest time it may be missing.
bool ComingToRest::misses_displacement(const StaticSolution& trial) const {
  constexpr double kMiss = 0.1;  // of the displacement of a step
  if (!options_.control || std::abs(reached_) <= kMiss * options_.control->displacement) return false;
  return reached_ > 0.0 || trial.time_advance != options_.control->latest - start_.time;
}

bool ComingToRest::accepts(const StaticSolution& trial) const {
  return !misses_displacement(trial) && ProximalPoint::accepts(trial);
}

StaticSolution ComingToRest::give_up() {
  if (!options_.control || std::abs(reached_) <= options_.control->displacement)
    return ProximalPoint::give_up();
  return finish(
      StaticOutcome::unconverged,
      fmt::format("no time from {:g} to {:g} s gives the control displacement of the step, {:.3g} m",
                  options_.control->earliest, options_.control->latest, options_.control->displacement));
}

}  // namespace cupola
