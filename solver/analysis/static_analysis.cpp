#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/error.hpp"
#include "assembly/program.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/record.hpp"
#include "solver/contact/newton.hpp"
#include "solver/contact/residuals.hpp"
#include "solver/dynamics/equilibrium.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "solver/dynamics/time_step.hpp"

namespace cupola {
namespace {

constexpr double kMovingRatio = 2e-3;  // |v| / (g h) above which nothing holds the structure (SOLVERS.md 4)
constexpr int kMaxSolves = 8;
constexpr double kSolveShare = 0.1;  // of the asked residual is left to the solve, the rest to inertia

/// One trial: the answer of the contact problem at one h and what it is worth.
struct Trial {
  double h = 0.0;
  ContactProblem problem;
  ContactSolution solution;
  SolveSummary solve;
  Residuals residuals;
  std::vector<Vec3> forces;  // N, world, on b
  Equilibrium balance;
  double speed_ratio = 0.0;  // max |v| / (g h)
};

double fastest(const VecX& v) {
  double speed = 0.0;
  for (Eigen::Index i = 0; i < v.size(); i += 6) speed = std::max(speed, v.segment<3>(i).norm());
  return speed;
}

/// First guess of h. A displacement d reached in one step costs the inertia m d / h^2, so h^2 >= d / (g tol).
/// The crown sinks by about c F at the support's contacts, once per course.
double first_step(const Model& model, const State& rest, const ContactSet& contacts, double acceleration,
                  double tolerance) {
  double compliance = 0.0;
  int at_supports = 0;
  for (const Contact& contact : contacts.contacts) {
    compliance = std::max(compliance, joint_law(model, contact).compliance_normal);
    if (model.free_index[contact.block_a] == ContactProblem::kFixed ||
        model.free_index[contact.block_b] == ContactProblem::kFixed)
      ++at_supports;
  }
  double load = 0.0;
  const VecX f = applied_forces(model, rest);
  for (Eigen::Index i = 0; i < f.size(); i += 6) load += f.segment<3>(i).norm();
  const double courses =
      model.assembly->num_rings > 0 ? model.assembly->num_rings : std::cbrt(model.num_free());
  const double displacement = courses * compliance * load / std::max(1, at_supports);
  if (displacement == 0.0) return 1.0;
  return 2.0 * std::sqrt(displacement / (acceleration * tolerance));
}

Trial solve_trial(const Model& model, const State& rest, const ContactSet& contacts,
                  const ContactMemories& memories, const NewtonOptions& options, double h,
                  NewtonSolver* solver) {
  Trial trial;
  trial.h = h;
  StepOptions step;
  step.h = h;
  trial.problem = build_contact_problem(model, rest, contacts, memories, step);
  trial.solve = solver->solve(trial.problem, options, &trial.solution);
  trial.residuals = compute_residuals(trial.problem, trial.solution, options.reference_speed);
  trial.forces = world_forces(contacts, trial.solution.gamma, h);
  trial.balance = compute_equilibrium(model, rest, contacts, trial.forces);
  trial.speed_ratio = fastest(trial.solution.v) / options.reference_speed;
  return trial;
}

/// The state after the single step: displacement h v, and gaps as they end up.
Frame static_frame(const Model& model, const State& rest, const ContactSet& contacts,
                   ContactMemories memories, const Trial& trial) {
  State moved = rest;
  moved.v = trial.solution.v;
  integrate_positions(model, trial.h, &moved);
  std::vector<Vec3> displacement(moved.poses.size());
  for (size_t block = 0; block < displacement.size(); ++block)
    displacement[block] = moved.poses[block].p_WB - rest.poses[block].p_WB;
  moved.v.setZero();  // equilibrium: the step's velocity is only the displacement's carrier

  StepOptions step;
  step.h = trial.h;
  update_memories(trial.problem, trial.solution, rest, contacts, step, &memories);
  ContactSet ended = contacts;
  const VecX u = relative_velocity(trial.problem, trial.solution.v);
  for (size_t i = 0; i < ended.contacts.size(); ++i)
    ended.contacts[i].gap += trial.h * u[3 * static_cast<Eigen::Index>(i)];
  return make_frame(model, moved, ended, trial.forces, memories, displacement);
}

void judge(const Case& scene, const Trial& trial, bool moving, Summary* summary) {
  const double asked = scene.analysis.tolerance;
  summary->accuracy_asked = asked;
  summary->accuracy_reached = trial.balance.residual;
  if (moving) {
    summary->status = Status::moving;
    summary->message = fmt::format(
        "no equilibrium: |v|/(g h) = {:.3e} at h = {:.3g} s does not fall below {:.0e} as h grows",
        trial.speed_ratio, trial.h, kMovingRatio);
    summary->accuracy_reached = trial.residuals.momentum;
  } else if (trial.solve.ending == SolveEnding::converged && trial.balance.residual <= asked) {
    summary->status = Status::stable;
    summary->message = fmt::format("equilibrium residual {:.2e} <= {:.2e} asked, h = {:.3g} s",
                                   trial.balance.residual, asked, trial.h);
  } else {
    summary->status = Status::unconverged;
    summary->message = fmt::format("equilibrium residual {:.2e} > {:.2e} asked, h = {:.3g} s: {}",
                                   trial.balance.residual, asked, trial.h, trial.solve.message);
  }
}

}  // namespace

Summary run_static(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks) {
  const Model model = make_model(scene, assembly);
  const State rest = state_at_rest(model);
  ContactDetector detector(assembly, detection_options(scene));
  const ContactSet& contacts = detector.update(rest.poses);
  const ContactMemories memories = match_memories({}, contacts.contacts);
  const double acceleration = reference_acceleration(model, rest);

  Summary summary;
  NewtonSolver solver;
  const double started = wall_seconds();
  double h = first_step(model, rest, contacts, acceleration, scene.analysis.tolerance);
  Trial trial;
  int fast_trials = 0;
  for (int k = 0; k < kMaxSolves; ++k) {
    NewtonOptions options;
    options.tolerance = kSolveShare * scene.analysis.tolerance;
    options.reference_speed = h * acceleration;
    trial = solve_trial(model, rest, contacts, memories, options, h, &solver);
    summary.iterations += trial.solve.iterations;
    sinks.log(
        fmt::format("static  h {:9.3e} s  iterations {:3d}  momentum {:9.2e}  law {:9.2e}  "
                    "equilibrium {:9.2e}  |v|/(g h) {:9.2e}",
                    h, trial.solve.iterations, trial.residuals.momentum, trial.residuals.contact_law,
                    trial.balance.residual, trial.speed_ratio));
    if (trial.solve.ending != SolveEnding::converged || trial.balance.residual <= scene.analysis.tolerance)
      break;
    fast_trials = trial.speed_ratio > kMovingRatio ? fast_trials + 1 : 0;
    if (fast_trials == 3) break;
    // The share falls with h^2; a little more than needed, and never a leap that starves the solve of digits.
    h *= std::clamp(2.0 * std::sqrt(trial.balance.residual / scene.analysis.tolerance), 2.0, 100.0);
  }
  summary.solve_time_seconds = wall_seconds() - started;

  const Frame frame = static_frame(model, rest, contacts, memories, trial);
  summarize_frame(frame, model, &summary);
  judge(scene, trial, fast_trials == 3, &summary);
  summary.analysis = "static";
  summary.steps = 1;
  summary.time_step_s = trial.h;
  summary.applied_load_N = trial.balance.applied_load;
  summary.support_reaction_N = trial.balance.support_reaction;
  summary.inertia_share = trial.balance.inertia_share;
  summary.equilibrium_residual = trial.balance.residual;
  summary.momentum_residual = trial.residuals.momentum;
  summary.contact_law_residual = trial.residuals.contact_law;
  summary.friction_cone_violation = trial.residuals.cone_violation;
  summary.certified_force_error = trial.residuals.certified_force_error;
  sinks.frame(frame);
  return summary;
}

}  // namespace cupola
