#include "solver/analysis/dynamic_history.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace cupola {

Snapshot take_snapshot(const Simulation& simulation) {
  Snapshot snapshot;
  snapshot.energy = simulation.energy();
  snapshot.momentum = simulation.linear_momentum();
  snapshot.speed = largest_speed(simulation.state().v);
  const Model& model = simulation.model();
  for (int block : model.free_blocks) {
    const Vec3 moved = simulation.state().poses[block].p_WB - model.assembly->blocks[block].centroid;
    snapshot.displacement = std::max(snapshot.displacement, moved.norm());
  }
  return snapshot;
}

std::string history_header() {
  return "time_s,contacts,iterations,momentum_residual,contact_law_residual,kinetic_energy_J,"
         "potential_energy_J,elastic_energy_J,friction_work_J,support_reaction_x_N,support_reaction_y_N,"
         "support_reaction_z_N,momentum_x_Ns,momentum_y_Ns,momentum_z_Ns,max_speed_m_per_s,"
         "max_displacement_m,time_step_s,largest_tie_force_N";
}

std::string history_row(double time, const StepReport& report, const Snapshot& now, double friction_work) {
  const Vec3& R = report.balance.support_reaction;
  const Vec3& p = now.momentum;
  double tie_force = 0.0;
  for (double force : report.forces.ties) tie_force = std::max(tie_force, force);
  return fmt::format(
      "{:.17g},{},{},{:.6e},{:.6e},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},"
      "{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}",
      time, report.forces.contacts.size(), report.solve.iterations, report.residuals.momentum,
      report.residuals.contact_law, now.energy.kinetic, now.energy.potential, now.energy.elastic,
      friction_work, R.x(), R.y(), R.z(), p.x(), p.y(), p.z(), now.speed, now.displacement, report.h,
      tie_force);
}

std::string log_line(int step, double time, const StepReport& report, const Snapshot& now) {
  return fmt::format(
      "step {:6d}  t {:9.4f} s  contacts {:7d}  iterations {:3d}  momentum {:9.2e}  "
      "kinetic {:10.3e} J  |v| {:9.2e} m/s",
      step, time, report.forces.contacts.size(), report.solve.iterations, report.residuals.momentum,
      now.energy.kinetic, now.speed);
}

}  // namespace cupola
