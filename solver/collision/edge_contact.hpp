#pragma once

#include <optional>

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
/// - the parts only meet along a border: all points lie within min_width of one edge of the face.
std::optional<JointPatch> find_edge_contact(const CollisionModel& model, int part_a, int part_b,
                                            const Eigen::Isometry3d& pose_ab,
                                            const NarrowPhaseOptions& options);

}  // namespace cupola
