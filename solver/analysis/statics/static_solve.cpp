#include "solver/analysis/statics/static_solve.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/model/joint_rule.hpp"
#include "solver/analysis/statics/coming_to_rest.hpp"
#include "solver/analysis/statics/following_path.hpp"
#include "solver/analysis/statics/static_step.hpp"
#include "solver/conic/exact_equilibrium.hpp"
#include "solver/conic/motion_proof.hpp"
#include "solver/contact/problem/cone.hpp"

namespace cupola {
namespace {

/// The motion of a mechanism that the conic solver found, in the place of what the iterations found.
void turn_into_motion(const Model& model, const State& start, const VecX& loads, const VecX& mechanism,
                      StaticSolution* solution) {
  const ContactProblem& problem = solution->step.problem;
  double power = loads.dot(mechanism), inertia = 0.0;
  for (int k = 0; k < problem.num_blocks(); ++k)
    inertia += mechanism.segment<6>(6 * k).dot(problem.M[k] * mechanism.segment<6>(6 * k));
  const VecX acceleration = power / inertia * mechanism;
  solution->increment = solution->h * solution->h * acceleration;
  solution->step_solution.v = solution->h * acceleration;
  solution->speed_ratio = largest_speed(acceleration) / reference_acceleration(model, start);
  const bool balanced = solution->outcome == StaticOutcome::equilibrium;
  solution->outcome = StaticOutcome::moving;
  solution->message = fmt::format(
      "no equilibrium exists: blocks accelerate at up to {:.3g} m/s2; a mechanism that the loads drive and "
      "no joint resists proves it{}",
      largest_speed(acceleration),
      balanced ? fmt::format(
                     " (without it, forces were found that balance the loads to {:.1e} of a block's weight)",
                     solution->balance.residual)
               : "");
}

/// Asks the conic solver where no verdict was reached, or where exact forces next to those found are not
/// proven to exist.
void decide(const Model& model, const State& start, const VecX& loads, const StaticOptions& options,
            StaticSolution* solution) {
  options.log("static  the conic solver decides whether exact forces exist");
  const ContactProblem& problem = solution->step.problem;
  MotionProof proof(problem, problem.h * loads);
  switch (proof.search()) {
    case MotionProof::Answer::moves:
      solution->proven = true;
      turn_into_motion(model, start, loads, proof.mechanism(), solution);
      return;
    case MotionProof::Answer::admissible:
      solution->proven = solution->outcome == StaticOutcome::equilibrium &&
                         proves_equilibrium(problem, problem.h * loads, proof.forces());
      if (solution->outcome != StaticOutcome::equilibrium && options.solve.law.is_associated())
        solution->message +=
            "; forces that balance the loads exist, so that the structure stands, but "
            "those that its compliances choose were not found";
      break;
    case MotionProof::Answer::unknown:
      break;
  }
  if (!solution->proven && solution->outcome == StaticOutcome::equilibrium)
    solution->message += "; forces in exact equilibrium were not found";
}

StaticCertificate unsolved() {
  StaticCertificate certificate;
  certificate.force_error.bounds = "the static problem was not solved";
  return certificate;
}

void certify(const Model& model, const State& start, const ContactSet& contacts, const StaticOptions& options,
             StaticSolution* solution) {
  if (solution->outcome == StaticOutcome::equilibrium) {
    const VecX loads = applied_forces(model, start, start.time + solution->time_advance);
    solution->certificate = certify_static(contacts, loads, solution->step.problem, solution->step_solution,
                                           options.solve.law, model.loads.gravity.norm(), options.symmetry);
    solution->proven = solution->certificate.exact_forces;
    if (!solution->proven) decide(model, start, loads, options, solution);
  }
  if (solution->outcome == StaticOutcome::unconverged && !options.control && !options.solve.max_iterations)
    decide(model, start, applied_forces(model, start, start.time + solution->time_advance), options,
           solution);
  if (solution->outcome != StaticOutcome::equilibrium)
    solution->certificate = unsolved();
  else if (solution->certificate.balance == Balance::unstable)
    solution->message +=
        "; unstable balance: joints and weight give a negative stiffness, so that a small disturbance would "
        "end the equilibrium";
}

double largest_displacement_of(const StaticSolution& solution) {
  return largest_speed(solution.step_solution.v) * solution.h;
}

/// By how much blocks must move, m, before their motion shows more than settlement. Stiff joints beside soft
/// ones, or nearly rigid ones, seem to move steadily over less, and slender towers, which sway by far more
/// than they settle. `associated`: null if the structure has no equilibrium under that law.
double least_motion(const Model& model, const StaticOptions& options, const StaticSolution* associated) {
  constexpr double kShare = 0.01;           // of the smallest block
  constexpr double kShareFromStart = 0.05;  // heads softer than the bed engage after a long slip
  const double size = smallest_block_size(*model.assembly);
  if (options.follow_from_start) return kShareFromStart * size;
  return associated ? std::max(kShare * size, largest_displacement_of(*associated)) : 0.0;
}

/// True if the path showed nothing: it ended without a verdict, or called a short motion steady.
bool shows_nothing(const StaticSolution& solution, double least) {
  if (solution.outcome != StaticOutcome::moving) return solution.outcome == StaticOutcome::unconverged;
  return largest_displacement_of(solution) < least;
}

/// A proven motion under the associated law: the other laws admit the same forces.
StaticSolution under_any_law(StaticSolution motion) {
  motion.message += ", under either friction law";
  return motion;
}

/// True if no compliant contact slips in the solution under the associated law, which then obeys every flow
/// rule. Rigid contacts are left out, because their forces are not unique.
bool slips_nowhere(const StaticSolution& solution, const FlowRule& law, double acceleration) {
  const StepProblem& step = solution.step;
  if (first_rigid_contact(step.problem)) return false;
  return compute_residuals(step.problem, solution.step_solution, solution.h * acceleration, law)
             .contact_law <= kOutcomeTolerance;
}

/// True if forces next to those found are proven to balance the loads.
bool has_exact_forces(const StaticSolution& solution, const VecX& loads) {
  const ContactProblem& problem = solution.step.problem;
  return proves_equilibrium(problem, problem.h * loads, solution.step_solution.gamma);
}

/// Iterations of a contact solve near its solution. Stages of domes take 2 to 5, of walls whose fresh beds
/// slide up to 20, steps of paths 4 to 9: several times less than from afar.
int few_iterations(const StaticOptions& options) {
  constexpr int kIterations = 25;
  return std::min(options.solve.max_iterations.value_or(kIterations), kIterations);
}

/// Of a non-associated law, from the solution under the associated one.
StaticSolution solve_from_associated(const Model& model, const State& start, const ContactSet& contacts,
                                     const ContactMemories& memories, const StaticOptions& options,
                                     const StaticSolution& associated) {
  ComingToRest run(model, start, contacts, memories, options, ComingToRest::Start::associated);
  run.start_from(associated);
  return run.run();
}

/// Of a non-associated law: along a path, if the method and the joints permit it. `associated`: null if the
/// structure has no equilibrium under that law.
StaticSolution solve_from_start(const Model& model, const State& start, const ContactSet& contacts,
                                const ContactMemories& memories, const StaticOptions& options,
                                const StaticSolution* associated) {
  if (options.solve.method != ContactMethod::newton ||
      !std::isfinite(largest_static_step(model, start, contacts)))
    return ComingToRest(model, start, contacts, memories, options).run();
  std::function<StaticSolution()> shortcut;
  if (associated && !options.follow_from_start) {
    shortcut = [&] {
      StaticOptions few = options;
      few.solve.max_iterations = few_iterations(options);
      return solve_from_associated(model, start, contacts, memories, few, *associated);
    };
  }
  return FollowingPath(model, start, contacts, memories, options, least_motion(model, options, associated),
                       std::move(shortcut))
      .run();
}

/// Near the start, an equilibrium but for what `options.nearby` names. Unconverged if none is found quickly.
StaticSolution solve_nearby(const Model& model, const State& start, const ContactSet& contacts,
                            const ContactMemories& memories, const StaticOptions& options) {
  if (!options.nearby || options.solve.method != ContactMethod::newton) return {};
  // Under the associated law a start from rest is no better than one from afar, from where a control finds its
  // time in a sixth of the iterations (wall_griffith_mortar).
  if (options.solve.law.is_associated() && (options.nearby->displacement.size() == 0 || options.control))
    return {};
  StaticOptions few = options;
  few.solve.max_iterations = few_iterations(options);
  few.solve.near_solution = true;
  ComingToRest nearby(model, start, contacts, memories, few, ComingToRest::Start::nearby);
  return nearby.start_near(*options.nearby) ? nearby.run() : StaticSolution{};
}

/// A non-associated law, from a start that need not be near an equilibrium.
StaticSolution solve_non_associated(const Model& model, const State& start, const ContactSet& contacts,
                                    const ContactMemories& memories, const StaticOptions& options) {
  StaticOptions associated = options;
  associated.solve.law = FrictionLaw::associated;
  associated.tolerance = std::max(options.tolerance, kOutcomeTolerance);
  StaticSolution first = ComingToRest(model, start, contacts, memories, associated).run();
  if (first.outcome == StaticOutcome::moving && first.proven) return under_any_law(std::move(first));
  StaticSolution solution;
  int iterations = first.iterations;
  const bool stands = first.outcome == StaticOutcome::equilibrium;
  if (stands && slips_nowhere(first, options.solve.law, reference_acceleration(model, start)))
    solution = solve_from_associated(model, start, contacts, memories, options, first);
  if (solution.outcome != StaticOutcome::equilibrium) {
    iterations += solution.iterations;
    solution = solve_from_start(model, start, contacts, memories, options, stands ? &first : nullptr);
    // Where it found no equilibrium, none may exist, and then the structure moves under every law.
    if (solution.outcome != StaticOutcome::equilibrium && first.outcome != StaticOutcome::moving &&
        !options.solve.max_iterations) {
      const VecX loads = applied_forces(model, start, start.time + options.time_advance);
      if (!(stands && has_exact_forces(first, loads))) decide(model, start, loads, associated, &first);
      if (first.outcome == StaticOutcome::moving) return under_any_law(std::move(first));
    }
    if (stands && !options.follow_from_start &&
        shows_nothing(solution, least_motion(model, options, &first))) {
      StaticSolution second = solve_from_associated(model, start, contacts, memories, options, first);
      if (second.outcome == StaticOutcome::equilibrium) std::swap(solution, second);
      iterations += second.iterations;
    }
  }
  solution.iterations += iterations;
  return solution;
}

/// From a start that need not be near an equilibrium.
StaticSolution solve_from_afar(const Model& model, const State& start, const ContactSet& contacts,
                               const ContactMemories& memories, const StaticOptions& options) {
  StaticSolution solution = options.solve.law.is_associated() || options.control
                                ? ComingToRest(model, start, contacts, memories, options).run()
                                : solve_non_associated(model, start, contacts, memories, options);
  certify(model, start, contacts, options, &solution);
  return solution;
}

}  // namespace

StaticSolution solve_static(const Model& model, const State& start, const ContactSet& contacts,
                            const ContactMemories& memories, const StaticOptions& options) {
  StaticSolution nearby = solve_nearby(model, start, contacts, memories, options);
  if (nearby.outcome == StaticOutcome::equilibrium) {
    certify(model, start, contacts, options, &nearby);
    return nearby;
  }
  StaticSolution solution = solve_from_afar(model, start, contacts, memories, options);
  solution.iterations += nearby.iterations;
  return solution;
}

StepProblem first_static_problem(const Model& model, const State& start, const ContactSet& contacts,
                                 const ContactMemories& memories, const StaticOptions& options) {
  const double h = first_static_step(model, start, contacts, reference_acceleration(model, start), options);
  return build_step_problem(model, start, contacts, memories, static_step_options(options, h));
}

LoadedState loaded_state(const Model& model, const State& start, const ContactSet& contacts,
                         const ContactMemories& memories, const StaticSolution& solution,
                         const StaticOptions& options) {
  LoadedState loaded{start, memories, solution.h};
  loaded.state.v = solution.step_solution.v;
  integrate_positions(model, solution.h, options.time_advance, loaded.state.v, &loaded.state);
  loaded.state.v.setZero();  // v was only the displacement over h
  update_memories(model, solution.step, solution.step_solution, start, contacts,
                  static_step_options(options, solution.h), &loaded.memories);
  return loaded;
}

}  // namespace cupola
