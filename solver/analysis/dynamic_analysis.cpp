#include <cmath>

#include <fmt/format.h>

#include "assembly/program.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/record.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "solver/dynamics/simulation.hpp"

namespace cupola {
namespace {

const char* const kHistoryHeader =
    "time_s,contacts,iterations,momentum_residual,contact_law_residual,kinetic_energy_J,potential_energy_J,"
    "elastic_energy_J,friction_work_J,support_reaction_x_N,support_reaction_y_N,support_reaction_z_N,"
    "momentum_x_Ns,momentum_y_Ns,momentum_z_Ns,max_speed_m_per_s,max_displacement_m";

/// Speeds, energies and sums at the end of a step, for the log and the history.
struct Snapshot {
  Energy energy;
  Vec3 momentum = Vec3::Zero();  // N s
  double speed = 0.0, displacement = 0.0;
};

Snapshot take_snapshot(const Simulation& simulation) {
  Snapshot snapshot;
  snapshot.energy = simulation.energy();
  snapshot.momentum = simulation.linear_momentum();
  const State& state = simulation.state();
  for (Eigen::Index i = 0; i < state.v.size(); i += 6)
    snapshot.speed = std::max(snapshot.speed, state.v.segment<3>(i).norm());
  for (const Vec3& d : simulation.displacements())
    snapshot.displacement = std::max(snapshot.displacement, d.norm());
  return snapshot;
}

std::string history_row(double time, const StepReport& report, const Snapshot& now, double friction_work) {
  const Vec3& R = report.balance.support_reaction;
  const Vec3& p = now.momentum;
  return fmt::format(
      "{:.17g},{},{},{:.6e},{:.6e},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},"
      "{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}",
      time, report.forces.size(), report.solve.iterations, report.residuals.momentum,
      report.residuals.contact_law, now.energy.kinetic, now.energy.potential, now.energy.elastic,
      friction_work, R.x(), R.y(), R.z(), p.x(), p.y(), p.z(), now.speed, now.displacement);
}

std::string log_line(int step, double time, const StepReport& report, const Snapshot& now) {
  return fmt::format(
      "step {:6d}  t {:9.4f} s  contacts {:7d}  iterations {:3d}  momentum {:9.2e}  "
      "kinetic {:10.3e} J  |v| {:9.2e} m/s",
      step, time, report.forces.size(), report.solve.iterations, report.residuals.momentum,
      now.energy.kinetic, now.speed);
}

/// What a step's report contributes to the summary.
void summarize_step(const StepReport& report, int step, Summary* summary) {
  summary->steps = step;
  summary->applied_load_N = report.balance.applied_load;
  summary->support_reaction_N = report.balance.support_reaction;
  summary->equilibrium_residual = report.balance.residual;
  summary->inertia_share = report.balance.inertia_share;
  summary->momentum_residual = report.residuals.momentum;
  summary->contact_law_residual = report.residuals.contact_law;
  summary->friction_cone_violation = report.residuals.cone_violation;
  summary->certified_force_error = report.residuals.certified_force_error;
}

void judge(const Analysis& analysis, double worst_momentum, int unconverged_steps, Summary* summary) {
  summary->accuracy_asked = analysis.tolerance;
  summary->accuracy_reached = worst_momentum;
  const double speed = summary->max_speed_m_per_s;
  const double displacement = summary->max_displacement_m;
  if (unconverged_steps > 0) {
    summary->status = Status::unconverged;
    summary->message = fmt::format("{} of {} steps missed the momentum residual {:.1e}; worst {:.2e}",
                                   unconverged_steps, summary->steps, analysis.tolerance, worst_momentum);
  } else if (displacement > analysis.thresholds.displacement) {
    summary->status = Status::collapsed;
    summary->message = fmt::format("largest displacement {:.3g} m > {:.3g} m", displacement,
                                   analysis.thresholds.displacement);
  } else if (speed > analysis.thresholds.speed) {
    summary->status = Status::moving;
    summary->message =
        fmt::format("largest speed {:.3g} m/s > {:.3g} m/s at the end", speed, analysis.thresholds.speed);
  } else {
    summary->status = Status::stable;
    summary->message =
        fmt::format("largest speed {:.3g} m/s <= {:.3g} m/s, displacement {:.3g} m <= {:.3g} m", speed,
                    analysis.thresholds.speed, displacement, analysis.thresholds.displacement);
  }
}

}  // namespace

Summary run_dynamic(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks) {
  const Analysis& analysis = scene.analysis;
  Simulation simulation(make_model(scene, assembly),
                        {analysis.time_step, analysis.damping, analysis.recovery_speed, analysis.tangential},
                        detection_options(scene), analysis.tolerance);

  Summary summary;
  const int steps = static_cast<int>(std::llround(analysis.duration / analysis.time_step));
  const int steps_per_frame =
      std::max(1, static_cast<int>(std::llround(scene.output.frames_every / analysis.time_step)));
  double worst_momentum = 0.0;
  double friction_work = 0.0;
  int unconverged_steps = 0;
  const double started = wall_seconds();
  sinks.history(kHistoryHeader);
  for (int step = 1; step <= steps; ++step) {
    const StepReport report = simulation.advance();
    const Snapshot now = take_snapshot(simulation);
    const double time = simulation.state().time;
    friction_work += report.slid_work;
    summary.iterations += report.solve.iterations;
    worst_momentum = std::max(worst_momentum, report.residuals.momentum);
    if (report.solve.ending != SolveEnding::converged) ++unconverged_steps;
    sinks.history(history_row(time, report, now, friction_work));
    sinks.log(log_line(step, time, report, now));
    if (step % steps_per_frame != 0 && step != steps && report.solve.usable()) continue;

    const Frame frame = make_frame(simulation.model(), simulation.state(), simulation.contacts(),
                                   report.forces, simulation.memories(), simulation.displacements());
    sinks.frame(frame);
    summarize_frame(frame, simulation.model(), &summary);
    summarize_step(report, step, &summary);
    if (!report.solve.usable()) break;
  }
  summary.solve_time_seconds = wall_seconds() - started;
  summary.analysis = "dynamic";
  summary.time_step_s = analysis.time_step;
  judge(analysis, worst_momentum, unconverged_steps, &summary);
  return summary;
}

}  // namespace cupola
