#include "solver/collision/separating_axis.hpp"

#include <algorithm>
#include <functional>

namespace cupola {
namespace {

SeparatingAxis axis_along(const Vec3& normal, double gap, const CollisionFace* face_a,
                          const CollisionFace* face_b) {
  SeparatingAxis axis;
  axis.normal = normal;
  axis.gap = gap;
  axis.face_a = face_a;
  axis.face_b = face_b;
  return axis;
}

double lowest(const std::vector<Vec3>& vertices, const Vec3& direction) {
  double height = std::numeric_limits<double>::infinity();
  for (const Vec3& x : vertices) height = std::min(height, direction.dot(x));
  return height;
}

/// The axes along the face normals of both parts, until `visit` returns false.
template <class Visit>
void visit_face_axes(const TwoParts& parts, const Visit& visit) {
  for (const CollisionFace& face : parts.model.faces_of(parts.a)) {
    const double gap = lowest(parts.vertices_b, face.normal) - face.normal.dot(face.centroid);
    if (!visit(axis_along(face.normal, gap, &face, nullptr))) return;
  }
  for (const CollisionFace& face : parts.model.faces_of(parts.b)) {
    const Vec3 outward = parts.pose_ab.linear() * face.normal;
    const double gap = lowest(parts.vertices_a, outward) - outward.dot(parts.pose_ab * face.centroid);
    if (!visit(axis_along(-outward, gap, nullptr, &face))) return;
  }
}

/// Nearest points of the lines of two edges p + s d and q + t e, which must not be parallel. False when one
/// of the points lies outside its edge or within `border` (m) of an end.
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

}  // namespace

TwoParts place_parts(const CollisionModel& model, int part_a, int part_b, const Eigen::Isometry3d& pose_ab) {
  TwoParts parts{model, model.parts[part_a], model.parts[part_b], pose_ab, {}, {}};
  const auto local_a = model.vertices_of(parts.a);
  parts.vertices_a.assign(local_a.begin(), local_a.end());
  for (const Vec3& x : model.vertices_of(parts.b)) parts.vertices_b.push_back(pose_ab * x);
  return parts;
}

SeparatingAxis best_face_axis(const TwoParts& parts, double margin) {
  SeparatingAxis best;
  visit_face_axes(parts, [&](const SeparatingAxis& axis) {
    if (axis.gap > best.gap) best = axis;
    return best.gap <= margin;
  });
  return best;
}

std::vector<SeparatingAxis> face_axes_above(const TwoParts& parts, double gap) {
  std::vector<SeparatingAxis> axes;
  visit_face_axes(parts, [&](const SeparatingAxis& axis) {
    if (axis.gap > gap) axes.push_back(axis);
    return true;
  });
  std::ranges::stable_sort(axes, std::greater(), &SeparatingAxis::gap);
  return axes;
}

SeparatingAxis best_edge_axis(const TwoParts& parts, const NarrowPhaseOptions& options) {
  SeparatingAxis best;
  for (const CollisionEdge& i : parts.model.edges_of(parts.a)) {
    const Vec3& p = parts.vertices_a[i.start - parts.a.vertex_start];
    const Vec3 d = parts.vertices_a[i.end - parts.a.vertex_start] - p;
    for (const CollisionEdge& k : parts.model.edges_of(parts.b)) {
      const Vec3& q = parts.vertices_b[k.start - parts.b.vertex_start];
      const Vec3 e = parts.vertices_b[k.end - parts.b.vertex_start] - q;
      Vec3 normal = d.cross(e);
      if (normal.norm() < 0.05 * d.norm() * e.norm())
        continue;  // nearly parallel: a face normal separates as well
      normal.normalize();
      if (normal.dot(p - parts.a.center) < 0.0) normal = -normal;
      const double gap = normal.dot(q - p);
      if (gap <= best.gap) continue;
      if (-lowest(parts.vertices_a, -normal) > normal.dot(p) + options.tolerance) continue;
      if (lowest(parts.vertices_b, normal) < normal.dot(q) - options.tolerance) continue;
      SeparatingAxis axis = axis_along(normal, gap, nullptr, nullptr);
      if (nearest_on_edges(p, d, q, e, options.min_width, &axis.point_a, &axis.point_b)) best = axis;
    }
  }
  return best;
}

double separation(const CollisionModel& model, int part_a, int part_b, const Eigen::Isometry3d& pose_ab,
                  const NarrowPhaseOptions& options) {
  const TwoParts parts = place_parts(model, part_a, part_b, pose_ab);
  const double face_gap = best_face_axis(parts, options.margin).gap;
  if (face_gap >= -options.tolerance) return face_gap;  // no overlap: edge pairs cannot change the verdict
  return std::max(face_gap, best_edge_axis(parts, options).gap);
}

}  // namespace cupola
