#pragma once

#include <optional>
#include <vector>

#include "solver/collision/joint_patch.hpp"

namespace cupola {

/// Contact of two convex parts that touch at an edge or a vertex, such as a tumbling block or two crossing
/// edges. `pose_ab` transforms coordinates from the axes of block b to those of block a.
///
/// The separating axis test over the face normals of both parts and the pairs of their edges gives the
/// direction of the largest gap. It is exact for overlapping parts too, where GJK would have to shrink them
/// first. There are two cases:
///
/// - Face: the faces of the other part that are turned towards it are clipped to its outline, and the corners
///   within the margin are kept. An edge on a face gives two points, a vertex gives one.
/// - Two edges: they touch at their nearest points.
///
/// Returns nothing in these cases:
///
/// - the gap exceeds the margin;
/// - the face is within max_angle of a face of the other part, which clip_opposed_faces() handles;
/// - the face is `internal`;
/// - the parts only meet along a border: all points lie within min_width of one edge of the face, and the
///   surface of the block goes on neither in its plane nor, at a re-entrant edge, in front of it.
std::optional<JointPatch> find_edge_contact(const CollisionModel& model, int part_a, int part_b,
                                            const Eigen::Isometry3d& pose_ab,
                                            const NarrowPhaseOptions& options);

/// Drops the edge and vertex contacts of two blocks whose points lie in a patch of about the same normal, as
/// where the edge of one part is the border of the next.
void drop_held_edges(const NarrowPhaseOptions& options, std::vector<JointPatch>* patches);

}  // namespace cupola
