#pragma once

#include <string>

#include "solver/dynamics/simulation.hpp"

namespace cupola {

/// Energy, momentum, speed and displacement at the end of a step, for the log and the history.
struct Snapshot {
  Energy energy;
  Vec3 momentum = Vec3::Zero();  ///< N s
  double speed = 0.0;            ///< m/s, of the fastest block
  double displacement = 0.0;     ///< m, largest distance of a free block from its position as built
};
Snapshot take_snapshot(const Simulation& simulation);

/// history.csv: the header, and one row per step. `friction_work`: J, dissipated since time 0.
std::string history_header();
std::string history_row(double time, const StepReport& report, const Snapshot& now, double friction_work);

/// One line of the log, fixed columns.
std::string log_line(int step, double time, const StepReport& report, const Snapshot& now);

}  // namespace cupola
