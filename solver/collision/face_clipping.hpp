#pragma once

#include <vector>

#include "solver/collision/joint_patch.hpp"

namespace cupola {

/// The face contact of two convex parts: pairs of opposed faces within max_angle whose gap is within the
/// margin and whose overlap is wider than min_width and than it is deep. Convex bodies touch along one
/// plane: of several directions the one with the largest gap is kept, as in the separating axis test, with
/// all face pairs coplanar to it, sorted by face. Faces that overlap make a contact only where no face normal
/// of either part shows a smaller overlap, or a gap: thin parts further apart have opposed faces too. Faces
/// of kind `internal` make no contact. `pose_ab` takes coordinates in the axes of block b to those of block
/// a.
std::vector<JointPatch> clip_opposed_faces(const CollisionModel& model, int part_a, int part_b,
                                           const Eigen::Isometry3d& pose_ab,
                                           const NarrowPhaseOptions& options);

/// Overlap of two faces of the collision model, projected along `normal` (unit, from a to b); without
/// corners when they do not overlap. Of each corner the normal is set by what meets there.
JointPatch clip_faces(const CollisionModel& model, const CollisionFace& face_a, const CollisionFace& face_b,
                      const Eigen::Isometry3d& pose_ab, const Vec3& normal,
                      const NarrowPhaseOptions& options);

/// Whether a face of part a has all of part b farther than `margin` in front of it. Boxes of slender bricks
/// that lie askew overlap by hundreds.
/// `pose_ab` takes coordinates of b's block to those of a's.
bool lies_apart(const CollisionModel& model, int part_a, int part_b, const Eigen::Isometry3d& pose_ab,
                double margin);

}  // namespace cupola
