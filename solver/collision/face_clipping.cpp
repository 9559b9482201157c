#include "solver/collision/face_clipping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cupola {
namespace {

/// Two unit vectors that complete n to a right-handed frame.
void complete_frame(const Vec3& n, Vec3* u, Vec3* v) {
  int smallest = 0;
  n.cwiseAbs().minCoeff(&smallest);
  *u = n.cross(Vec3::Unit(smallest)).normalized();
  *v = n.cross(*u);
}

/// Face b as block a sees it.
struct MovedFace {
  Vec3 normal, centroid;
};

/// Cheap bounds: can the two faces be within the margin of each other, and overlap less deeply than wide?
bool may_touch(const CollisionFace& a, const CollisionFace& b, const MovedFace& moved_b, const Vec3& normal,
               double margin) {
  const Vec3 offset = moved_b.centroid - a.centroid;
  const double gap = normal.dot(offset);
  const double tilt_reach = (a.radius + b.radius) * (a.normal + moved_b.normal).norm();
  if (gap - tilt_reach > margin) return false;
  if (gap + tilt_reach < -2.0 * std::min(a.radius, b.radius)) return false;
  return (offset - gap * normal).norm() <= a.radius + b.radius;
}

std::vector<Vec2> project(std::span<const Vec3> corners, const FacePatch& patch) {
  std::vector<Vec2> projected;
  projected.reserve(corners.size());
  for (const Vec3& x : corners) {
    const Vec3 r = x - patch.origin;
    projected.emplace_back(patch.u.dot(r), patch.v.dot(r));
  }
  return projected;
}

std::vector<Vec2> positions(const std::vector<ClipCorner>& corners) {
  std::vector<Vec2> xs;
  xs.reserve(corners.size());
  for (const ClipCorner& corner : corners) xs.push_back(corner.position);
  return xs;
}

/// Clips one pair of faces; no corners are left when they make no contact.
FacePatch clip_faces(const CollisionModel& model, const CollisionFace& a, const CollisionFace& b,
                     const MovedFace& moved_b, const Eigen::Isometry3d& pose_ab,
                     const ClippingOptions& options) {
  FacePatch patch;
  patch.face_a = static_cast<int>(&a - model.faces.data());
  patch.face_b = static_cast<int>(&b - model.faces.data());
  patch.origin = a.centroid;
  patch.normal = (a.normal - moved_b.normal).normalized();
  complete_frame(patch.normal, &patch.u, &patch.v);
  patch.plane_a = {a.normal, a.normal.dot(a.centroid)};
  patch.plane_b = {moved_b.normal, moved_b.normal.dot(moved_b.centroid)};

  std::vector<Vec3> corners_b;  // reversed, so that they too turn counter-clockwise about the patch's normal
  for (const Vec3& x : model.face_corners(b)) corners_b.push_back(pose_ab * x);
  std::reverse(corners_b.begin(), corners_b.end());
  patch.corners = clip_convex_polygon(project(model.face_corners(a), patch), project(corners_b, patch),
                                      options.tolerance);
  if (patch.corners.empty()) return patch;

  patch.min_gap = std::numeric_limits<double>::infinity();
  for (const ClipCorner& corner : patch.corners)
    patch.min_gap = std::min(patch.min_gap, lift_to_faces(patch, corner.position).gap);
  const double width = polygon_width(positions(patch.corners));
  if (patch.min_gap > options.margin || width < options.min_width || -patch.min_gap > width)
    patch.corners.clear();
  return patch;
}

bool same_planes(const CollisionModel& model, const FacePatch& p, const FacePatch& q) {
  constexpr double kCosine = 1.0 - 1e-9;  // 4.5e-5 rad: facets of one plane, cut up
  return model.faces[p.face_a].normal.dot(model.faces[q.face_a].normal) > kCosine &&
         model.faces[p.face_b].normal.dot(model.faces[q.face_b].normal) > kCosine;
}

/// Corners i and i + 1 of a face.
Vec3 edge_of(std::span<const Vec3> corners, int i) {
  return corners[(i + 1) % corners.size()] - corners[i];
}

}  // namespace

std::vector<FacePatch> clip_opposed_faces(const CollisionModel& model, const CollisionPart& part_a,
                                          const CollisionPart& part_b, const Eigen::Isometry3d& pose_ab,
                                          const ClippingOptions& options) {
  std::vector<FacePatch> patches;
  const double opposed = -std::cos(options.max_angle);
  std::vector<MovedFace> moved_faces;
  for (const CollisionFace& b : model.faces_of(part_b))
    moved_faces.push_back({pose_ab.linear() * b.normal, pose_ab * b.centroid});
  for (const CollisionFace& a : model.faces_of(part_a)) {
    for (int i = 0; i < part_b.num_faces; ++i) {
      const CollisionFace& b = model.faces[part_b.face_start + i];
      const MovedFace& moved_b = moved_faces[i];
      if (a.normal.dot(moved_b.normal) > opposed) continue;
      const Vec3 normal = (a.normal - moved_b.normal).normalized();
      if (!may_touch(a, b, moved_b, normal, options.margin)) continue;
      FacePatch patch = clip_faces(model, a, b, moved_b, pose_ab, options);
      if (!patch.corners.empty()) patches.push_back(std::move(patch));
    }
  }
  if (patches.size() <= 1) return patches;
  const auto by_gap = [](const FacePatch& p, const FacePatch& q) { return p.min_gap < q.min_gap; };
  const FacePatch best = *std::max_element(patches.begin(), patches.end(), by_gap);
  std::erase_if(patches, [&](const FacePatch& p) { return !same_planes(model, p, best); });
  return patches;
}

FacePatchPoint lift_to_faces(const FacePatch& patch, const Vec2& x) {
  const Vec3 on_plane = patch.origin + x.x() * patch.u + x.y() * patch.v;
  const auto height = [&](const Plane& plane) {
    return (plane.offset - plane.normal.dot(on_plane)) / plane.normal.dot(patch.normal);
  };
  const double height_a = height(patch.plane_a);
  const double height_b = height(patch.plane_b);
  return {on_plane + height_a * patch.normal, on_plane + height_b * patch.normal, height_b - height_a};
}

CornerNormal corner_normal(const CollisionModel& model, const FacePatch& patch,
                           const Eigen::Isometry3d& pose_ab, const ClipCorner& corner, double max_angle) {
  const auto corners_a = model.face_corners(model.faces[patch.face_a]);
  const auto corners_b = model.face_corners(model.faces[patch.face_b]);
  const int num_a = static_cast<int>(corners_a.size());
  const bool in_of_a = corner.edge_in < num_a;
  const bool out_of_a = corner.edge_out < num_a;
  if (in_of_a && out_of_a) return {-patch.plane_b.normal, 0.0};
  if (!in_of_a && !out_of_a) return {patch.plane_a.normal, 1.0};

  const int edge_a = in_of_a ? corner.edge_in : corner.edge_out;
  const int reversed_b = (in_of_a ? corner.edge_out : corner.edge_in) - num_a;
  const int num_b = static_cast<int>(corners_b.size());
  const Vec3 direction_a = edge_of(corners_a, edge_a);
  const Vec3 direction_b = pose_ab.linear() * edge_of(corners_b, (2 * num_b - 2 - reversed_b) % num_b);
  Vec3 normal = direction_a.cross(direction_b);
  if (normal.dot(patch.normal) < 0.0) normal = -normal;
  // Nearly parallel edges have no common normal worth the name.
  if (normal.dot(patch.normal) <= std::cos(max_angle) * direction_a.norm() * direction_b.norm() * 0.05)
    return {patch.normal, 0.5};
  normal.normalize();
  if (normal.dot(patch.normal) < std::cos(max_angle)) return {patch.normal, 0.5};
  return {normal, 0.5};
}

}  // namespace cupola
