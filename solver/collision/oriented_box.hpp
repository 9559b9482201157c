#pragma once

#include <Eigen/Geometry>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Box with arbitrary axes. It encloses a slender, inclined brick much more tightly than an axis-aligned box.
struct OrientedBox {
  Mat3 axes = Mat3::Identity();    ///< columns: unit vectors along its edges
  Vec3 center = Vec3::Zero();      ///< m
  Vec3 half_sizes = Vec3::Zero();  ///< m, along the axes
};

/// Smallest axis-aligned box that contains it.
Eigen::AlignedBox3d bounding_box(const OrientedBox& box);

/// True if two boxes overlap or are so close that rounding leaves the answer open (FCL).
bool overlap(const OrientedBox& a, const OrientedBox& b);

}  // namespace cupola
