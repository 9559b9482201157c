#pragma once

#include <vector>

#include "solver/collision/joint_patch.hpp"

namespace cupola {

/// Face contact of two convex parts. `pose_ab` transforms coordinates from the axes of block b to those of
/// block a.
///
/// - Two faces touch when they are opposed within max_angle, their gap is within the margin, and the width of
///   their overlap exceeds both min_width and the overlap depth. Faces of kind `internal` never touch.
/// - Convex bodies touch along one plane. Among several directions the one with the largest distance is kept,
///   as in the separating axis test, with all face pairs coplanar to it, sorted by face. Where distances
///   differ by less than min_width times the difference in tilt, it is the one with the least tilt.
/// - Interpenetrating faces touch only if no face normal of either part shows a smaller overlap or a gap,
///   because thin parts that are apart have opposed faces too.
///
/// `narrow`: receives the overlaps narrower than min_width, of any direction, but for those of rounding.
std::vector<JointPatch> clip_opposed_faces(const CollisionModel& model, int part_a, int part_b,
                                           const Eigen::Isometry3d& pose_ab,
                                           const NarrowPhaseOptions& options,
                                           std::vector<JointPatch>* narrow = nullptr);

/// Overlap of two faces of the collision model, projected along `normal` (unit, from a to b). It has no
/// corners when the faces do not overlap. The normal at each corner depends on the features that meet there.
JointPatch clip_faces(const CollisionModel& model, const CollisionFace& face_a, const CollisionFace& face_b,
                      const Eigen::Isometry3d& pose_ab, const Vec3& normal,
                      const NarrowPhaseOptions& options);

/// True if all of part b lies farther than `margin` in front of some face of part a. This cheap test rejects
/// most of the many pairs of slender, inclined bricks whose boxes overlap.
bool separated_by_face(const CollisionModel& model, int part_a, int part_b, const Eigen::Isometry3d& pose_ab,
                       double margin);

}  // namespace cupola
