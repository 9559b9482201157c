#include "solver/dynamics/simulation.hpp"

#include <utility>

namespace cupola {

Simulation::Simulation(Model model, const StepOptions& step, const DetectionOptions& detection,
                       double solve_tolerance)
    : model_(std::move(model)),
      step_(step),
      state_(state_at_rest(model_)),
      detector_(*model_.assembly, detection),
      solve_tolerance_(solve_tolerance) {}

StepReport Simulation::advance() {
  StepReport report;
  const ContactSet& contacts = detector_.update(state_.poses);
  memories_ = match_memories(memories_, contacts.contacts);
  const ContactProblem problem = build_contact_problem(model_, state_, contacts, memories_, step_);
  ContactSolution solution = warm_start(state_, memories_);
  NewtonOptions options;
  options.tolerance = solve_tolerance_;
  options.reference_speed = step_.h * reference_acceleration(model_, state_);
  report.solve = solver_.solve(problem, options, &solution);
  report.residuals = compute_residuals(problem, solution, options.reference_speed);
  report.forces = world_forces(contacts, solution.gamma, step_.h);
  report.balance = compute_equilibrium(model_, state_, contacts, report.forces);
  report.slid_work = friction_dissipation(problem, solution);

  update_memories(problem, solution, state_, contacts, step_, &memories_);
  state_.v = solution.v;
  integrate_positions(model_, step_.h, &state_);
  state_.time += step_.h;
  return report;
}

Vec3 Simulation::linear_momentum() const {
  Vec3 momentum = Vec3::Zero();
  for (int i = 0; i < model_.num_free(); ++i)
    momentum += model_.assembly->blocks[model_.free_blocks[i]].mass * state_.v.segment<3>(6 * i);
  return momentum;
}

std::vector<Vec3> Simulation::displacements() const {
  std::vector<Vec3> displacement(state_.poses.size());
  for (size_t block = 0; block < displacement.size(); ++block)
    displacement[block] = state_.poses[block].p_WB - model_.assembly->blocks[block].centroid;
  return displacement;
}

}  // namespace cupola
