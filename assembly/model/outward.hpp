#pragma once

#include <Eigen/Core>

namespace cupola {

/// Horizontal unit vector outwards at the centroid of a joint: away from the z axis, in an arch away from the
/// plane x = 0. For a member that stands elsewhere see Assembly::outward. The thrust is the sum of the joint
/// forces along it, of an arch at one springing; tables, ranges and verification share this definition.
inline Eigen::Vector3d outward_at(const Eigen::Vector3d& centroid, bool arch) {
  if (arch) return {centroid.x() < 0.0 ? -1.0 : 1.0, 0.0, 0.0};
  return Eigen::Vector3d(centroid.x(), centroid.y(), 0.0).stableNormalized();
}

}  // namespace cupola
