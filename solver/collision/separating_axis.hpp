#pragma once

#include <limits>
#include <vector>

#include "solver/collision/joint_patch.hpp"

namespace cupola {

/// Two convex parts, vertices in the axes of block a. Refers to the model and the pose, which must outlive
/// it.
struct TwoParts {
  const CollisionModel& model;
  const CollisionPart& a;
  const CollisionPart& b;
  const Eigen::Isometry3d& pose_ab;
  std::vector<Vec3> vertices_a, vertices_b;
};
TwoParts place_parts(const CollisionModel& model, int part_a, int part_b, const Eigen::Isometry3d& pose_ab);

/// Unit direction from a to b and the gap along it (m), negative when the parts overlap along it.
struct SeparatingAxis {
  Vec3 normal = Vec3::UnitZ();
  double gap = -std::numeric_limits<double>::infinity();
  const CollisionFace* face_a = nullptr;  ///< the face that the axis is normal to, of a or of b, if any
  const CollisionFace* face_b = nullptr;
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();  ///< m, nearest points of two edges otherwise
};

/// The face normal of either part with the largest gap. Stops at the first normal that separates the parts by
/// more than the margin.
SeparatingAxis best_face_axis(const TwoParts& parts, double margin);

/// The face normals of both parts with a larger gap than `gap` (m), the largest first. Parts that meet in an
/// edge have several of almost the same gap.
std::vector<SeparatingAxis> face_axes_above(const TwoParts& parts, double gap);

/// The common normal with the largest gap of two edges, each the outermost of its part along that normal.
SeparatingAxis best_edge_axis(const TwoParts& parts, const NarrowPhaseOptions& options);

/// Largest gap (m) between the parts along any face normal or common normal of two edges. This is their
/// distance if the nearest features include a face or are two edges, and a lower bound of it if they include
/// a vertex and no face. If negative, it is minus the penetration depth.
double separation(const CollisionModel& model, int part_a, int part_b, const Eigen::Isometry3d& pose_ab,
                  const NarrowPhaseOptions& options);

}  // namespace cupola
