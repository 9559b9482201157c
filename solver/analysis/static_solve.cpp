#include "solver/analysis/static_solve.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace cupola {
namespace {

constexpr int kMaxSolves = 10;
constexpr double kSolveShare = 0.1;  // of the asked residual is left to the solve, the rest to inertia

/// First guess of h. A displacement d reached in one step costs the inertia m d / h^2, so h^2 >= d / (g tol).
/// The crown sinks by about c F at the support's contacts, once per course.
double first_step(const Model& model, const State& start, const ContactSet& contacts, double acceleration,
                  double tolerance) {
  double compliance = 0.0;
  int at_supports = 0;
  for (const Contact& contact : contacts.contacts) {
    compliance = std::max(compliance, joint_law(model, contacts, contact, start.time).compliance_normal);
    if (model.free_index[contact.block_a] == ContactProblem::kFixed ||
        model.free_index[contact.block_b] == ContactProblem::kFixed)
      ++at_supports;
  }
  double load = 0.0;
  const VecX f = applied_forces(model, start, start.time);
  for (Eigen::Index i = 0; i < f.size(); i += 6) load += f.segment<3>(i).norm();
  const double courses =
      model.assembly->num_rings > 0 ? model.assembly->num_rings : std::cbrt(model.num_free());
  const double displacement = courses * compliance * load / std::max(1, at_supports);
  if (displacement == 0.0) return 1.0;
  return 2.0 * std::sqrt(displacement / (acceleration * tolerance));
}

StepOptions step_options(const StaticOptions& options, double h) {
  StepOptions step;
  step.h = h;
  step.time_advance = options.time_advance;
  return step;
}

void solve_at(const Model& model, const State& start, const ContactSet& contacts,
              const ContactMemories& memories, const StaticOptions& options, double acceleration,
              ContactSolver* solver, StaticSolution* trial) {
  ContactSolverOptions solve;
  solve.method = options.method;
  solve.law = options.law;
  solve.tolerance = kSolveShare * options.tolerance;
  solve.reference_speed = trial->h * acceleration;
  trial->step = build_step_problem(model, start, contacts, memories, step_options(options, trial->h));
  trial->solution = {};
  trial->solve = solver->solve(trial->step.problem, solve, &trial->solution);
  trial->iterations += trial->solve.iterations;
  trial->residuals =
      compute_residuals(trial->step.problem, trial->solution, solve.reference_speed, solve.law);
  trial->forces = joint_forces(contacts, trial->solution.gamma, trial->h);
  trial->balance =
      compute_equilibrium(model, start, contacts, trial->forces, start.time + 0.5 * options.time_advance);
  trial->speed_ratio = largest_speed(trial->solution.v) / solve.reference_speed;
}

/// |v| / (g h) at one h.
struct SpeedTrial {
  double h, ratio;
};

/// Over the last two raises of h the ratio fell by less than the square root of what h grew: elastic
/// displacements make it fall with h^2.
bool keeps_moving(const std::vector<SpeedTrial>& trials) {
  if (trials.size() < 3) return false;
  const SpeedTrial& first = trials[trials.size() - 3];
  const SpeedTrial& middle = trials[trials.size() - 2];
  const SpeedTrial& last = trials.back();
  const auto falls_slowly = [](const SpeedTrial& a, const SpeedTrial& b) {
    return b.ratio > a.ratio * std::sqrt(a.h / b.h);
  };
  return falls_slowly(first, middle) && falls_slowly(middle, last);
}

void judge(const StaticOptions& options, bool moving, StaticSolution* trial) {
  if (moving) {
    trial->verdict = Verdict::moving;
    trial->message =
        fmt::format("no equilibrium: |v|/(g h) = {:.3e} at h = {:.3g} s no longer falls as h grows",
                    trial->speed_ratio, trial->h);
  } else if (trial->solve.ending == SolveEnding::converged && trial->balance.residual <= options.tolerance) {
    trial->verdict = Verdict::equilibrium;
    trial->message = fmt::format("equilibrium residual {:.2e} <= {:.2e} asked, h = {:.3g} s",
                                 trial->balance.residual, options.tolerance, trial->h);
  } else {
    trial->verdict = Verdict::unconverged;
    trial->message = fmt::format("equilibrium residual {:.2e} > {:.2e} asked, h = {:.3g} s: {}",
                                 trial->balance.residual, options.tolerance, trial->h, trial->solve.message);
  }
}

}  // namespace

StaticSolution solve_static(const Model& model, const State& start, const ContactSet& contacts,
                            const ContactMemories& memories, const StaticOptions& options) {
  const double acceleration = reference_acceleration(model, start);
  ContactSolver solver;
  StaticSolution trial;
  trial.h = first_step(model, start, contacts, acceleration, options.tolerance);
  std::vector<SpeedTrial> trials;
  for (int k = 0; k < kMaxSolves; ++k) {
    solve_at(model, start, contacts, memories, options, acceleration, &solver, &trial);
    options.log(
        fmt::format("static  h {:9.3e} s  iterations {:3d}  momentum {:9.2e}  law {:9.2e}  "
                    "equilibrium {:9.2e}  |v|/(g h) {:9.2e}",
                    trial.h, trial.solve.iterations, trial.residuals.momentum, trial.residuals.contact_law,
                    trial.balance.residual, trial.speed_ratio));
    if (trial.solve.ending != SolveEnding::converged || trial.balance.residual <= options.tolerance) break;
    trials.push_back({trial.h, trial.speed_ratio});
    if (keeps_moving(trials)) break;
    // The share falls with h^2; a little more than needed, and never a leap that starves the solve of digits.
    trial.h *= std::clamp(2.0 * std::sqrt(trial.balance.residual / options.tolerance), 2.0, 100.0);
  }
  judge(options, keeps_moving(trials), &trial);
  return trial;
}

LoadedState loaded_state(const Model& model, const State& start, const ContactSet& contacts,
                         const ContactMemories& memories, const StaticSolution& solution,
                         const StaticOptions& options) {
  LoadedState loaded{start, memories};
  loaded.state.v = solution.solution.v;
  integrate_positions(model, solution.h, options.time_advance, &loaded.state);
  loaded.state.v.setZero();  // equilibrium: the step's velocity is only the displacement's carrier
  update_memories(solution.step, solution.solution, start, contacts, step_options(options, solution.h),
                  &loaded.memories);
  for (ContactMemory& memory : loaded.memories.values) memory.impulse /= solution.h;
  for (double& impulse : loaded.memories.tie_impulses) impulse /= solution.h;
  return loaded;
}

}  // namespace cupola
