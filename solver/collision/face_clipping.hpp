#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "solver/collision/collision_model.hpp"
#include "solver/collision/patch_quadrature.hpp"

namespace cupola {

/// Tolerances of face clipping. Lengths in m.
struct ClippingOptions {
  double margin = 0.0;      ///< widest gap that still makes a contact
  double min_width = 0.0;   ///< narrower overlaps are slivers and make no contact
  double tolerance = 0.0;   ///< corners nearer to each other than this are one
  double max_angle = 0.35;  ///< rad, largest tilt between two faces in contact
};

/// Overlap of two opposed faces, projected on the plane between them. Coordinates in m, axes of block a.
struct FacePatch {
  int face_a = 0, face_b = 0;   ///< faces of the collision model
  Vec3 origin = Vec3::Zero();   ///< of the plane's coordinates
  Vec3 normal = Vec3::UnitZ();  ///< unit, from a to b, halfway between the faces' normals; u x v
  Vec3 u = Vec3::UnitX(), v = Vec3::UnitY();
  Plane plane_a, plane_b;           ///< outward
  std::vector<ClipCorner> corners;  ///< counter-clockwise about the normal; edges of face a come first
  double min_gap = 0.0;             ///< smallest gap over the corners, negative when they overlap
};

/// A point of a patch on either face. Coordinates in m, axes of block a.
struct FacePatchPoint {
  Vec3 on_a = Vec3::Zero(), on_b = Vec3::Zero();
  double gap = 0.0;  ///< along the patch's normal
};

/// The face contact of two convex parts: pairs of opposed faces within max_angle whose gap is within the
/// margin and whose overlap is wider than min_width and than it is deep. Convex bodies touch along one
/// plane: of several directions the one with the largest gap is kept, as in the separating axis test, with
/// all face pairs coplanar to it. `pose_ab` takes coordinates in the axes of block b to those of block a.
std::vector<FacePatch> clip_opposed_faces(const CollisionModel& model, const CollisionPart& part_a,
                                          const CollisionPart& part_b, const Eigen::Isometry3d& pose_ab,
                                          const ClippingOptions& options);

/// The points of both faces over the position x (m) in the plane of the patch.
FacePatchPoint lift_to_faces(const FacePatch& patch, const Vec2& x);

/// Which block's face the contact normal at a corner belongs to, and that normal (unit, from a to b, axes of
/// block a): where a vertex meets a face, the face's; where two edges cross, their common normal.
struct CornerNormal {
  Vec3 normal = Vec3::UnitZ();
  double weight_a = 0.5;  ///< 1: turns with block a, 0: with block b, 1/2: with both
};
CornerNormal corner_normal(const CollisionModel& model, const FacePatch& patch,
                           const Eigen::Isometry3d& pose_ab, const ClipCorner& corner, double max_angle);

}  // namespace cupola
