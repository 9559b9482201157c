#include "solver/collision/face_clipping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assembly/base/error.hpp"
#include "assembly/model/joint_rule.hpp"
#include "solver/collision/separating_axis.hpp"

namespace cupola {
namespace {

/// Face b in the axes of block a.
struct MovedFace {
  Vec3 normal, centroid;
};

/// Cheap necessary conditions of a face contact: the gap can be within the margin, the depth can be below the
/// width, and face b can reach farther than `width` (m) inside every edge of face a.
bool may_touch(const CollisionModel& model, const CollisionFace& a, const CollisionFace& b,
               const MovedFace& moved_b, const Eigen::Isometry3d& pose_ab, const Vec3& normal,
               const NarrowPhaseOptions& options, double width) {
  const Vec3 offset = moved_b.centroid - a.centroid;
  const double gap = normal.dot(offset);
  const double tilt = (a.normal + moved_b.normal).norm();
  const double tilt_reach = (a.radius + b.radius) * tilt;
  if (gap - tilt_reach > options.margin) return false;
  if (gap + tilt_reach < -2.0 * std::min(a.radius, b.radius)) return false;
  if ((offset - gap * normal).norm() > a.radius + b.radius) return false;

  const double slant = (std::abs(gap) + tilt_reach) * tilt;  // error of projecting along a's normal
  const auto corners_a = model.face_corners(a);
  const auto corners_b = model.face_corners(b);
  for (std::size_t i = 0; i < corners_a.size(); ++i) {
    const Vec3 edge = corners_a[(i + 1) % corners_a.size()] - corners_a[i];
    const Vec3 inward = a.normal.cross(edge);
    const Vec3 inward_b = pose_ab.linear().transpose() * inward;
    const double origin = inward.dot(corners_a[i] - pose_ab.translation());
    double height = -std::numeric_limits<double>::infinity();
    for (const Vec3& x : corners_b) height = std::max(height, inward_b.dot(x) - origin);
    if (height < (width - slant) * edge.norm()) return false;
  }
  return true;
}

std::vector<Vec2> project(const std::vector<Vec3>& corners, const JointPatch& patch) {
  std::vector<Vec2> projected;
  projected.reserve(corners.size());
  for (const Vec3& x : corners) projected.push_back(patch.project(x));
  return projected;
}

Vec3 edge_of(const std::vector<Vec3>& corners, int i) {
  return corners[(i + 1) % corners.size()] - corners[i];
}

/// Normal at a corner of the overlap. Edge labels 0 .. n-1 belong to face a.
CornerNormal corner_normal(const std::vector<Vec3>& corners_a, const std::vector<Vec3>& corners_b,
                           const JointPatch& patch, const ClipCorner& corner, double max_angle) {
  const int num_a = static_cast<int>(corners_a.size());
  const bool in_of_a = corner.edge_in < num_a;
  const bool out_of_a = corner.edge_out < num_a;
  if (in_of_a && out_of_a) return {-patch.plane_b.normal, 0.0};
  if (!in_of_a && !out_of_a) return {patch.plane_a.normal, 1.0};
  const Vec3 direction_a = edge_of(corners_a, in_of_a ? corner.edge_in : corner.edge_out).normalized();
  const Vec3 direction_b =
      edge_of(corners_b, (in_of_a ? corner.edge_out : corner.edge_in) - num_a).normalized();
  Vec3 normal = direction_a.cross(direction_b);
  if (normal.norm() < 0.05) return {patch.normal, 0.5};  // nearly parallel edges have no common normal
  normal.normalize();
  if (normal.dot(patch.normal) < 0.0) normal = -normal;
  if (normal.dot(patch.normal) < std::cos(max_angle)) return {patch.normal, 0.5};
  return {normal, 0.5};
}

bool same_planes(const JointPatch& p, const JointPatch& q) {
  constexpr double kCosine = 1.0 - 1e-9;  // 4.5e-5 rad
  return p.plane_a.normal.dot(q.plane_a.normal) > kCosine && p.plane_b.normal.dot(q.plane_b.normal) > kCosine;
}

/// Distance of the parts at the deepest corner of a patch, along the normals of its faces, m; negative inside.
double distance_of(const JointPatch& patch) {
  return patch.min_gap * patch.normal.dot(patch.plane_a.normal);
}

/// True if no face normal separates the parts better than the patch does. Two thin parts also have opposed
/// faces behind those that touch; their planes have passed each other even when the parts are apart.
///
/// The faces of the true contact pass: along the normal of either face, the depth of the parts is at most
/// that of the patch at its deepest corner. Face normals are sufficient, because where an edge pair separates
/// the parts, faces within max_angle do as well.
bool has_least_depth(const CollisionModel& model, const JointPatch& patch, const Eigen::Isometry3d& pose_ab,
                     const NarrowPhaseOptions& options) {
  if (patch.min_gap >= -options.tolerance) return true;  // the parts touch without overlap
  const TwoParts parts = place_parts(model, patch.part_a, patch.part_b, pose_ab);
  return distance_of(patch) >= best_face_axis(parts, options.margin).gap - options.tolerance;
}

}  // namespace

JointPatch clip_faces(const CollisionModel& model, const CollisionFace& face_a, const CollisionFace& face_b,
                      const Eigen::Isometry3d& pose_ab, const Vec3& normal,
                      const NarrowPhaseOptions& options) {
  CUPOLA_ASSERT(std::abs(normal.squaredNorm() - 1.0) < 1e-9);
  JointPatch patch;
  patch.face_a = face_a.id;
  patch.face_b = face_b.id;
  patch.origin = face_a.centroid;
  patch.set_normal(normal);
  const Vec3 normal_b = pose_ab.linear() * face_b.normal;
  patch.plane_a = {face_a.normal, face_a.normal.dot(face_a.centroid)};
  patch.plane_b = {normal_b, normal_b.dot(pose_ab * face_b.centroid)};

  const auto span_a = model.face_corners(face_a);
  const std::vector<Vec3> corners_a(span_a.begin(), span_a.end());
  std::vector<Vec3> corners_b;
  for (const Vec3& x : model.face_corners(face_b)) corners_b.push_back(pose_ab * x);
  std::reverse(corners_b.begin(), corners_b.end());  // counter-clockwise about the normal, like corners_a
  patch.min_gap = std::numeric_limits<double>::infinity();
  for (const ClipCorner& corner : clip_convex_polygon(project(corners_a, patch), project(corners_b, patch),
                                                      options.tolerance, options.min_width)) {
    patch.corners.push_back(
        {corner.position, corner_normal(corners_a, corners_b, patch, corner, options.max_angle)});
    patch.min_gap = std::min(patch.min_gap, lift_to_faces(patch, corner.position).gap);
  }
  return patch;
}

bool separated_by_face(const CollisionModel& model, int part_a, int part_b, const Eigen::Isometry3d& pose_ab,
                       double margin) {
  const CollisionPart& a = model.parts[part_a];
  const CollisionPart& b = model.parts[part_b];
  for (const CollisionFace& face : model.faces_of(a)) {
    const Vec3 normal = pose_ab.linear().transpose() * face.normal;  // axes of b
    const double level = face.normal.dot(face.centroid - pose_ab.translation());
    double nearest = std::numeric_limits<double>::infinity();
    for (int v = b.vertex_start; v < b.vertex_start + b.num_vertices; ++v)
      nearest = std::min(nearest, normal.dot(model.vertices[v]) - level);
    if (nearest > margin) return true;
  }
  return false;
}

std::vector<JointPatch> clip_opposed_faces(const CollisionModel& model, int part_a, int part_b,
                                           const Eigen::Isometry3d& pose_ab,
                                           const NarrowPhaseOptions& options,
                                           std::vector<JointPatch>* narrow) {
  NarrowPhaseOptions any_width = options;
  if (narrow) any_width.min_width *= kNoWidth;
  const CollisionPart& shape_a = model.parts[part_a];
  const CollisionPart& shape_b = model.parts[part_b];
  std::vector<MovedFace> moved_faces;
  for (const CollisionFace& b : model.faces_of(shape_b))
    moved_faces.push_back({pose_ab.linear() * b.normal, pose_ab * b.centroid});

  std::vector<JointPatch> patches;
  const double opposed = -std::cos(options.max_angle);
  for (const CollisionFace& a : model.faces_of(shape_a)) {
    if (a.kind == FaceKind::internal) continue;
    for (int i = 0; i < shape_b.num_faces; ++i) {
      const CollisionFace& b = model.faces[shape_b.face_start + i];
      const MovedFace& moved_b = moved_faces[i];
      if (b.kind == FaceKind::internal || a.normal.dot(moved_b.normal) > opposed) continue;
      const Vec3 normal = (a.normal - moved_b.normal).normalized();
      if (!may_touch(model, a, b, moved_b, pose_ab, normal, options, any_width.min_width)) continue;
      for (const CollisionFace& of_a : model.open_pieces(a))
        for (const CollisionFace& of_b : model.open_pieces(b)) {
          JointPatch patch = clip_faces(model, of_a, of_b, pose_ab, normal, options);
          double width = polygon_width(patch.outline());
          if (narrow && width < options.min_width) {
            patch = clip_faces(model, of_a, of_b, pose_ab, normal, any_width);
            width = polygon_width(patch.outline());
          }
          if (patch.min_gap > options.margin || width < any_width.min_width || -patch.min_gap > width)
            continue;
          patch.part_a = part_a;
          patch.part_b = part_b;
          classify(shape_a, a.kind, shape_b, b.kind, &patch);
          (width < options.min_width ? *narrow : patches).push_back(std::move(patch));
        }
    }
  }
  if (patches.empty()) return patches;
  if (!has_least_depth(model, *std::ranges::max_element(patches, {}, distance_of), pose_ab, options))
    return {};
  // Faces that meet in an edge of the joint are at the same distance, up to the precision of the drawing.
  const auto value = [&](const JointPatch& p) {
    return distance_of(p) - options.min_width * (p.plane_a.normal + p.plane_b.normal).norm();
  };
  const JointPatch best = *std::ranges::max_element(patches, {}, value);
  std::erase_if(patches, [&](const JointPatch& p) { return !same_planes(p, best); });
  return patches;
}

}  // namespace cupola
