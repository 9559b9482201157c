#include "solver/analysis/statics/static_solve.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/model/joint_rule.hpp"
#include "solver/analysis/statics/coming_to_rest.hpp"
#include "solver/analysis/statics/following_path.hpp"
#include "solver/analysis/statics/static_step.hpp"
#include "solver/contact/problem/cone.hpp"

namespace cupola {
namespace {

void certify(const Model& model, const State& start, const ContactSet& contacts, const StaticOptions& options,
             StaticSolution* solution) {
  if (solution->outcome != StaticOutcome::equilibrium) {
    solution->certificate.force_error.bounds = "the static problem was not solved";
    return;
  }
  const VecX loads = applied_forces(model, start, start.time + solution->time_advance);
  solution->certificate = certify_static(contacts, loads, solution->step.problem, solution->step_solution,
                                         options.solve.law, model.loads.gravity.norm(), options.symmetry);
  if (solution->certificate.balance == Balance::unstable)
    solution->message +=
        "; unstable balance: joints and weight give a negative stiffness, so that a small disturbance would "
        "end the equilibrium";
}

/// True if the path showed nothing: it ended without a verdict, or called a motion steady before any block had
/// moved by 1 % of the smallest. Stiff joints beside soft ones, or nearly rigid ones, do that.
bool shows_nothing(const Model& model, const StaticSolution& solution) {
  constexpr double kShare = 0.01;
  if (solution.outcome != StaticOutcome::moving) return solution.outcome == StaticOutcome::unconverged;
  return largest_speed(solution.step_solution.v) * solution.h < kShare * smallest_block_size(*model.assembly);
}

/// True if no compliant contact slips in the solution under the associated law, which then obeys every flow
/// rule. Rigid contacts are left out, because their forces are not unique.
bool slips_nowhere(const StaticSolution& solution, const FlowRule& law, double acceleration) {
  const StepProblem& step = solution.step;
  if (first_rigid_contact(step.problem)) return false;
  return compute_residuals(step.problem, solution.step_solution, solution.h * acceleration, law)
             .contact_law <= kOutcomeTolerance;
}

/// Of a non-associated law: along a path, if the method and the joints permit it.
StaticSolution solve_from_start(const Model& model, const State& start, const ContactSet& contacts,
                                const ContactMemories& memories, const StaticOptions& options) {
  if (options.solve.method == ContactMethod::newton &&
      std::isfinite(largest_static_step(model, start, contacts)))
    return FollowingPath(model, start, contacts, memories, options).run();
  return ComingToRest(model, start, contacts, memories, options).run();
}

}  // namespace

StaticSolution solve_static(const Model& model, const State& start, const ContactSet& contacts,
                            const ContactMemories& memories, const StaticOptions& options) {
  StaticSolution solution;
  if (options.solve.law.is_associated() || options.control) {
    solution = ComingToRest(model, start, contacts, memories, options).run();
  } else {
    StaticOptions associated = options;
    associated.solve.law = FrictionLaw::associated;
    associated.tolerance = std::max(options.tolerance, kOutcomeTolerance);
    StaticSolution first = ComingToRest(model, start, contacts, memories, associated).run();
    if (first.outcome == StaticOutcome::moving) {
      first.message += ", under either friction law";
      return first;
    }
    int iterations = first.iterations;
    const bool stands = first.outcome == StaticOutcome::equilibrium;
    const auto from_associated = [&] {
      ComingToRest again(model, start, contacts, memories, options);
      again.start_from(first);
      return again.run();
    };
    if (stands && slips_nowhere(first, options.solve.law, reference_acceleration(model, start)))
      solution = from_associated();
    if (solution.outcome != StaticOutcome::equilibrium) {
      iterations += solution.iterations;
      solution = solve_from_start(model, start, contacts, memories, options);
      if (stands && !options.follow_from_start && shows_nothing(model, solution)) {
        if (StaticSolution second = from_associated(); second.outcome == StaticOutcome::equilibrium)
          solution = std::move(second);
      }
    }
    first = {};
    solution.iterations += iterations;
  }
  certify(model, start, contacts, options, &solution);
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
