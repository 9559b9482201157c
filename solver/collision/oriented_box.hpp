#pragma once

#include <Eigen/Geometry>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Box in any direction. It encloses a slender brick that stands askew far more closely than an upright box.
struct OrientedBox {
  Mat3 axes = Mat3::Identity();    ///< columns: unit vectors along its edges
  Vec3 center = Vec3::Zero();      ///< m
  Vec3 half_sizes = Vec3::Zero();  ///< m, along the axes
};

/// The box along the axes of the world around it.
Eigen::AlignedBox3d upright_box(const OrientedBox& box);

/// Whether two boxes overlap, or are so near to it that rounding leaves it open (FCL).
bool overlap(const OrientedBox& a, const OrientedBox& b);

}  // namespace cupola
