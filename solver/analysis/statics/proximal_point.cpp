#include "solver/analysis/statics/proximal_point.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/base/error.hpp"
#include "solver/analysis/statics/cyclic_reduction.hpp"
#include "solver/analysis/statics/static_step.hpp"
#include "solver/contact/methods/newton.hpp"

namespace cupola {
namespace {

/// Newton iterations within which a point of the path converges, or h is too large.
constexpr int kIterationsOfPath = 15;

/// Solves the whole problem, or one sector of it if the model has cyclic symmetry.
SolveSummary solve_problem(const ContactProblem& problem, const CyclicSymmetry* symmetry,
                           const ContactSolverOptions& options, ContactSolver* solver,
                           ContactSolution* solution) {
  if (!symmetry) return solver->solve(problem, options, solution);
  ContactSolution sector = restrict(*solution, *symmetry);
  SolveSummary summary = solver->solve(reduce(problem, *symmetry), options, &sector);
  *solution = expand(sector, problem, *symmetry);
  return summary;
}

}  // namespace

double weight_over_load(const Model& model, double acceleration) {
  return model.block_weight > 0.0 ? model.loads.gravity.norm() / acceleration : 1.0;
}

ProximalPoint::ProximalPoint(const Model& model, const State& start, const ContactSet& contacts,
                             const ContactMemories& memories, const StaticOptions& options)
    : model_(model),
      start_(start),
      contacts_(contacts),
      memories_(memories),
      options_(options),
      associated_(options.solve.law.is_associated()),
      acceleration_(reference_acceleration(model, start)),
      largest_h_(largest_static_step(model, start, contacts)) {
  follows_path_ = !associated_ && !options.control && options.solve.method == ContactMethod::newton &&
                  std::isfinite(largest_h_);
  set_step(first_static_step(model, start, contacts, acceleration_, options));
}

/// Sets h and converts the last iterate: d = h v and F = gamma / h stay.
void ProximalPoint::set_step(double h) {
  if (x_.v.size() > 0) x_.v *= trial_.h / h;
  if (x_.gamma.size() > 0) x_.gamma *= h / trial_.h;
  trial_.h = h;
  step_ = build_step_problem(model_, start_, contacts_, memories_, static_step_options(options_, h));
}

/// Tolerance of the next contact solve: a small part of the last residual, as an inexact proximal-point
/// method requires, but no smaller than the answer requires.
double ProximalPoint::solve_tolerance() const {
  const double kCoarse = follows_path_ ? 0.1 : 1e-4;
  const double kShare = follows_path_ ? 0.03 : 1e-3;  // of the last residual
  constexpr double kRounding = 1e-12;                 // smallest tolerance that weight_over_load() may cause
  const double scale = weight_over_load(model_, acceleration_);
  const double own = kSolveShare * options_.tolerance;
  const double fine = std::max(own * scale, std::min(own, kRounding));
  return tightening_ * std::max(fine, std::min(kCoarse, kShare * residual_ * scale));
}

void ProximalPoint::iterate() {
  constexpr double kMomentum = 0.5;  // doubles the speed of a slow slide; 0.7 overshoots
  ContactSolverOptions solve = options_.solve;
  solve.reference_speed = trial_.h * acceleration_;
  solve.tolerance = solve_tolerance();
  // After the first iteration few joints change their state, and the last factor is a good preconditioner.
  solve.lag_factor = !follows_path_ && x_.v.size() > 0 && !has_many_blocks(step_.problem);
  if (follows_path_ && !solve.max_iterations) solve.max_iterations = kIterationsOfPath;
  const VecX before = x_.v.size() > 0 ? x_.v : VecX::Zero(step_.problem.v_star.size());
  const bool slides = flow_.size() > 0;
  const VecX free = slides ? VecX(before + kMomentum * trial_.h * flow_) : before;  // without forces
  trial_.step_solution = x_;
  if (slides) trial_.step_solution.v = free;
  if (!options_.control) return attempt(solve, before, free);
  constexpr double kSmallest = 1e-13;  // tolerance that rounding admits
  const double share = control_share();
  solve.tolerance = std::max(kSmallest, std::min(solve.tolerance, kSolveShare * share));
  seek_time(share * trial_.h * trial_.h * acceleration_, [&] { attempt(solve, before, free); });
}

/// One contact solve from the guess in trial_. `before`: velocities of the last iterate; `free`: those without forces.
void ProximalPoint::attempt(const ContactSolverOptions& solve, const VecX& before, const VecX& free) {
  ContactProblem& problem = step_.problem;
  const VecX rest = problem.v_star;
  problem.v_star += free;
  trial_.time_advance = options_.time_advance;
  trial_.solve = solve_problem(problem, options_.symmetry, solve, &solver_, &trial_.step_solution);
  trial_.iterations += trial_.solve.iterations;
  if (!trial_.solve.usable()) {
    trial_.step_solution.v = free;
    trial_.step_solution.gamma = x_.gamma.size() > 0 ? x_.gamma : VecX::Zero(problem.b.size());
  }
  trial_.residuals = compute_residuals(problem, trial_.step_solution, solve.reference_speed, solve.law);
  problem.v_star = rest;
  CUPOLA_ASSERT(trial_.step_solution.v.allFinite() && trial_.step_solution.gamma.allFinite());
  trial_.increment = trial_.h * (trial_.step_solution.v - free);
  moved_ = trial_.h * (trial_.step_solution.v - before);
  trial_.speed_ratio = largest_speed(trial_.increment) / (trial_.h * solve.reference_speed);
  trial_.forces = joint_forces(contacts_, trial_.step_solution.gamma, step_.impulse_time);
  trial_.balance =
      compute_equilibrium(model_, start_, contacts_, trial_.forces, start_.time + options_.time_advance);
}

/// Judged by residuals that are computed independently of the contact method.
bool ProximalPoint::accepts(const StaticSolution& trial) const {
  return trial.solve.usable() && !misses_displacement(trial) &&
         trial.balance.residual <= options_.tolerance && excess(trial.residuals, options_.tolerance) <= 1.0;
}

/// True if the error of the contact solve is small compared with the imbalance that remains, so that the next
/// iteration may start from it.
bool ProximalPoint::is_accurate_enough(const StaticSolution& trial) const {
  constexpr double kShare = 1e-2;
  if (!trial.solve.usable()) return false;
  if (trial.solve.ending == SolveEnding::converged) return true;
  return std::max(trial.residuals.momentum, trial.residuals.contact_law) <= kShare * trial.speed_ratio;
}

/// A shorter step makes the contact problem easier, because inertia carries a larger share. False if this was
/// tried often enough or the user limits the iterations.
bool ProximalPoint::shorten_step() {
  constexpr int kMaxShortened = 4, kMaxShortenedOfPath = 60;
  constexpr double kFactor = 0.1, kPathFactor = 0.4;
  constexpr double kSettling = 0.0126;  // g h^2 is then of the size of the settlement (first_static_step())
  if (options_.solve.max_iterations ||
      ++num_shortened_ > (follows_path_ ? kMaxShortenedOfPath : kMaxShortened))
    return false;
  failed_h_ = trial_.h;
  set_step(trial_.h * (!follows_path_ ? kFactor : num_shortened_ == 1 ? kSettling : kPathFactor));
  return true;
}

/// After an iteration that reduced the residual by less than a digit: lengthens the step, because an elastic
/// mode of eigenvalue lambda contracts by 1 / (1 + h^2 lambda). Rigid joints do not contract; what remains at
/// rest is the error of the contact solve, summed over the courses.
void ProximalPoint::speed_up(double contraction) {
  constexpr double kBelowFailed = 0.7, kForgetting = 1.2, kNear = 1e-4;
  constexpr double kSlow = 0.1, kWanted = 1e-2, kSmallest = 2.0, kLargest = 10.0, kTightening = 0.1;
  if (contraction <= kSlow) return;
  if (trial_.speed_ratio <= kAtRest && std::isinf(largest_h_)) tightening_ *= kTightening;
  if (std::isinf(largest_h_)) return;
  if (follows_path_) {
    const int n = trial_.solve.iterations;
    const double factor = n <= 3 ? 2.5 : n <= 6 ? 1.6 : n <= 9 ? 1.0 : 0.7;
    // Just below a step that failed the next one fails too, until the structure has moved on.
    const double limit = std::min(largest_h_, std::max(kBelowFailed * failed_h_, trial_.h));
    failed_h_ *=
        residual_ < kNear ? factor : kForgetting;  // near equilibrium few contacts change their state
    const double h = std::min(limit, factor * trial_.h);
    if (h != trial_.h) set_step(h);
    return;
  }
  const double growth = contraction < 1.0 ? std::sqrt(contraction / (1.0 - contraction) / kWanted) : kLargest;
  const double h = std::min(largest_h_, std::clamp(growth, kSmallest, kLargest) * trial_.h);
  if (h > trial_.h) set_step(h);
}

}  // namespace cupola
