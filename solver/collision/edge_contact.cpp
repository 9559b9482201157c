#include "solver/collision/edge_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/collision/face_clipping.hpp"
#include "solver/collision/separating_axis.hpp"

namespace cupola {
namespace {

/// A face in the axes of block a.
struct PlacedFace {
  Plane plane;  // outward
  std::vector<Vec3> corners;
};

PlacedFace placed(const TwoParts& parts, const CollisionFace& face, bool of_a) {
  const Eigen::Isometry3d pose = of_a ? Eigen::Isometry3d::Identity() : parts.pose_ab;
  PlacedFace in_a;
  in_a.plane.normal = pose.linear() * face.normal;
  in_a.plane.offset = in_a.plane.normal.dot(pose * face.centroid);
  for (const Vec3& x : parts.model.face_corners(face)) in_a.corners.push_back(pose * x);
  return in_a;
}

double height(const Plane& plane, const Vec3& x) {
  return plane.normal.dot(x) - plane.offset;
}

/// The plane through an edge of a face and normal to the face, outward.
Plane edge_plane(const PlacedFace& face, std::size_t edge) {
  const Vec3& start = face.corners[edge];
  const Vec3& end = face.corners[(edge + 1) % face.corners.size()];
  const Vec3 outward = (end - start).cross(face.plane.normal).normalized();
  return {outward, outward.dot(start)};
}

bool contains(const PlacedFace& face, const Vec3& x, double tolerance) {
  if (std::abs(height(face.plane, x)) > tolerance) return false;
  for (std::size_t i = 0; i < face.corners.size(); ++i)
    if (height(edge_plane(face, i), x) > tolerance) return false;
  return true;
}

/// True if the surface of a block goes on at x, beyond an edge of `face`, in the plane of the face or in
/// front of it, and the other part lies in the angle between both.
bool goes_on(const TwoParts& parts, bool of_a, const PlacedFace& face, const Plane& edge, const Vec3& x,
             const NarrowPhaseOptions& options) {
  const CollisionModel& model = parts.model;
  const int block = (of_a ? parts.a : parts.b).block;
  for (int p = model.part_start[block]; p < model.part_start[block + 1]; ++p)
    for (const CollisionFace& whole : model.faces_of(model.parts[p])) {
      if (whole.kind == FaceKind::internal) continue;
      for (const CollisionFace& piece : model.open_pieces(whole)) {
        const PlacedFace next = placed(parts, piece, of_a);
        if (!contains(next, x, options.min_width)) continue;
        const auto falls = [&](const Vec3& y) { return height(face.plane, y) < -options.min_width; };
        const auto extends = [&](const Vec3& y) {
          return std::max(height(face.plane, y), height(edge, y)) > options.min_width;
        };
        const auto behind = [&](const Vec3& y) { return height(next.plane, y) < -options.margin; };
        if (std::ranges::any_of(next.corners, extends) && std::ranges::none_of(next.corners, falls) &&
            std::ranges::none_of(of_a ? parts.vertices_b : parts.vertices_a, behind))
          return true;
      }
    }
  return false;
}

const CollisionFace& face_of(const SeparatingAxis& axis) {
  return axis.face_a ? *axis.face_a : *axis.face_b;
}

/// The faces of the other part than that of the axis that are turned towards it, by cosines of less than
/// `facing`.
std::vector<const CollisionFace*> faces_turned_to(const TwoParts& parts, const SeparatingAxis& axis,
                                                  double facing) {
  std::vector<const CollisionFace*> faces;
  for (const CollisionFace& face : parts.model.faces_of(axis.face_a ? parts.b : parts.a)) {
    const double cosine =
        axis.face_a ? axis.normal.dot(parts.pose_ab.linear() * face.normal) : -axis.normal.dot(face.normal);
    if (face.kind != FaceKind::internal && cosine < facing) faces.push_back(&face);
  }
  return faces;
}

/// True if all points lie within min_width of one edge of the face of the axis, at which the surface of its
/// block ends or turns away. Such parts meet along their borders, like the blocks on both sides of a mitre,
/// and transfer no force there. How a block is split into parts makes no border.
bool along_border(const TwoParts& parts, const SeparatingAxis& axis, const JointPatch& points,
                  const NarrowPhaseOptions& options) {
  const bool of_a = axis.face_a != nullptr;
  for (const CollisionFace& piece : parts.model.open_pieces(face_of(axis))) {
    const PlacedFace face = placed(parts, piece, of_a);
    for (std::size_t i = 0; i < face.corners.size(); ++i) {
      const Plane edge = edge_plane(face, i);
      const auto on_face = [&](const LiftedPoint& x) { return of_a ? x.on_a : x.on_b; };
      const auto near = [&](const LiftedPoint& x) {
        return std::abs(height(edge, on_face(x))) < options.min_width;
      };
      const auto beyond = [&](const LiftedPoint& x) {
        return goes_on(parts, of_a, face, edge, on_face(x), options);
      };
      if (std::ranges::all_of(points.touching, near) && !std::ranges::all_of(points.touching, beyond))
        return true;
    }
  }
  return false;
}

/// True if block a, or b, lies on both sides of the plane of a contact at its points. The part that touches
/// ends there, but not the block: another part goes on, as under a stone that slides over both.
bool extends_behind(const TwoParts& parts, bool of_a, const JointPatch& contact,
                    const NarrowPhaseOptions& options) {
  const CollisionModel& model = parts.model;
  const Eigen::Isometry3d to_local = of_a ? Eigen::Isometry3d::Identity() : parts.pose_ab.inverse();
  const Vec3 outward = to_local.linear() * (of_a ? contact.normal : Vec3(-contact.normal));
  const double reach = std::max(options.margin, -contact.min_gap) + options.min_width;
  const int block = (of_a ? parts.a : parts.b).block;
  for (int p = model.part_start[block]; p < model.part_start[block + 1]; ++p)
    for (const LiftedPoint& lifted : contact.touching) {
      const Vec3 x = to_local * (of_a ? lifted.on_a : lifted.on_b);
      const bool at_part = std::ranges::all_of(
          model.faces_of(model.parts[p]),
          [&](const CollisionFace& face) { return face.normal.dot(x - face.centroid) <= reach; });
      const auto behind = [&](const Vec3& y) { return outward.dot(y - x) > reach; };
      if (at_part && std::ranges::any_of(model.vertices_of(model.parts[p]), behind)) return true;
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
  const auto add_corners = [&](const CollisionFace& piece_a, const CollisionFace& piece_b) {
    const JointPatch clipped = clip_faces(parts.model, piece_a, piece_b, parts.pose_ab, axis.normal, options);
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
  for (const CollisionFace* face : faces_turned_to(parts, axis, kFacing))
    for (const CollisionFace& piece_a : parts.model.open_pieces(axis.face_a ? *axis.face_a : *face))
      for (const CollisionFace& piece_b : parts.model.open_pieces(axis.face_a ? *face : *axis.face_b))
        add_corners(piece_a, piece_b);
  if (along_border(parts, axis, points, options) || extends_behind(parts, !axis.face_a, points, options))
    points.corners.clear();
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

/// The kind of the faces of both parts on which all points of a contact lie: of several that of the face of
/// its axis, then a bed. Such a contact is part of the joint that these faces have, or would have if
/// they were not turned against each other.
FaceKind common_kind(const TwoParts& parts, FaceKind of_axis, const JointPatch& contact,
                     const NarrowPhaseOptions& options) {
  const auto lies_on = [&](FaceKind kind, bool of_a) {
    return std::ranges::any_of(parts.model.faces_of(of_a ? parts.a : parts.b), [&](const CollisionFace& f) {
      if (f.kind != kind && !(is_bed(f.kind) && is_bed(kind))) return false;
      const PlacedFace face = placed(parts, f, of_a);
      return std::ranges::all_of(contact.touching, [&](const LiftedPoint& x) {
        return contains(face, of_a ? x.on_a : x.on_b, options.min_width);
      });
    });
  };
  for (const FaceKind kind : {of_axis, FaceKind::bed, FaceKind::head, FaceKind::wythe})
    if (lies_on(kind, true) && lies_on(kind, false)) return kind;
  return FaceKind::free;
}

}  // namespace

std::optional<JointPatch> find_edge_contact(const CollisionModel& model, int part_a, int part_b,
                                            const Eigen::Isometry3d& pose_ab,
                                            const NarrowPhaseOptions& options) {
  const TwoParts parts = place_parts(model, part_a, part_b, pose_ab);
  const double face_gap = best_face_axis(parts, options.margin).gap;
  if (face_gap > options.margin) return std::nullopt;
  // Where parts meet in an edge, several faces separate them equally well; which one is the best is rounding.
  std::vector<SeparatingAxis> axes = face_axes_above(parts, face_gap - options.min_width);
  std::erase_if(axes, [](const SeparatingAxis& axis) { return face_of(axis).kind == FaceKind::internal; });
  const double opposed_cosine = -std::cos(options.max_angle);
  const bool opposed = std::ranges::any_of(axes, [&](const SeparatingAxis& axis) {
    return !faces_turned_to(parts, axis, opposed_cosine).empty();
  });
  if (opposed && face_gap > -options.margin) return std::nullopt;  // skips the edges of most neighbours
  const SeparatingAxis edge_axis = best_edge_axis(parts, options);
  if (edge_axis.gap > options.margin) return std::nullopt;

  JointPatch contact;
  FaceKind kind = FaceKind::bed;
  for (const SeparatingAxis& axis : axes) {
    // If an edge crosses the border of a face, the crossing is one corner of the face contact; the edge
    // contact alone would lose the other corner. Therefore the edge axis is used only if its normal differs.
    const bool same_normal = edge_axis.normal.dot(axis.normal) > -opposed_cosine;
    if (opposed || (!same_normal && axis.gap < edge_axis.gap)) continue;
    contact = points_on_face(parts, axis, options);
    kind = face_of(axis).kind;
    if (!contact.corners.empty()) break;
  }
  if (contact.corners.empty()) {
    if (face_gap >= edge_axis.gap) return std::nullopt;
    contact = crossing_edges(edge_axis);
    for (const bool of_a : {true, false})
      if (extends_behind(parts, of_a, contact, options)) return std::nullopt;
    kind = FaceKind::bed;
  }
  contact.part_a = part_a;
  contact.part_b = part_b;
  kind = common_kind(parts, kind, contact, options);
  classify(parts.a, kind, parts.b, kind, &contact);
  return contact;
}

void drop_held_edges(const NarrowPhaseOptions& options, std::vector<JointPatch>* patches) {
  std::vector<JointPatch> kept;
  for (const JointPatch& edge : *patches) {
    const bool held = !edge.has_area() && std::ranges::any_of(*patches, [&](const JointPatch& patch) {
      if (!patch.has_area() || patch.normal.dot(edge.normal) < std::cos(options.max_angle)) return false;
      PlacedFace face{patch.plane_a, {}};
      for (const Vec2& x : patch.outline()) face.corners.push_back(lift_to_faces(patch, x).on_a);
      return std::ranges::all_of(
          edge.touching, [&](const LiftedPoint& x) { return contains(face, x.on_a, options.min_width); });
    });
    if (!held) kept.push_back(edge);
  }
  *patches = std::move(kept);
}

}  // namespace cupola
