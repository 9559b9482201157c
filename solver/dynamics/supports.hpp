#pragma once

#include <vector>

#include "assembly/case/case.hpp"
#include "solver/collision/contact_set.hpp"

namespace cupola {

/// Imposed motion of one fixed block: displacement and rotation about a pivot, both times factor(t).
struct SupportMotion {
  int block = 0;
  Vec3 displacement = Vec3::Zero();  ///< m
  Vec3 rotation = Vec3::Zero();      ///< rad, rotation vector
  Vec3 pivot = Vec3::Zero();         ///< m
  TimeFunction time;
};

/// Throws InputError for blocks that do not exist or are free, and for an unreadable motion file.
std::vector<SupportMotion> make_support_motions(const Case& scene, const Assembly& assembly);

/// Moves the poses of the fixed blocks to where their motions put them at `time`; the others stay.
void place_supports(const Assembly& assembly, const std::vector<SupportMotion>& motions, double time,
                    std::vector<Pose>* poses);

/// Velocity of each block that takes `before` to `after` in h: m/s, then rad/s, world axes (6 x num_blocks).
Eigen::Matrix<double, 6, Eigen::Dynamic> block_velocities(const std::vector<Pose>& before,
                                                          const std::vector<Pose>& after, double h);

}  // namespace cupola
