#include "solver/analysis/motion/dynamic_history.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/files/csv_columns.hpp"
#include "assembly/model/block_motion.hpp"
#include "solver/analysis/motion/farthest_point.hpp"

namespace cupola {
namespace {

/// Everything that a row of history.csv is made of.
struct HistoryStep {
  double time;
  const StepReport& report;
  const Snapshot& now;
  const RunEnergy& energy;
};

std::string exact(double x) {
  return fmt::format("{:.17g}", x);
}

double largest_tie_force(const StepReport& report) {
  double largest = 0.0;
  for (double force : report.forces.ties) largest = std::max(largest, force);
  return largest;
}

constexpr CsvColumn<HistoryStep> kHistoryColumns[] = {
    {"time_s", [](const HistoryStep& s) { return exact(s.time); }},
    {"contacts", [](const HistoryStep& s) { return std::to_string(s.report.forces.contacts.size()); }},
    {"iterations", [](const HistoryStep& s) { return std::to_string(s.report.solve.iterations); }},
    {"momentum_residual",
     [](const HistoryStep& s) { return fmt::format("{:.6e}", s.report.residuals.momentum); }},
    {"contact_law_residual",
     [](const HistoryStep& s) { return fmt::format("{:.6e}", s.report.residuals.contact_law); }},
    {"kinetic_energy_J", [](const HistoryStep& s) { return exact(s.report.energy.kinetic); }},
    {"potential_energy_J", [](const HistoryStep& s) { return exact(s.report.energy.potential); }},
    {"elastic_energy_J", [](const HistoryStep& s) { return exact(s.report.energy.elastic); }},
    {"load_variation_work_J", [](const HistoryStep& s) { return exact(s.energy.work.loads); }},
    {"support_work_J", [](const HistoryStep& s) { return exact(s.energy.work.supports); }},
    {"friction_work_J", [](const HistoryStep& s) { return exact(s.energy.work.friction); }},
    {"dilatancy_work_J", [](const HistoryStep& s) { return exact(s.energy.work.dilatancy); }},
    {"damping_work_J", [](const HistoryStep& s) { return exact(s.energy.work.damping); }},
    {"impact_loss_J", [](const HistoryStep& s) { return exact(s.energy.work.impact); }},
    {"scheme_loss_J", [](const HistoryStep& s) { return exact(s.energy.work.scheme); }},
    {"energy_error_J", [](const HistoryStep& s) { return exact(s.energy.error); }},
    {"support_reaction_x_N",
     [](const HistoryStep& s) { return exact(s.report.balance.support_reaction.x()); }},
    {"support_reaction_y_N",
     [](const HistoryStep& s) { return exact(s.report.balance.support_reaction.y()); }},
    {"support_reaction_z_N",
     [](const HistoryStep& s) { return exact(s.report.balance.support_reaction.z()); }},
    {"momentum_x_Ns", [](const HistoryStep& s) { return exact(s.now.momentum.x()); }},
    {"momentum_y_Ns", [](const HistoryStep& s) { return exact(s.now.momentum.y()); }},
    {"momentum_z_Ns", [](const HistoryStep& s) { return exact(s.now.momentum.z()); }},
    {"max_speed_m_per_s", [](const HistoryStep& s) { return exact(s.now.speed); }},
    {"max_displacement_m", [](const HistoryStep& s) { return exact(s.now.displacement); }},
    {"time_step_s", [](const HistoryStep& s) { return exact(s.report.h); }},
    {"time_error_m", [](const HistoryStep& s) { return fmt::format("{:.6e}", s.report.time_error); }},
    {"largest_tie_force_N", [](const HistoryStep& s) { return exact(largest_tie_force(s.report)); }},
};

}  // namespace

Snapshot take_snapshot(const Simulation& simulation, const State& seen) {
  Snapshot snapshot;
  snapshot.momentum = simulation.linear_momentum();
  const Model& model = simulation.model();
  snapshot.speed = fastest_point(simulation.shapes(), model, seen);
  std::vector<Eigen::Vector4d> turned;
  for (const Pose& pose : seen.poses)
    turned.emplace_back(pose.q_WB.w(), pose.q_WB.x(), pose.q_WB.y(), pose.q_WB.z());
  snapshot.displacement =
      std::ranges::max(distances_moved(*model.assembly, displacements(*model.assembly, seen), turned));
  return snapshot;
}

void RunEnergy::include(const StepReport& report) {
  work += report.work;
  error = report.energy.total() - start - work.change();
  worst_error = std::max(worst_error, std::abs(error));
  peak_kinetic = std::max(peak_kinetic, report.energy.kinetic);
}

std::optional<double> RunEnergy::relative_error() const {
  const double scale = std::max(work.dissipated(), peak_kinetic);
  if (!(scale > 0.0)) return std::nullopt;
  return worst_error / scale;
}

std::string history_header() {
  return csv_header(kHistoryColumns);
}

std::string history_row(double time, const StepReport& report, const Snapshot& now, const RunEnergy& energy) {
  return csv_row(kHistoryColumns, HistoryStep{time, report, now, energy});
}

std::string log_line(int step, double time, const StepReport& report, const Snapshot& now) {
  return fmt::format(
      "step {:6d}  t {:9.4f} s  contacts {:7d}  iterations {:3d}  momentum {:9.2e}  "
      "kinetic {:10.3e} J  |v| {:9.2e} m/s",
      step, time, report.forces.contacts.size(), report.solve.iterations, report.residuals.momentum,
      report.energy.kinetic, now.speed);
}

}  // namespace cupola
