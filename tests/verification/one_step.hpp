#pragma once

#include <algorithm>
#include <stdexcept>

#include "tests/solver/accounted_simulation.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::verification {

/// Largest component of a centroid's velocity over g h after one step from rest with rigid contacts. It
/// depends only on geometry and friction, and is zero if and only if forces in the friction cones balance the
/// loads.
inline double speed_after_one_step(const Assembly& assembly, double friction, const Vec3& gravity) {
  Case scene = testing::make_case(friction, 0.0, 0.01);
  scene.analysis.tolerance = 1e-9;
  scene.loads.gravity = gravity;
  testing::AccountedSimulation simulation(scene, assembly);
  const StepReport report = simulation.advance();
  if (report.solve.ending != SolveEnding::converged) throw std::runtime_error(report.solve.message);
  double largest = 0.0;
  for (Eigen::Index i = 0; i < simulation.state().v.size(); i += 6)
    largest = std::max(largest, simulation.state().v.segment<3>(i).cwiseAbs().maxCoeff());
  return largest / (gravity.norm() * scene.analysis.time_step);
}

}  // namespace cupola::verification
