#include "solver/collision/edge_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/collision/face_clipping.hpp"

namespace cupola {
namespace {

/// Two convex parts in the axes of block a.
struct PartPair {
  const CollisionModel& model;
  const CollisionPart& a;
  const CollisionPart& b;
  const Eigen::Isometry3d& pose_ab;
  std::vector<Vec3> vertices_a, vertices_b;
};

/// Direction from a to b and the gap along it, negative when the parts overlap along it.
struct Axis {
  Vec3 normal = Vec3::UnitZ();
  double gap = -std::numeric_limits<double>::infinity();
  const CollisionFace* face_a = nullptr;  ///< face whose normal it is, if any
  const CollisionFace* face_b = nullptr;
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();  ///< nearest points of two edges
};

Axis axis_along(const Vec3& normal, double gap, const CollisionFace* face_a, const CollisionFace* face_b) {
  Axis axis;
  axis.normal = normal;
  axis.gap = gap;
  axis.face_a = face_a;
  axis.face_b = face_b;
  return axis;
}

PartPair make_pair(const CollisionModel& model, int part_a, int part_b, const Eigen::Isometry3d& pose_ab) {
  PartPair pair{model, model.parts[part_a], model.parts[part_b], pose_ab, {}, {}};
  const auto local_a = model.vertices_of(pair.a);
  pair.vertices_a.assign(local_a.begin(), local_a.end());
  for (const Vec3& x : model.vertices_of(pair.b)) pair.vertices_b.push_back(pose_ab * x);
  return pair;
}

double lowest(const std::vector<Vec3>& vertices, const Vec3& direction) {
  double height = std::numeric_limits<double>::infinity();
  for (const Vec3& x : vertices) height = std::min(height, direction.dot(x));
  return height;
}

/// Best of the face normals; stops at the first that separates the parts by more than the margin.
Axis best_face_axis(const PartPair& pair, double margin) {
  Axis best;
  for (const CollisionFace& face : pair.model.faces_of(pair.a)) {
    const double gap = lowest(pair.vertices_b, face.normal) - face.normal.dot(face.centroid);
    if (gap > best.gap) best = axis_along(face.normal, gap, &face, nullptr);
    if (best.gap > margin) return best;
  }
  for (const CollisionFace& face : pair.model.faces_of(pair.b)) {
    const Vec3 outward = pair.pose_ab.linear() * face.normal;
    const double gap = lowest(pair.vertices_a, outward) - outward.dot(pair.pose_ab * face.centroid);
    if (gap > best.gap) best = axis_along(-outward, gap, nullptr, &face);
    if (best.gap > margin) return best;
  }
  return best;
}

/// Nearest points of the edges p + s d and q + t e, not parallel; false when those of their lines lie beyond
/// the edges or within `border` of their ends.
bool nearest_on_edges(const Vec3& p, const Vec3& d, const Vec3& q, const Vec3& e, double border, Vec3* on_p,
                      Vec3* on_q) {
  const Vec3 r = q - p;
  const double dd = d.dot(d), de = d.dot(e), ee = e.dot(e);
  const double determinant = dd * ee - de * de;
  const double s = (r.dot(d) * ee - r.dot(e) * de) / determinant;
  const double t = (r.dot(d) * de - r.dot(e) * dd) / determinant;
  *on_p = p + s * d;
  *on_q = q + t * e;
  const double s_border = border / d.norm();
  const double t_border = border / e.norm();
  return s >= s_border && s <= 1.0 - s_border && t >= t_border && t <= 1.0 - t_border;
}

/// Best of the common normals of two edges that both lie on the outside along it.
Axis best_edge_axis(const PartPair& pair, const NarrowPhaseOptions& options) {
  Axis best;
  for (const CollisionEdge& i : pair.model.edges_of(pair.a)) {
    const Vec3& p = pair.vertices_a[i.start - pair.a.vertex_start];
    const Vec3 d = pair.vertices_a[i.end - pair.a.vertex_start] - p;
    for (const CollisionEdge& k : pair.model.edges_of(pair.b)) {
      const Vec3& q = pair.vertices_b[k.start - pair.b.vertex_start];
      const Vec3 e = pair.vertices_b[k.end - pair.b.vertex_start] - q;
      Vec3 normal = d.cross(e);
      if (normal.norm() < 0.05 * d.norm() * e.norm()) continue;  // parallel edges: a face normal will do
      normal.normalize();
      if (normal.dot(p - pair.a.center) < 0.0) normal = -normal;
      const double gap = normal.dot(q - p);
      if (gap <= best.gap) continue;
      if (-lowest(pair.vertices_a, -normal) > normal.dot(p) + options.tolerance) continue;
      if (lowest(pair.vertices_b, normal) < normal.dot(q) - options.tolerance) continue;
      Axis axis = axis_along(normal, gap, nullptr, nullptr);
      if (nearest_on_edges(p, d, q, e, options.min_width, &axis.point_a, &axis.point_b)) best = axis;
    }
  }
  return best;
}

/// Is there a face of the other part nearly opposed to the axis's face?
bool has_opposed_face(const PartPair& pair, const Axis& axis, double max_angle) {
  const double opposed = -std::cos(max_angle);
  if (axis.face_a)
    return std::ranges::any_of(pair.model.faces_of(pair.b), [&](const CollisionFace& face) {
      return axis.normal.dot(pair.pose_ab.linear() * face.normal) <= opposed;
    });
  return std::ranges::any_of(pair.model.faces_of(pair.a), [&](const CollisionFace& face) {
    return -axis.normal.dot(face.normal) <= opposed;
  });
}

/// Do all points lie within min_width of one border of the axis's face? Such parts meet along their borders,
/// as blocks on either side of a mitre do, and carry nothing there.
bool along_border(const PartPair& pair, const Axis& axis, const JointPatch& points, double min_width) {
  std::vector<Vec3> outline;
  if (axis.face_a) {
    const auto corners = pair.model.face_corners(*axis.face_a);
    outline.assign(corners.begin(), corners.end());
  } else {
    for (const Vec3& x : pair.model.face_corners(*axis.face_b)) outline.push_back(pair.pose_ab * x);
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

/// Corners, within the margin, of the faces that look at the axis's face, clipped to its outline.
JointPatch points_on_face(const PartPair& pair, const Axis& axis, const NarrowPhaseOptions& options) {
  constexpr double kLooksAt = -0.1;  // cosine; steeper faces have no height over the plane worth the name
  JointPatch points;
  points.origin = axis.face_a ? axis.face_a->centroid : pair.pose_ab * axis.face_b->centroid;
  points.set_normal(axis.normal);
  points.min_gap = std::numeric_limits<double>::infinity();
  const CornerNormal of_face{axis.normal, axis.face_a ? 1.0 : 0.0};
  const double nearly_along = std::cos(options.max_angle);
  const auto add_corners = [&](const CollisionFace& face_a, const CollisionFace& face_b) {
    const JointPatch clipped = clip_faces(pair.model, face_a, face_b, pair.pose_ab, axis.normal, options);
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
    for (const CollisionFace& face : pair.model.faces_of(pair.b))
      if (axis.normal.dot(pair.pose_ab.linear() * face.normal) < kLooksAt) add_corners(*axis.face_a, face);
  } else {
    for (const CollisionFace& face : pair.model.faces_of(pair.a))
      if (-axis.normal.dot(face.normal) < kLooksAt) add_corners(face, *axis.face_b);
  }
  if (along_border(pair, axis, points, options.min_width)) points.corners.clear();
  return points;
}

JointPatch crossing_edges(const Axis& axis) {
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
  const PartPair pair = make_pair(model, part_a, part_b, pose_ab);
  const Axis face_axis = best_face_axis(pair, options.margin);
  if (face_axis.gap > options.margin) return std::nullopt;
  const bool opposed = has_opposed_face(pair, face_axis, options.max_angle);
  if (opposed && face_axis.gap > -options.margin) return std::nullopt;  // spares the edges of most neighbours
  const Axis edge_axis = best_edge_axis(pair, options);
  if (edge_axis.gap > options.margin) return std::nullopt;

  // Where an edge lies across the border of a face, the crossing of that border is one corner of the face
  // contact; taken alone it would lose the other end. So edges win only with another normal.
  const bool same_normal = edge_axis.normal.dot(face_axis.normal) > std::cos(options.max_angle);
  const CollisionFace& face = face_axis.face_a ? *face_axis.face_a : *face_axis.face_b;
  JointPatch contact;
  if (!opposed && face.kind != FaceKind::internal && (same_normal || face_axis.gap >= edge_axis.gap))
    contact = points_on_face(pair, face_axis, options);
  FaceKind kind = face.kind;
  if (contact.corners.empty()) {
    if (face_axis.gap >= edge_axis.gap) return std::nullopt;
    contact = crossing_edges(edge_axis);
    kind = FaceKind::free;
  }
  contact.part_a = part_a;
  contact.part_b = part_b;
  classify(pair.a, kind, pair.b, FaceKind::free, &contact);
  return contact;
}

double separation(const CollisionModel& model, int part_a, int part_b, const Eigen::Isometry3d& pose_ab,
                  const NarrowPhaseOptions& options) {
  const PartPair pair = make_pair(model, part_a, part_b, pose_ab);
  const double face_gap = best_face_axis(pair, options.margin).gap;
  if (face_gap >= -options.tolerance) return face_gap;  // they touch: edges could only say the same
  return std::max(face_gap, best_edge_axis(pair, options).gap);
}

}  // namespace cupola
