#include "solver/analysis/statics/static_record.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/model/joint_rule.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/dynamics/law_violation.hpp"

namespace cupola {
namespace {

FrameRole role_of(StaticOutcome outcome) {
  switch (outcome) {
    case StaticOutcome::equilibrium:
      return FrameRole::equilibrium;
    case StaticOutcome::moving:
      return FrameRole::mechanism;
    case StaticOutcome::unconverged:
      break;
  }
  return FrameRole::unconverged;
}

/// Of a static solve. Without an equilibrium, inertia balances the loads.
Accuracy force_balance_accuracy(const StaticSolution& solution, double tolerance) {
  const bool moving = solution.outcome == StaticOutcome::moving;
  const double reached = moving ? solution.residuals.momentum : solution.balance.residual;
  return {moving ? "force balance of the blocks, inertia included" : "force balance of the blocks",
          "largest unbalanced force of a block, relative to the mean block weight", tolerance, reached,
          reached};
}

/// m, of the second side of a contact relative to the first, at its points, since the assembly was built.
Vec3 relative_displacement(const Assembly& assembly, const State& state, const Contact& contact) {
  const auto displacement = [&](int block, const Vec3& point) -> Vec3 {
    const Pose& pose = state.poses[block];
    return point - assembly.blocks[block].centroid - pose.q_WB.conjugate() * (point - pose.p_WB);
  };
  return displacement(contact.block_b, contact.point_b) - displacement(contact.block_a, contact.point_a);
}

}  // namespace

Status status_of(StaticOutcome outcome, bool proven) {
  switch (outcome) {
    case StaticOutcome::equilibrium:
      return standing(proven);
    case StaticOutcome::moving:
      return motion(proven);
    case StaticOutcome::unconverged:
      break;
  }
  return Status::unconverged;
}

std::vector<double> static_violations(const ContactSet& contacts, const StaticSolution& solution,
                                      const FlowRule& law) {
  return law_violations(contacts, solution.step_solution.gamma,
                        contact_law_errors(solution.step.problem, solution.step_solution, law));
}

std::string gaps_note(const Model& model, const State& start, const ContactSet& contacts) {
  if (contacts.points.empty()) return "";
  const double closed = joint_rule(smallest_block_size(*model.assembly), 0.0).min_width;
  int count = 0;
  double largest = 0.0;
  for (const Contact& contact : contacts.points) {
    const double moved = contact.normal.dot(relative_displacement(*model.assembly, start, contact));
    const double drawn = contact.gap - moved;
    if (drawn > closed) ++count;
    largest = std::max(largest, drawn);
  }
  if (count == 0) return "";
  return fmt::format("; {} with gaps of up to {:.2g} mm {} within `contact.margin` and may carry forces",
                     counted(count, "contact point"), 1e3 * largest, count == 1 ? "is" : "are");
}

void warn_of_large_displacement(const Case& scene, const Assembly& assembly, double displacement,
                                std::vector<std::string>* warnings) {
  constexpr double kSmall = 0.1;  // of the smallest free block
  const double smallest = smallest_block_size(assembly);
  if (displacement <= kSmall * smallest) return;
  warnings->push_back(fmt::format(
      "the largest displacement of {:.2g} m is not small compared with the smallest block of {:.2g} m, but "
      "forces are those of the geometry as built. {}",
      displacement, smallest,
      scene.supports.moving() ? "A `path` follows supports that move" : "Check `joints.compliance`"));
}

Frame static_frame(const Model& model, const State& start, const ContactSet& contacts,
                   const ContactMemories& memories, const StaticSolution& solution,
                   const StaticOptions& options) {
  // A motion has directions but no amplitude, and of an unconverged solve nothing is known: the free blocks
  // stay where they started.
  const bool equilibrium = solution.outcome == StaticOutcome::equilibrium;
  LoadedState loaded = equilibrium ? loaded_state(model, start, contacts, memories, solution, options)
                                   : LoadedState{start, memories, solution.h};
  if (!equilibrium) move_supports(model, &loaded.state);
  const double speed = largest_speed(solution.step_solution.v);
  if (solution.outcome == StaticOutcome::moving && speed > 0.0)
    loaded.state.v = solution.step_solution.v / speed;
  const Vec3 ground = model.ground.displacement(loaded.state.time);
  std::vector<Vec3> displacement = displacements(*model.assembly, loaded.state);
  for (Vec3& of_block : displacement) of_block -= ground;
  Frame frame =
      make_frame(model, loaded.state, contacts, solution.forces,
                 static_violations(contacts, solution, options.solve.law), loaded.memories, displacement);
  set_tie_ends(model, start, &frame);
  set_role(role_of(solution.outcome), "", &frame);
  if (!equilibrium) return frame;
  const VecX u =
      solution.step.with_supports(relative_velocity(solution.step.problem, solution.step_solution.v));
  for (size_t i = 0; i < frame.contacts.gap.size(); ++i) {
    frame.contacts.gap[i] += solution.h * u[3 * static_cast<Eigen::Index>(i)];
    if (model.joints.has_strength())
      frame.contacts.crack_opening[i] = crack_opening(frame.contacts.gap[i], loaded.memories.of(i));
  }
  return frame;
}

FrameRole stage_role(StaticOutcome outcome) {
  return outcome == StaticOutcome::moving ? FrameRole::failed_stage : FrameRole::stage;
}

void summarize_accuracy(const StaticSolution& solution, double tolerance, Summary* summary) {
  summary->accuracy = force_balance_accuracy(solution, tolerance);
  summary->certified_force_error = solution.certificate.force_error;
  summary->forces_unique = solution.certificate.forces_unique;
  if (summary->certified_force_error.bounds.empty())
    summary->certified_force_error.bounds = "no equilibrium was found";
  if (summary->forces_unique.reason.empty()) summary->forces_unique = {false, "no equilibrium was found"};
}

void summarize_static(const StaticSolution& solution, const Frame& frame, const Model& model,
                      double tolerance, Summary* summary) {
  summarize_frame(frame, model, summary);
  summarize_accuracy(solution, tolerance, summary);
  summary->status = status_of(solution.outcome, solution.proven);
  summary->message = solution.message;
  summary->iterations = solution.iterations;
  summary->steps = 1;
  summary->time_step_s = solution.h;
  summarize_balance(solution.balance, summary);
  summary->momentum_residual = solution.residuals.momentum;
  summary->contact_law_residual = solution.residuals.contact_law;
  summary->friction_cone_violation = solution.residuals.cone_violation;
  summary->largest_law_violation = largest_violation(frame);
  // A motion has no amplitude, and of an unconverged solve nothing is known.
  summary->max_displacement_m.reset();
  if (solution.outcome == StaticOutcome::equilibrium)
    summary->max_displacement_m = largest_displacement(frame);
}

}  // namespace cupola
