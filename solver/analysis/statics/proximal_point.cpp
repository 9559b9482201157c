#include "solver/analysis/statics/proximal_point.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "solver/analysis/statics/cyclic_reduction.hpp"
#include "solver/analysis/statics/static_step.hpp"

namespace cupola {
namespace {

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
                             const ContactMemories& memories, const StaticOptions& options, const Pace& pace)
    : model_(model),
      start_(start),
      contacts_(contacts),
      memories_(memories),
      options_(options),
      acceleration_(reference_acceleration(model, start)),
      largest_h_(largest_static_step(model, start, contacts)),
      pace_(pace) {
  const double h = first_static_step(model, start, contacts, acceleration_, options);
  set_step(pace.first_step == 1.0 ? h : std::min(largest_h_, pace.first_step * h));
}

/// Sets h and converts the last iterate: d = h v and F = gamma / h stay.
void ProximalPoint::set_step(double h) {
  if (x_.v.size() > 0) x_.v *= trial_.h / h;
  if (x_.gamma.size() > 0) x_.gamma *= h / trial_.h;
  trial_.h = h;
  step_ = build_step_problem(model_, start_, contacts_, memories_, static_step_options(options_, h));
}

/// Options of the next contact solve. Its tolerance is no smaller than the answer requires.
ContactSolverOptions ProximalPoint::solve_options() const {
  constexpr double kRounding = 1e-12;  // smallest tolerance that weight_over_load() may cause
  ContactSolverOptions solve = options_.solve;
  solve.reference_speed = trial_.h * acceleration_;
  const double scale = weight_over_load(model_, acceleration_);
  const double own = kSolveShare * options_.tolerance;
  const double fine = std::max(own * scale, std::min(own, kRounding));
  solve.tolerance = std::max(fine, std::min(pace_.coarse, pace_.share * residual_ * scale));
  return solve;
}

/// One contact solve from the guess in trial_. `before`: velocities of the last iterate; `free`: those
/// without forces.
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
  return trial.solve.usable() && trial.balance.residual <= options_.tolerance &&
         excess(trial.residuals, options_.tolerance) <= 1.0;
}

/// True if the error of the contact solve is small compared with the imbalance that remains, so that the next
/// iteration may start from it.
bool ProximalPoint::is_accurate_enough() const {
  constexpr double kShare = 1e-2;
  if (!trial_.solve.usable()) return false;
  if (trial_.solve.ending == SolveEnding::converged) return true;
  return std::max(trial_.residuals.momentum, trial_.residuals.contact_law) <= kShare * trial_.speed_ratio;
}

double ProximalPoint::advance() {
  const double contraction = trial_.balance.residual / residual_;
  residual_ = trial_.balance.residual;
  x_ = trial_.step_solution;
  if (best_.h == 0.0 || residual_ < best_.balance.residual) best_ = trial_;
  return contraction;
}

/// The verdict on a contact solve that is too inexact to start the next iteration from. None: the step was
/// shortened.
std::optional<StaticSolution> ProximalPoint::judge_failed_solve() {
  if (trial_.solve.usable() && best_.h == 0.0) best_ = trial_;
  if (accepts(trial_)) return finish_accepted();
  if (!options_.solve.max_iterations && shorten_step()) return {};
  return finish(StaticOutcome::unconverged,
                fmt::format("the contact problem was not solved: {}", trial_.solve.message));
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

StaticSolution ProximalPoint::finish_accepted() {
  std::string message = fmt::format("equilibrium residual {:.2e} <= tolerance {:.2e}",
                                    trial_.balance.residual, options_.tolerance);
  if (trial_.residuals.contact_law > options_.tolerance)  // accepted as rounding: say so
    message += "; " + residuals_text(trial_.residuals, options_.tolerance);
  return finish(StaticOutcome::equilibrium, message);
}

std::string ProximalPoint::acceleration_text() const {
  return fmt::format("blocks accelerate at up to {:.3g} m/s2", trial_.speed_ratio * acceleration_);
}

StaticSolution ProximalPoint::finish_moving(const std::string& way) {
  return finish(StaticOutcome::moving,
                fmt::format("a steady motion was found: {}{}; other contact forces might balance the loads",
                            acceleration_text(), way));
}

StaticSolution ProximalPoint::give_up(int num_solves) {
  return finish(StaticOutcome::unconverged,
                fmt::format("equilibrium residual {:.2e} > tolerance {:.2e} after {}", best_.balance.residual,
                            options_.tolerance, counted(num_solves, "solve")));
}

StaticSolution ProximalPoint::run() {
  for (int k = 1; k <= pace_.max_solves; ++k) {
    iterate();
    options_.log(fmt::format(
        "static  h {:9.3e} s  iterations {:3d}  momentum {:9.2e}  law {:9.2e}  equilibrium {:9.2e}  "
        "increment/(g h^2) {:9.2e}",
        trial_.h, trial_.solve.iterations, trial_.residuals.momentum, trial_.residuals.contact_law,
        trial_.balance.residual, trial_.speed_ratio));
    if (!is_accurate_enough()) {
      if (std::optional<StaticSolution> answer = judge_failed_solve()) return std::move(*answer);
      continue;
    }
    if (accepts(trial_)) return finish_accepted();
    const double contraction = advance();
    if (residual_ > pace_.largest_residual) return give_up(k);
    if (may_be_moving(contraction) && trial_.speed_ratio > kAtRest)
      if (std::optional<StaticSolution> answer = judge_motion(contraction)) return std::move(*answer);
    adapt(contraction);
  }
  return give_up(pace_.max_solves);
}

}  // namespace cupola
