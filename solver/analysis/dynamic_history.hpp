#pragma once

#include <string>

#include "solver/dynamics/simulation.hpp"

namespace cupola {

/// Speeds, energies and sums at the end of a step, for the log and the history.
struct Snapshot {
  Energy energy;
  Vec3 momentum = Vec3::Zero();  ///< N s
  double speed = 0.0;            ///< m/s, fastest block
  double displacement = 0.0;     ///< m, of the free block that went furthest from where it was built
};
Snapshot take_snapshot(const Simulation& simulation);

/// history.csv: header and one row per step.
std::string history_header();
std::string history_row(double time, const StepReport& report, const Snapshot& now, double friction_work);

/// One line of the log, fixed columns.
std::string log_line(int step, double time, const StepReport& report, const Snapshot& now);

}  // namespace cupola
