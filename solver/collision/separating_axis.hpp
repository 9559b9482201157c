#pragma once

#include <limits>
#include <vector>

#include "solver/collision/joint_patch.hpp"

namespace cupola {

/// Two convex parts in the axes of block a. Refers to the model and the pose, which must outlive it.
struct TwoParts {
  const CollisionModel& model;
  const CollisionPart& a;
  const CollisionPart& b;
  const Eigen::Isometry3d& pose_ab;
  std::vector<Vec3> vertices_a, vertices_b;
};
TwoParts place_parts(const CollisionModel& model, int part_a, int part_b, const Eigen::Isometry3d& pose_ab);

/// Direction from a to b and the gap along it, negative when the parts overlap along it.
struct SeparatingAxis {
  Vec3 normal = Vec3::UnitZ();
  double gap = -std::numeric_limits<double>::infinity();
  const CollisionFace* face_a = nullptr;  ///< face whose normal it is, if any
  const CollisionFace* face_b = nullptr;
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();  ///< nearest points of two edges
};

/// The face normal of either part with the largest gap; stops at the first that separates the parts by more
/// than the margin.
SeparatingAxis best_face_axis(const TwoParts& parts, double margin);

/// The common normal of two edges, outermost of their parts along it, with the largest gap.
SeparatingAxis best_edge_axis(const TwoParts& parts, const NarrowPhaseOptions& options);

/// Largest gap (m) between the parts along any face normal or common normal of two edges: their distance
/// where a face or two edges are nearest, less than it where vertices are, and minus the depth of their
/// overlap where it is negative.
double separation(const CollisionModel& model, int part_a, int part_b, const Eigen::Isometry3d& pose_ab,
                  const NarrowPhaseOptions& options);

}  // namespace cupola
