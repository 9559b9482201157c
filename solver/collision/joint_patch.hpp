#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "solver/collision/collision_model.hpp"
#include "solver/collision/convex_polygon.hpp"

namespace cupola {

/// Tolerances of the narrow phase. Lengths in m.
struct NarrowPhaseOptions {
  double margin = 0.0;      ///< widest gap that still makes a contact
  double min_width = 0.0;   ///< narrower overlaps are slivers and make no contact
  double tolerance = 0.0;   ///< corners nearer to each other than this are one
  double max_angle = 0.35;  ///< rad, largest tilt between two faces in contact
};

/// The contact normal at a corner, unit, from a to b, axes of block a: where a vertex meets a face that of
/// the face, where two edges cross their common normal.
struct CornerNormal {
  Vec3 normal = Vec3::UnitZ();
  double weight_a = 0.5;  ///< 1: turns with block a, 0: with block b, 1/2: with both
};

struct PatchCorner {
  Vec2 position = Vec2::Zero();  ///< m, in the plane of the patch
  CornerNormal normal;
};

/// A point of a patch on either face. Coordinates in m, axes of block a.
struct LiftedPoint {
  Vec3 on_a = Vec3::Zero(), on_b = Vec3::Zero();
  double gap = 0.0;  ///< along the patch's normal
};

/// Where two parts of two blocks touch: the overlap of two opposed faces, projected on the plane between
/// them; or, where an edge or a vertex touches, the points alone. Coordinates in m, axes of block a.
struct JointPatch {
  int part_a = 0, part_b = 0;
  int face_a = -1, face_b = -1;  ///< faces of the assembly, -1 for an edge or a vertex
  JointKind kind = JointKind::other;
  int ring = 0;                 ///< course of the upper part, 0 at the base
  Vec3 origin = Vec3::Zero();   ///< of the plane's coordinates
  Vec3 normal = Vec3::UnitZ();  ///< unit, from a to b; u x v
  Vec3 u = Vec3::UnitX(), v = Vec3::UnitY();
  Plane plane_a, plane_b;             ///< of the two faces, outward
  std::vector<PatchCorner> corners;   ///< counter-clockwise about the normal
  double min_gap = 0.0;               ///< smallest gap over the corners, negative when they overlap
  std::vector<LiftedPoint> touching;  ///< of an edge or a vertex: the points at the corners, on both parts

  void set_normal(const Vec3& unit_normal);  ///< and a frame (u, v) about it
  Vec2 project(const Vec3& x) const { return {u.dot(x - origin), v.dot(x - origin)}; }
  std::vector<Vec2> outline() const;
  double point_area = 0.0;  ///< m2 that each of them stands for, 0 where nothing is known
  bool has_area() const { return touching.empty(); }
};

/// The points of both faces over the position x (m) in the plane of the patch.
LiftedPoint lift_to_faces(const JointPatch& patch, const Vec2& x);

/// Kind (`base` when a block is fixed, else by the faces' kinds) and ring of a patch between two parts.
void classify(const CollisionPart& part_a, FaceKind face_a, const CollisionPart& part_b, FaceKind face_b,
              JointPatch* patch);

/// Joins patches of one block pair, kind and ring that lie in one plane and whose union is convex, so that
/// cutting a block into slices does not change its joints. A joined patch has the name of its first piece.
void merge_coplanar(std::vector<JointPatch>* patches, double tolerance);

}  // namespace cupola
