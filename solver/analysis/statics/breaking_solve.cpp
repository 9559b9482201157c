#include "solver/analysis/statics/breaking_solve.hpp"

#include <set>
#include <vector>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "solver/analysis/statics/static_step.hpp"
#include "solver/conic/motion_proof.hpp"
#include "solver/dynamics/joint_damage.hpp"

namespace cupola {

bool moves_with_bonded_joints(const Model& model, const State& start, const ContactSet& contacts,
                              const ContactMemories& bonded, const StaticOptions& options,
                              const VecX& motion) {
  const ContactProblem problem = first_static_problem(model, start, contacts, bonded, options).problem;
  MotionProof proof(problem, problem.h * applied_forces(model, start, start.time + options.time_advance));
  return (motion.size() > 0 && proof.next_to(motion)) || proof.search() == MotionProof::Answer::moves;
}

namespace {

/// True if cracks that the motion closes or opens may stop it: they then bear or pull in `memories`. It is
/// proven only if it also moves with all of them bonded.
bool may_be_stopped(const Model& model, const State& start, const ContactSet& contacts,
                    const StaticOptions& options, ContactMemories* memories, StaticSolution* motion) {
  ContactMemories bonded = *memories;
  if (!let_joints_bear_and_pull(&bonded) ||
      moves_with_bonded_joints(model, start, contacts, bonded, options, motion->increment))
    return false;
  if (follow_motion(motion->step, motion->step_solution, motion->h, memories)) return true;
  if (motion->proven)
    motion->message = "blocks move, without proof: cracks that carry nothing would resist if they closed";
  motion->proven = false;
  return false;
}

/// All that the next solve of a step depends on: damage and role of each contact.
std::vector<double> what_joints_bear(const ContactMemories& memories) {
  std::vector<double> state;
  for (const ContactMemory& memory : memories.values)
    state.insert(state.end(), {memory.joint.step_damage, memory.joint.bears ? 1.0 : 0.0});
  return state;
}

}  // namespace

StaticSolution solve_breaking(const Model& model, const State& start, const ContactSet& contacts,
                              const StaticOptions& options, ContactMemories* memories, int* solves) {
  constexpr int kMostSolves = 200;  // a joint that breaks brittly breaks its neighbours one after the other
  if (model.joints.has_strength()) begin_step(contacts, memories);
  StaticSolution solution;
  StaticOptions found = options;
  int iterations = 0;
  bool again = true;
  std::set<std::vector<double>> tried;
  for (*solves = 0; again && *solves < kMostSolves && tried.insert(what_joints_bear(*memories)).second;
       ++*solves) {
    solution = solve_static(model, start, contacts, *memories, found);
    found.time_advance = solution.time_advance;
    iterations += solution.iterations;
    if (found.nearby && solution.outcome == StaticOutcome::equilibrium)
      found.nearby = NearbyStart{.displacement = solution.h * solution.step_solution.v};
    again = model.joints.has_strength() &&
            (solution.outcome == StaticOutcome::equilibrium
                 ? refine_step(model, start, contacts, solution.step, solution.step_solution,
                               static_step_options(found, solution.h), memories)
                 : solution.outcome == StaticOutcome::moving &&
                       may_be_stopped(model, start, contacts, found, memories, &solution));
  }
  solution.iterations = iterations;
  if (again) {
    solution.outcome = StaticOutcome::unconverged;
    solution.message =
        fmt::format("what the joints bear {} after {} of one step",
                    *solves < kMostSolves ? "came back to what it was before" : "still changed",
                    counted(*solves, "solve"));
  }
  return solution;
}

}  // namespace cupola
