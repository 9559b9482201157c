#include "solver/analysis/static_solve.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "solver/analysis/cyclic_reduction.hpp"
#include "solver/contact/methods/method_table.hpp"
#include "solver/contact/problem/kinematic_bound.hpp"

namespace cupola {
namespace {

constexpr int kMaxSolves = 10;
constexpr double kSolveShare = 0.1;  // part of the tolerance for the contact solve; inertia takes the rest

/// Largest displacement of a support in the step, m.
double imposed_displacement(const Model& model, const State& start, const StaticOptions& options) {
  std::vector<Pose> moved = start.poses;
  place_supports(*model.assembly, model.support_motions, start.time + options.time_advance, &moved);
  double largest = 0.0;
  for (size_t i = 0; i < moved.size(); ++i)
    largest = std::max(largest, (moved[i].p_WB - start.poses[i].p_WB).norm());
  return largest;
}

/// First guess of h. A displacement d reached in one step causes the inertia force m d / h^2, so that the
/// tolerance requires h^2 >= d / (g tolerance). The crown sinks by about c F per course, where F is the force
/// on one contact of the supports.
double first_step(const Model& model, const State& start, const ContactSet& contacts, double acceleration,
                  const StaticOptions& options) {
  constexpr double kShortShare = 1e-2;  // inertia share at the first h of a structure that may move
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
  // Shells sink further than their columns shorten; thin shells of many blocks, by tens of times as much. For
  // a structure that stands a larger h costs nothing, but a second solve costs as much as the first. With a
  // margin of 6 the inertia share of a dome of 330,000 bricks is a quarter of the tolerance.
  const double margin = options.may_move ? 2.5 : 6.0;
  return margin * std::sqrt(displacement / (acceleration * tolerance));
}

StepOptions step_options(const StaticOptions& options, double h) {
  StepOptions step;
  step.h = h;
  step.time_advance = options.time_advance;
  return step;
}

/// True if the equilibrium is first sought with one large h within a few iterations, because a failure costs
/// little. Under Coulomb's law it costs much with every method.
bool limits_first_solve(const StaticOptions& options) {
  return !options.may_move && method_traits(options.solve.method).fails_fast &&
         options.solve.law == FrictionLaw::associated;
}

/// Largest residual of a solve whose |v| / (g h) can be trusted.
double residual_for_speed(double speed_ratio) {
  constexpr double kShare = 1e-2;
  return kShare * speed_ratio;
}

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

/// Mean block weight over the largest load on a block. The equilibrium residual is relative to the former,
/// the residual of a solve to the latter, which is far larger where small blocks carry large loads.
double weight_over_load(const Model& model, double acceleration) {
  return model.block_weight > 0.0 ? model.loads.gravity.norm() / acceleration : 1.0;
}

/// Solves at trial->h. A structure that moves fast is solved only as accurately as its outcome requires: its
/// impulses lose digits with h^2, and double precision may not allow the full tolerance.
/// `share`: part of the tolerance that the contact solve may use.
void solve_at(const Model& model, const State& start, const ContactSet& contacts,
              const ContactMemories& memories, const StaticOptions& options, double acceleration,
              double share, ContactSolver* solver, StaticSolution* trial) {
  constexpr double kCoarse = 1e-4;
  constexpr double kRounding = 1e-12;  // smallest tolerance that weight_over_load() may cause
  CUPOLA_ASSERT(trial->h > 0.0 && acceleration > 0.0);
  ContactSolverOptions solve = options.solve;
  solve.reference_speed = trial->h * acceleration;
  const double own = share * options.tolerance;
  const double fine = std::max(own * weight_over_load(model, acceleration), std::min(own, kRounding));
  trial->step = build_step_problem(model, start, contacts, memories, step_options(options, trial->h));
  trial->step_solution = {};
  // An equilibrium that takes more iterations than most is found faster by raising h stepwise.
  if (!solve.max_iterations && limits_first_solve(options))
    solve.max_iterations = usual_newton_iterations(trial->step.problem);
  for (const double tolerance : {std::max(fine, kCoarse), fine}) {
    solve.tolerance = tolerance;
    trial->solve = solve_problem(trial->step.problem, options.symmetry, solve, solver, &trial->step_solution);
    trial->iterations += trial->solve.iterations;
    trial->speed_ratio = largest_speed(trial->step_solution.v) / solve.reference_speed;
    if (tolerance == fine || residual_for_speed(trial->speed_ratio) >= kCoarse) break;
    if (limits_first_solve(options) && trial->solve.ending != SolveEnding::converged) break;
  }
  CUPOLA_ASSERT(!trial->solve.usable() ||
                (trial->step_solution.v.allFinite() && trial->step_solution.gamma.allFinite()));
  trial->residuals =
      compute_residuals(trial->step.problem, trial->step_solution, solve.reference_speed, solve.law);
  trial->certificate = trial->residuals.certificate;
  if (smallest_compliance(trial->step.problem) == 0.0)
    trial->forces_unique = {false, "some compliance is zero"};
  trial->forces = joint_forces(contacts, trial->step_solution.gamma, trial->h);
  trial->balance =
      compute_equilibrium(model, start, contacts, trial->forces, start.time + 0.5 * options.time_advance);
}

/// |v| / (g h) at one h.
struct SpeedTrial {
  double h, ratio;
};

/// True if the ratio fell by less than the square root of the growth of h. The ratio of elastic displacements
/// falls with h^2; that of a mechanism is constant.
bool falls_slowly(const SpeedTrial& before, const SpeedTrial& after) {
  return after.ratio > before.ratio * std::sqrt(before.h / after.h);
}

/// True if neither of the last two increases of h slowed the structure down.
bool keeps_moving(const std::vector<SpeedTrial>& trials) {
  const size_t n = trials.size();
  return n >= 3 && falls_slowly(trials[n - 3], trials[n - 2]) && falls_slowly(trials[n - 2], trials[n - 1]);
}

/// A speed ratio larger than that of any equilibrium at the first h.
constexpr double kFast = 3e-2;

/// A speed ratio smaller than that of any mechanism whose load exceeds the critical one by a millionth.
constexpr double kAtRest = 1e-6;

/// An h at which elastic displacements are negligible: c m / h^2 = kRigid for the most compliant contact.
double rigid_step(const Model& model, const State& start, const ContactSet& contacts) {
  constexpr double kRigid = 1e-8;  // leaves half of the digits to the impulses of a fast mechanism
  double compliance = 0.0;
  for (const Contact& contact : contacts.points)
    compliance = std::max(compliance, joint_law(model, contacts, contact, start.time).compliance_normal);
  double mass = 0.0;
  for (const int block : model.free_blocks) mass += model.assembly->blocks[block].mass;
  return std::sqrt(compliance * mass / std::max(1, model.num_free()) / kRigid);
}

/// Factor on h for the next trial. The inertia share falls with h^2; the factor is twice the one that meets
/// the tolerance. The impulses of a moving structure lose digits with h^2, so h grows fast only if the last
/// increase slowed the structure down.
double growth_of_h(const std::vector<SpeedTrial>& trials, double residual, const StaticOptions& options) {
  constexpr double kSmallest = 2.0;
  constexpr double kStepwise = 6.0;
  constexpr double kLargest = 100.0;
  CUPOLA_ASSERT(!trials.empty());
  const size_t n = trials.size();
  const bool slows_down = n >= 2 ? !falls_slowly(trials[n - 2], trials[n - 1])
                                 : trials[0].ratio < (options.may_move ? kFast : kAtRest);
  const double largest = options.may_move ? kStepwise : kLargest;
  return std::clamp(2.0 * std::sqrt(residual / options.tolerance), kSmallest,
                    slows_down ? largest : kSmallest);
}

/// Lower bound, from the motion, of the sum of normal forces in any equilibrium, over the sum found.
double needed_over_found(const StaticSolution& trial) {
  return required_normal_force(trial.step.problem, trial.step_solution.v) /
         normal_force_sum(trial.step.problem, trial.step_solution.gamma);
}

/// needed_over_found() from which a motion counts as proven: no contact forces of the size found balance the
/// loads.
constexpr double kProven = 10.0;

constexpr const char* kNotCertified =
    "not certified: other contact forces inside the friction cones might balance the loads";

std::string proof(const StaticSolution& trial) {
  const double needed = needed_over_found(trial);
  if (needed < kProven) return kNotCertified;
  return fmt::format("proof: an equilibrium would need normal forces {:.2g} times those found", needed);
}

void judge(const StaticOptions& options, bool moving, StaticSolution* trial) {
  if (moving) {
    trial->outcome = StaticOutcome::moving;
    trial->message = fmt::format(
        "no equilibrium: the speed ratio |v|/(g h) = {:.3e} at h = {:.3g} s no longer falls as h grows",
        trial->speed_ratio, trial->h);
  } else if (trial->solve.ending == SolveEnding::converged && trial->balance.residual <= options.tolerance) {
    trial->outcome = StaticOutcome::equilibrium;
    trial->message = fmt::format("equilibrium residual {:.2e} <= tolerance {:.2e} at h = {:.3g} s",
                                 trial->balance.residual, options.tolerance, trial->h);
  } else {
    trial->outcome = StaticOutcome::unconverged;
    trial->message = fmt::format(
        "equilibrium residual {:.2e} > tolerance {:.2e} at h = {:.3g} s: {}. Try a larger "
        "`analysis.tolerance` or a larger compliance",
        trial->balance.residual, options.tolerance, trial->h, trial->solve.message);
  }
}

/// Solves at the first h and at larger ones until the residual meets the tolerance or the structure is found
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
    // First-order methods balance momentum by construction; their error is in the contact law.
    const double missed = std::max(trial.residuals.momentum, trial.residuals.contact_law);
    if (!converged && !(missed <= residual_for_speed(trial.speed_ratio))) break;
    trials.push_back({trial.h, trial.speed_ratio});
    const double rigid = rigid_step(model, start, contacts);
    if (!keeps_moving(trials)) {
      trial.h *= growth_of_h(trials, trial.balance.residual, options);
    } else if (options.solve.law == FrictionLaw::associated && trial.speed_ratio > kFast && trial.h < rigid) {
      // If the joints are so soft that blocks nearly fall freely during h, the ratio proves nothing yet:
      // solve again with nearly rigid joints. (Not under Coulomb's law: its rigid problem admits states of
      // self-stress that compliant joints do not build up.)
      trial.h = rigid;
    } else if (trial.speed_ratio <= kAtRest) {
      share *= 0.1;  // rigid joints do not slow down with h: the motion is the residual of the solve
    } else if (options.certify && k + 1 < kMaxSolves && needed_over_found(trial) < kProven) {
      // The share of elastic deformation in the motion falls, so the bound grows, with h^2.
      trial.h *= std::clamp(std::sqrt(2.0 * kProven / needed_over_found(trial)), 2.0, 10.0);
    } else {
      moving = true;
    }
  }
  judge(options, moving, &trial);
  return trial;
}

/// The motion under the associated law, if it proves that the structure does not stand. Where no forces
/// inside the friction cones balance the loads, none do under Coulomb's law either, whose own solves find
/// this out much later. (A sliding motion under Coulomb's law proves nothing.)
std::optional<StaticSolution> proven_motion(const Model& model, const State& start,
                                            const ContactSet& contacts, const ContactMemories& memories,
                                            StaticOptions options) {
  options.solve.law = FrictionLaw::associated;
  options.may_move = options.certify = true;
  StaticSolution answer = raise_step(model, start, contacts, memories, options);
  if (answer.outcome != StaticOutcome::moving || needed_over_found(answer) < kProven) return std::nullopt;
  answer.message += "; " + proof(answer) + ", under either friction law";
  return answer;
}

}  // namespace

StaticSolution solve_static(const Model& model, const State& start, const ContactSet& contacts,
                            const ContactMemories& memories, const StaticOptions& options) {
  const bool coulomb = options.solve.law == FrictionLaw::coulomb;
  const auto motion = [&] { return proven_motion(model, start, contacts, memories, options); };
  if (coulomb && options.may_move) {
    if (std::optional<StaticSolution> moves = motion()) return *moves;
  }
  StaticSolution answer = raise_step(model, start, contacts, memories, options);
  const bool budget_spent =
      options.solve.max_iterations.has_value();  // no second search within the user's limit
  if (options.may_move || budget_spent || answer.outcome == StaticOutcome::equilibrium) return answer;
  if (coulomb) {
    if (std::optional<StaticSolution> moves = motion()) return *moves;
  }
  if (answer.outcome == StaticOutcome::unconverged) {
    // A mechanism, or many joints that open and close: both are solved in few iterations at short h.
    StaticOptions stepwise = options;
    stepwise.may_move = true;
    stepwise.certify = !coulomb;
    const int iterations = answer.iterations;
    answer = raise_step(model, start, contacts, memories, stepwise);
    answer.iterations += iterations;
  }
  if (answer.outcome == StaticOutcome::moving)
    answer.message += "; " + (coulomb ? kNotCertified : proof(answer));
  return answer;
}

StepProblem first_static_problem(const Model& model, const State& start, const ContactSet& contacts,
                                 const ContactMemories& memories, const StaticOptions& options) {
  const double h = first_step(model, start, contacts, reference_acceleration(model, start), options);
  return build_step_problem(model, start, contacts, memories, step_options(options, h));
}

LoadedState loaded_state(const Model& model, const State& start, const ContactSet& contacts,
                         const ContactMemories& memories, const StaticSolution& solution,
                         const StaticOptions& options) {
  LoadedState loaded{start, memories, solution.h};
  loaded.state.v = solution.step_solution.v;
  integrate_positions(model, solution.h, options.time_advance, &loaded.state);
  loaded.state.v.setZero();  // v was only the displacement over h
  update_memories(solution.step, solution.step_solution, start, contacts, step_options(options, solution.h),
                  &loaded.memories);
  return loaded;
}

}  // namespace cupola
