#pragma once

#include <optional>

#include "solver/collision/joint_patch.hpp"

namespace cupola {

/// Contact of two convex parts that touch with an edge or a vertex: a tumbling block, two crossing edges.
///
/// The separating axis test over the faces of both parts and the pairs of their edges gives the direction of
/// the largest gap, exact also where the parts overlap (GJK would need to shrink them first). On a face, the
/// faces of the other part that look at it are clipped to its outline and the corners within the margin are
/// kept: two points where an edge lies on a face, one for a vertex. Two edges touch in the points nearest to
/// each other. A face within max_angle of a face of the other part is left to clip_opposed_faces(). Nothing
/// is returned beyond the margin, where the face is `internal`, or where the parts merely meet along their
/// borders (all points within min_width of one).
std::optional<JointPatch> find_edge_contact(const CollisionModel& model, int part_a, int part_b,
                                            const Eigen::Isometry3d& pose_ab,
                                            const NarrowPhaseOptions& options);

}  // namespace cupola
