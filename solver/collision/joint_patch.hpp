#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "solver/collision/collision_model.hpp"
#include "solver/collision/convex_polygon.hpp"

namespace cupola {

/// Tolerances of the narrow phase. Lengths in m.
struct NarrowPhaseOptions {
  double margin = 0.0;      ///< largest gap that still makes a contact
  double min_width = 0.0;   ///< narrower overlaps are slivers and make no contact
  double tolerance = 0.0;   ///< corners nearer to each other than this are merged
  double max_angle = 0.35;  ///< rad, largest tilt between two faces in contact
};

/// Contact normal at a corner, unit, from a to b, in the axes of block a. Where a vertex meets a face it is
/// the normal of the face; where two edges cross it is their common normal.
struct CornerNormal {
  Vec3 normal = Vec3::UnitZ();
  double weight_a = 0.5;  ///< 1: turns with block a, 0: with block b, 1/2: with both
};

struct PatchCorner {
  Vec2 position = Vec2::Zero();  ///< m, in the plane of the patch
  CornerNormal normal;
};

/// A point of a patch projected onto both faces. Coordinates in m, axes of block a.
struct LiftedPoint {
  Vec3 on_a = Vec3::Zero(), on_b = Vec3::Zero();
  double gap = 0.0;  ///< m, along the normal of the patch
};

/// Contact region of two parts of two blocks: the overlap of two opposed faces, projected on the plane midway
/// between them, or the contact points of an edge or a vertex. Coordinates in m, axes of block a.
struct JointPatch {
  int part_a = 0, part_b = 0;
  int face_a = -1, face_b = -1;  ///< CollisionFace::id; -1 for an edge or a vertex
  JointKind kind = JointKind::other;
  int ring = 0;                 ///< course of the upper part; supports are below all courses
  Vec3 origin = Vec3::Zero();   ///< of the coordinates in the plane
  Vec3 normal = Vec3::UnitZ();  ///< unit, from a to b; equals u x v
  Vec3 u = Vec3::UnitX(), v = Vec3::UnitY();
  Plane plane_a, plane_b;             ///< of the two faces, outward
  std::vector<PatchCorner> corners;   ///< counter-clockwise about the normal
  double min_gap = 0.0;               ///< smallest gap at the corners, negative when they overlap
  std::vector<LiftedPoint> touching;  ///< edge or vertex contact: the points at the corners, on both parts
  double point_area = 0.0;            ///< m2, tributary area of each point of `touching`; 0: unknown

  void set_normal(const Vec3& unit_normal);  ///< also sets u and v
  Vec2 project(const Vec3& x) const { return {u.dot(x - origin), v.dot(x - origin)}; }
  std::vector<Vec2> outline() const;
  bool has_area() const { return touching.empty(); }
};

/// Points of both faces above and below the position x (m) in the plane of the patch.
LiftedPoint lift_to_faces(const JointPatch& patch, const Vec2& x);

/// Beds, also those of the last course.
bool is_bed(FaceKind kind);

/// Sets kind (`base` when a block is fixed, otherwise from the kinds of the faces) and ring of a patch.
void classify(const CollisionPart& part_a, FaceKind face_a, const CollisionPart& part_b, FaceKind face_b,
              JointPatch* patch);

/// True if q, of the same blocks, kind and (but on supports) ring as p, lies within `tolerance` (m) of the
/// planes of p.
bool coplanar(const JointPatch& p, const JointPatch& q, double tolerance);

/// Merges patches of one block pair that have the same kind and (but on supports) ring, lie in one plane and
/// have a convex union, and edge contacts that meet in one line. Cutting a block into slices therefore does
/// not change its joints. A merged patch takes the identity of its first piece.
void merge_coplanar(std::vector<JointPatch>* patches, double tolerance);

}  // namespace cupola
