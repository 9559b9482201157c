#include "solver/analysis/static_solve.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "solver/analysis/cyclic_reduction.hpp"
#include "solver/contact/methods/method_table.hpp"
#include "solver/contact/problem/kinematic_bound.hpp"

namespace cupola {
namespace {

constexpr int kMaxSolves = 10;
constexpr double kSolveShare = 0.1;  // of the asked residual is left to the solve, the rest to inertia

/// Largest displacement of a support in the step, m.
double imposed_displacement(const Model& model, const State& start, const StaticOptions& options) {
  std::vector<Pose> moved = start.poses;
  place_supports(*model.assembly, model.support_motions, start.time + options.time_advance, &moved);
  double largest = 0.0;
  for (size_t i = 0; i < moved.size(); ++i)
    largest = std::max(largest, (moved[i].p_WB - start.poses[i].p_WB).norm());
  return largest;
}

/// First guess of h. A displacement d reached in one step costs the inertia m d / h^2, so h^2 >= d / (g tol).
/// The crown sinks by about c F at the support's contacts, once per course.
double first_step(const Model& model, const State& start, const ContactSet& contacts, double acceleration,
                  const StaticOptions& options) {
  constexpr double kShortShare = 1e-2;  // inertia share to begin with where the structure may move
  const double tolerance = options.may_move ? std::max(kShortShare, options.tolerance) : options.tolerance;
  double compliance = 0.0;
  int at_supports = 0;
  for (const Contact& contact : contacts.points) {
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
  const double displacement =
      courses * compliance * load / std::max(1, at_supports) + imposed_displacement(model, start, options);
  if (displacement == 0.0) return 1.0;
  // Shells sink by more than their columns shorten, thin ones of many blocks by tens of times as much. Where
  // nothing moves a larger h costs nothing, and a second solve as much as the first: with 6 the inertia share
  // of a dome of 330,000 bricks is a quarter of the tolerance.
  const double margin = options.may_move ? 2.5 : 6.0;
  return margin * std::sqrt(displacement / (acceleration * tolerance));
}

StepOptions step_options(const StaticOptions& options, double h) {
  StepOptions step;
  step.h = h;
  step.time_advance = options.time_advance;
  return step;
}

/// Whether the equilibrium may be tried with one large h, because a failure shows early. Under Coulomb's law it
/// shows late with every method.
bool tries_at_once(const StaticOptions& options) {
  return !options.may_move && method_traits(options.method).fails_fast &&
         options.law == FrictionLaw::associated;
}

/// Relative momentum residual up to which a speed is known.
double known_to(double speed_ratio) {
  constexpr double kShare = 1e-2;
  return kShare * speed_ratio;
}

/// Solves the whole problem, or one sector of it.
SolveSummary solve_problem(const ContactProblem& problem, const CyclicSymmetry* symmetry,
                           const ContactSolverOptions& options, ContactSolver* solver,
                           ContactSolution* solution) {
  if (!symmetry) return solver->solve(problem, options, solution);
  ContactSolution sector = restrict(*solution, *symmetry);
  SolveSummary summary = solver->solve(reduce(problem, *symmetry), options, &sector);
  *solution = expand(sector, problem, *symmetry);
  return summary;
}

/// Equilibrium counts in mean block weights, a solve in the largest acceleration that a load gives to a
/// block: far more where the load stays and the blocks are made smaller.
double weight_over_load(const Model& model, double acceleration) {
  return model.block_weight > 0.0 ? model.loads.gravity.norm() / acceleration : 1.0;
}

/// Solves at trial->h. What moves fast is not solved finer than its verdict needs: its impulses lose digits
/// with h^2, and no answer to the full tolerance may exist in double precision.
/// `share`: of the asked residual that is left to the solve.
void solve_at(const Model& model, const State& start, const ContactSet& contacts,
              const ContactMemories& memories, const StaticOptions& options, double acceleration,
              double share, ContactSolver* solver, StaticSolution* trial) {
  constexpr double kCoarse = 1e-4;
  constexpr double kRounding = 1e-12;  // of what a load needs, no more is asked
  ContactSolverOptions solve;
  solve.method = options.method;
  solve.law = options.law;
  solve.reference_speed = trial->h * acceleration;
  const double own = share * options.tolerance;
  const double fine = std::max(own * weight_over_load(model, acceleration), std::min(own, kRounding));
  trial->step = build_step_problem(model, start, contacts, memories, step_options(options, trial->h));
  trial->step_solution = {};
  solve.max_iterations = options.max_iterations;
  // An equilibrium that takes more iterations than usual is found more easily in several smaller steps.
  if (!solve.max_iterations && tries_at_once(options))
    solve.max_iterations = usual_newton_iterations(trial->step.problem);
  for (const double tolerance : {std::max(fine, kCoarse), fine}) {
    solve.tolerance = tolerance;
    trial->solve = solve_problem(trial->step.problem, options.symmetry, solve, solver, &trial->step_solution);
    trial->iterations += trial->solve.iterations;
    trial->speed_ratio = largest_speed(trial->step_solution.v) / solve.reference_speed;
    if (tolerance == fine || known_to(trial->speed_ratio) >= kCoarse) break;
    if (tries_at_once(options) && trial->solve.ending != SolveEnding::converged) break;
  }
  trial->residuals =
      compute_residuals(trial->step.problem, trial->step_solution, solve.reference_speed, solve.law);
  trial->forces = joint_forces(contacts, trial->step_solution.gamma, trial->h);
  trial->balance =
      compute_equilibrium(model, start, contacts, trial->forces, start.time + 0.5 * options.time_advance);
}

/// |v| / (g h) at one h.
struct SpeedTrial {
  double h, ratio;
};

/// Elastic displacements make the ratio fall with h^2, a mechanism keeps it. In between lies the square root
/// of what h grew.
bool falls_slowly(const SpeedTrial& before, const SpeedTrial& after) {
  return after.ratio > before.ratio * std::sqrt(before.h / after.h);
}

/// Neither of the last two raises of h slowed the structure down.
bool keeps_moving(const std::vector<SpeedTrial>& trials) {
  const size_t n = trials.size();
  return n >= 3 && falls_slowly(trials[n - 3], trials[n - 2]) && falls_slowly(trials[n - 2], trials[n - 1]);
}

/// A ratio beyond what an equilibrium shows at the first h.
constexpr double kFast = 3e-2;

/// No mechanism is as slow, unless its load is within a millionth of what it can carry.
constexpr double kAtRest = 1e-6;

/// An h at which elastic displacements are a trifle: c m / h^2 = kRigid for the most compliant contact.
double rigid_step(const Model& model, const State& start, const ContactSet& contacts) {
  constexpr double kRigid = 1e-8;  // leaves the impulses of what moves fast half of their digits
  double compliance = 0.0;
  for (const Contact& contact : contacts.points)
    compliance = std::max(compliance, joint_law(model, contacts, contact, start.time).compliance_normal);
  double mass = 0.0;
  for (const int block : model.free_blocks) mass += model.assembly->blocks[block].mass;
  return std::sqrt(compliance * mass / std::max(1, model.num_free()) / kRigid);
}

/// The inertia share falls with h^2: a little more than needed. But impulses of a moving structure lose
/// digits with h^2, so h leaps only when the last raise has shown that it slows down.
double raise_of_h(const std::vector<SpeedTrial>& trials, double residual, const StaticOptions& options) {
  constexpr double kCareful = 2.0;
  constexpr double kByDegrees = 6.0;
  constexpr double kFarthest = 100.0;
  const size_t n = trials.size();
  const bool slows_down = n >= 2 ? !falls_slowly(trials[n - 2], trials[n - 1])
                                 : trials[0].ratio < (options.may_move ? kFast : kAtRest);
  const double leap = options.may_move ? kByDegrees : kFarthest;
  return std::clamp(2.0 * std::sqrt(residual / options.tolerance), kCareful, slows_down ? leap : kCareful);
}

/// What the motion proves: the sum of normal forces that an equilibrium would need, over the sum found.
double needed_over_found(const StaticSolution& trial) {
  return required_normal_force(trial.step.problem, trial.step_solution.v) /
         normal_force_sum(trial.step.problem, trial.step_solution.gamma);
}

/// From here on a motion counts as proven: no other forces of that size balance the loads either.
constexpr double kProven = 10.0;

constexpr const char* kNotCertified =
    "not certified: other forces in the friction cones might balance the loads";

std::string proof(const StaticSolution& trial) {
  const double needed = needed_over_found(trial);
  if (needed < kProven) return kNotCertified;
  return fmt::format("an equilibrium would need normal forces {:.2g} times those found", needed);
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

/// Solves at a first h, and at larger ones until the residual is as small as asked or the structure is seen
/// to move.
StaticSolution raise_step(const Model& model, const State& start, const ContactSet& contacts,
                          const ContactMemories& memories, const StaticOptions& options) {
  const double acceleration = reference_acceleration(model, start);
  ContactSolver solver;
  StaticSolution trial;
  trial.h = first_step(model, start, contacts, acceleration, options);
  std::vector<SpeedTrial> trials;
  bool moving = false;
  double share = kSolveShare;
  for (int k = 0; k < kMaxSolves && !moving; ++k) {
    solve_at(model, start, contacts, memories, options, acceleration, share, &solver, &trial);
    options.log(
        fmt::format("static  h {:9.3e} s  iterations {:3d}  momentum {:9.2e}  law {:9.2e}  "
                    "equilibrium {:9.2e}  |v|/(g h) {:9.2e}",
                    trial.h, trial.solve.iterations, trial.residuals.momentum, trial.residuals.contact_law,
                    trial.balance.residual, trial.speed_ratio));
    const bool converged = trial.solve.ending == SolveEnding::converged;
    if (converged && trial.balance.residual <= options.tolerance) break;
    // First-order methods balance momentum by construction: what they miss shows in the contact law.
    const double missed = std::max(trial.residuals.momentum, trial.residuals.contact_law);
    if (!converged && !(missed <= known_to(trial.speed_ratio))) break;
    trials.push_back({trial.h, trial.speed_ratio});
    const double rigid = rigid_step(model, start, contacts);
    if (!keeps_moving(trials)) {
      trial.h *= raise_of_h(trials, trial.balance.residual, options);
    } else if (options.law == FrictionLaw::associated && trial.speed_ratio > kFast && trial.h < rigid) {
      // Joints so soft that blocks nearly fall freely in h show nothing yet: ask once more, rigid. (Under
      // Coulomb's law the rigid problem is another one: it admits self-stress that no compliance builds up.)
      trial.h = rigid;
    } else if (trial.speed_ratio <= kAtRest) {
      share *= 0.1;  // rigid joints do not slow down with h: what moves is what the solve left over
    } else if (options.certify && k + 1 < kMaxSolves && needed_over_found(trial) < kProven) {
      // What the joints give way is less and less of the motion: the proof grows with h^2.
      trial.h *= std::clamp(std::sqrt(2.0 * kProven / needed_over_found(trial)), 2.0, 10.0);
    } else {
      moving = true;
    }
  }
  judge(options, moving, &trial);
  return trial;
}

/// The motion under the associated law, if it proves that nothing holds the structure: where no forces in the
/// cones balance the loads, none do by Coulomb's law, whose own solves tell it much later. (What slides by
/// Coulomb's law proves nothing.)
std::optional<StaticSolution> proven_motion(const Model& model, const State& start,
                                            const ContactSet& contacts, const ContactMemories& memories,
                                            StaticOptions options) {
  options.law = FrictionLaw::associated;
  options.may_move = options.certify = true;
  StaticSolution answer = raise_step(model, start, contacts, memories, options);
  if (answer.verdict != Verdict::moving || needed_over_found(answer) < kProven) return std::nullopt;
  answer.message += "; " + proof(answer) + ", by whichever law";
  return answer;
}

}  // namespace

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::equilibrium:
      return "equilibrium";
    case Verdict::moving:
      return "moving";
    case Verdict::unconverged:
      return "unconverged";
  }
  return "";
}

StaticSolution solve_static(const Model& model, const State& start, const ContactSet& contacts,
                            const ContactMemories& memories, const StaticOptions& options) {
  const bool coulomb = options.law == FrictionLaw::coulomb;
  const auto motion = [&] { return proven_motion(model, start, contacts, memories, options); };
  if (coulomb && options.may_move) {
    if (std::optional<StaticSolution> moves = motion()) return *moves;
  }
  StaticSolution answer = raise_step(model, start, contacts, memories, options);
  const bool budget = options.max_iterations.has_value();  // it is used up
  if (options.may_move || budget || answer.verdict == Verdict::equilibrium) return answer;
  if (coulomb) {
    if (std::optional<StaticSolution> moves = motion()) return *moves;
  }
  if (answer.verdict == Verdict::unconverged) {
    // A mechanism, or joints that open and close in numbers: both show themselves at short h.
    StaticOptions by_degrees = options;
    by_degrees.may_move = true;
    by_degrees.certify = !coulomb;
    const int iterations = answer.iterations;
    answer = raise_step(model, start, contacts, memories, by_degrees);
    answer.iterations += iterations;
  }
  if (answer.verdict == Verdict::moving) answer.message += "; " + (coulomb ? kNotCertified : proof(answer));
  return answer;
}

LoadedState loaded_state(const Model& model, const State& start, const ContactSet& contacts,
                         const ContactMemories& memories, const StaticSolution& solution,
                         const StaticOptions& options) {
  LoadedState loaded{start, memories, solution.h};
  loaded.state.v = solution.step_solution.v;
  integrate_positions(model, solution.h, options.time_advance, &loaded.state);
  loaded.state.v.setZero();  // equilibrium: the step's velocity is only the displacement's carrier
  update_memories(solution.step, solution.step_solution, start, contacts, step_options(options, solution.h),
                  &loaded.memories);
  return loaded;
}

}  // namespace cupola
