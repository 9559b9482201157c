#pragma once

#include <vector>

#include "assembly/case/case.hpp"
#include "solver/collision/contact_set.hpp"

namespace cupola {

/// Imposed motion of one fixed block: displacement and rotation about a pivot, both scaled by factor(t). The
/// displacements of several motions of a block, and of its turns about their pivots as built, add up.
struct SupportMotion {
  int block = 0;
  Vec3 displacement = Vec3::Zero();  ///< m
  Vec3 rotation = Vec3::Zero();      ///< rad, rotation vector
  Vec3 pivot = Vec3::Zero();         ///< m, as built
  TimeFunction time;
};

/// Motion of the ground, which all supports follow. Displacements and speeds in results are relative to it.
struct GroundMotion {
  Vec3 direction = Vec3::Zero();  ///< m per unit of the factor; zero: the ground does not move
  TimeFunction time;

  Vec3 displacement(double at) const { return factor_at(time, at) * direction; }  ///< m
};

/// Reads supports.base_motion. Throws InputError for a file that cannot be read.
GroundMotion make_ground_motion(const Case& scene);

/// Throws InputError for blocks that do not exist or are free, and for a motion file that cannot be read.
std::vector<SupportMotion> make_support_motions(const Case& scene, const Assembly& assembly);

/// Sets the poses of the moving supports to their imposed positions at `time` (s). Other poses do not change.
void place_supports(const Assembly& assembly, const std::vector<SupportMotion>& motions, double time,
                    std::vector<Pose>* poses);

/// Constant velocity of each block that moves it from `before` to `after` in h (s): m/s, then rad/s, world
/// axes (6 x num_blocks).
Eigen::Matrix<double, 6, Eigen::Dynamic> block_velocities(const std::vector<Pose>& before,
                                                          const std::vector<Pose>& after, double h);

}  // namespace cupola
