#pragma once

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Horizontal unit vector outwards at the centroid of a joint: away from the z axis, in an arch away from the plane x = 0.
/// The thrust is the sum of the joint forces along it, of an arch at one springing; tables, ranges and verification share
/// this definition.
inline Vec3 outward_at(const Vec3& centroid, bool arch) {
  if (arch) return {centroid.x() < 0.0 ? -1.0 : 1.0, 0.0, 0.0};
  return Vec3(centroid.x(), centroid.y(), 0.0).stableNormalized();
}

}  // namespace cupola
