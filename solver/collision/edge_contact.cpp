#include "solver/collision/edge_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/collision/face_clipping.hpp"
#include "solver/collision/separating_axis.hpp"

namespace cupola {
namespace {

/// True if the other part has a face opposed within `max_angle` to the face of the axis.
bool has_opposed_face(const TwoParts& parts, const SeparatingAxis& axis, double max_angle) {
  const double opposed = -std::cos(max_angle);
  if (axis.face_a)
    return std::ranges::any_of(parts.model.faces_of(parts.b), [&](const CollisionFace& face) {
      return axis.normal.dot(parts.pose_ab.linear() * face.normal) <= opposed;
    });
  return std::ranges::any_of(parts.model.faces_of(parts.a), [&](const CollisionFace& face) {
    return -axis.normal.dot(face.normal) <= opposed;
  });
}

/// True if all points lie within min_width of one edge of the face of the axis. Such parts meet along their
/// borders, like the blocks on both sides of a mitre, and transfer no force there.
bool along_border(const TwoParts& parts, const SeparatingAxis& axis, const JointPatch& points,
                  double min_width) {
  std::vector<Vec3> outline;
  if (axis.face_a) {
    const auto corners = parts.model.face_corners(*axis.face_a);
    outline.assign(corners.begin(), corners.end());
  } else {
    for (const Vec3& x : parts.model.face_corners(*axis.face_b)) outline.push_back(parts.pose_ab * x);
    std::reverse(outline.begin(), outline.end());  // counter-clockwise about the normal, as a's
  }
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 start = points.project(outline[i]);
    const Vec2 edge = points.project(outline[(i + 1) % outline.size()]) - start;
    const bool all_near = std::ranges::all_of(points.corners, [&](const PatchCorner& corner) {
      const Vec2 r = corner.position - start;
      return edge.x() * r.y() - edge.y() * r.x() < min_width * edge.norm();
    });
    if (all_near) return true;
  }
  return false;
}

/// Faces turned towards the face of the axis, clipped to its outline: the corners within the margin.
JointPatch points_on_face(const TwoParts& parts, const SeparatingAxis& axis,
                          const NarrowPhaseOptions& options) {
  constexpr double kFacing = -0.1;  // cosine; on steeper faces the height over the plane is ill-conditioned
  JointPatch points;
  points.origin = axis.face_a ? axis.face_a->centroid : parts.pose_ab * axis.face_b->centroid;
  points.set_normal(axis.normal);
  points.min_gap = std::numeric_limits<double>::infinity();
  const CornerNormal of_face{axis.normal, axis.face_a ? 1.0 : 0.0};
  const double nearly_along = std::cos(options.max_angle);
  const auto add_corners = [&](const CollisionFace& face_a, const CollisionFace& face_b) {
    const JointPatch clipped = clip_faces(parts.model, face_a, face_b, parts.pose_ab, axis.normal, options);
    for (const PatchCorner& corner : clipped.corners) {
      const LiftedPoint x = lift_to_faces(clipped, corner.position);
      if (x.gap > options.margin) continue;
      const Vec2 position = points.project(x.on_a);
      const bool known = std::ranges::any_of(points.corners, [&](const PatchCorner& other) {
        return (other.position - position).norm() <= 10.0 * options.tolerance;
      });
      if (known) continue;
      const bool steep = corner.normal.normal.dot(axis.normal) < nearly_along;
      points.corners.push_back({position, steep ? of_face : corner.normal});
      points.touching.push_back(x);
      points.min_gap = std::min(points.min_gap, x.gap);
    }
  };
  points.face_a = axis.face_a ? axis.face_a->id : -1;
  points.face_b = axis.face_b ? axis.face_b->id : -1;
  if (axis.face_a) {
    for (const CollisionFace& face : parts.model.faces_of(parts.b))
      if (axis.normal.dot(parts.pose_ab.linear() * face.normal) < kFacing) add_corners(*axis.face_a, face);
  } else {
    for (const CollisionFace& face : parts.model.faces_of(parts.a))
      if (-axis.normal.dot(face.normal) < kFacing) add_corners(face, *axis.face_b);
  }
  if (along_border(parts, axis, points, options.min_width)) points.corners.clear();
  return points;
}

JointPatch crossing_edges(const SeparatingAxis& axis) {
  JointPatch crossing;
  crossing.origin = axis.point_a;
  crossing.set_normal(axis.normal);
  crossing.corners.push_back({Vec2::Zero(), {axis.normal, 0.5}});
  crossing.touching.push_back({axis.point_a, axis.point_b, axis.gap});
  crossing.min_gap = axis.gap;
  return crossing;
}

}  // namespace

std::optional<JointPatch> find_edge_contact(const CollisionModel& model, int part_a, int part_b,
                                            const Eigen::Isometry3d& pose_ab,
                                            const NarrowPhaseOptions& options) {
  const TwoParts parts = place_parts(model, part_a, part_b, pose_ab);
  const SeparatingAxis face_axis = best_face_axis(parts, options.margin);
  if (face_axis.gap > options.margin) return std::nullopt;
  const bool opposed = has_opposed_face(parts, face_axis, options.max_angle);
  if (opposed && face_axis.gap > -options.margin) return std::nullopt;  // skips the edges of most neighbours
  const SeparatingAxis edge_axis = best_edge_axis(parts, options);
  if (edge_axis.gap > options.margin) return std::nullopt;

  // If an edge crosses the border of a face, the crossing is one corner of the face contact; the edge contact
  // alone would lose the other corner. Therefore the edge axis is used only if its normal differs.
  const bool same_normal = edge_axis.normal.dot(face_axis.normal) > std::cos(options.max_angle);
  const CollisionFace& face = face_axis.face_a ? *face_axis.face_a : *face_axis.face_b;
  JointPatch contact;
  if (!opposed && face.kind != FaceKind::internal && (same_normal || face_axis.gap >= edge_axis.gap))
    contact = points_on_face(parts, face_axis, options);
  FaceKind kind = face.kind;
  if (contact.corners.empty()) {
    if (face_axis.gap >= edge_axis.gap) return std::nullopt;
    contact = crossing_edges(edge_axis);
    kind = FaceKind::free;
  }
  contact.part_a = part_a;
  contact.part_b = part_b;
  classify(parts.a, kind, parts.b, FaceKind::free, &contact);
  return contact;
}

}  // namespace cupola
