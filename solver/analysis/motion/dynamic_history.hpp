#pragma once

#include <optional>
#include <string>

#include "solver/dynamics/simulation.hpp"

namespace cupola {

/// Momentum, speed and displacement at the end of a step, for the log and the history. The momentum is that in
/// the world, the others are relative to the ground.
struct Snapshot {
  Vec3 momentum = Vec3::Zero();  ///< N s
  double speed = 0.0;            ///< m/s, of the fastest point of a free block
  double displacement = 0.0;     ///< m, largest of distances_moved()
};
/// `seen`: the state of the simulation, seen from the ground.
Snapshot take_snapshot(const Simulation& simulation, const State& seen);

/// The energy of a run and what has changed it since its start, J.
struct RunEnergy {
  double start = 0.0;        ///< total at the start
  StepWork work;             ///< summed over the steps
  double error = 0.0;        ///< energy now - start - work.change()
  double worst_error = 0.0;  ///< largest absolute error over the run
  double peak_kinetic = 0.0;

  void include(const StepReport& report);
  /// worst_error over the larger of what was dissipated and the largest kinetic energy; nothing if neither is
  /// above 0.
  std::optional<double> relative_error() const;
};

/// history.csv: the header, and one row per step.
std::string history_header();
std::string history_row(double time, const StepReport& report, const Snapshot& now, const RunEnergy& energy);

/// One line of the log, fixed columns.
std::string log_line(int step, double time, const StepReport& report, const Snapshot& now);

}  // namespace cupola
