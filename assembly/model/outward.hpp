#pragma once

#include <Eigen/Core>

namespace cupola {

/// Horizontal unit vector outwards at the centroid of a joint: away from the z axis, in an arch away from the
/// plane x = 0. For a member that stands elsewhere see Assembly::outward. The thrust is the sum of the joint
/// forces along it, of an arch at one springing; tables, ranges and verification share this definition.
/// At the crown of an arch, up to rounding, it is towards +x, on the axis of a vault it is zero.
inline Eigen::Vector3d outward_at(const Eigen::Vector3d& centroid, bool arch) {
  const double rounding = 1e-9 * centroid.norm();
  if (arch) return {centroid.x() < -rounding ? -1.0 : 1.0, 0.0, 0.0};
  const Eigen::Vector3d away(centroid.x(), centroid.y(), 0.0);
  return away.norm() <= rounding ? Eigen::Vector3d::Zero() : Eigen::Vector3d(away.stableNormalized());
}

}  // namespace cupola
