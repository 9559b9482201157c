#include "solver/collision/joint_patch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

constexpr double kSameNormal = 1.0 - 1e-9;  // cosine: 4.5e-5 rad

bool lies_on(const Plane& plane, const Vec3& x, double tolerance) {
  return std::abs(plane.normal.dot(x) - plane.offset) <= tolerance;
}

double perimeter(const std::vector<Vec2>& polygon) {
  double length = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    length += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  return length;
}

/// True if both are of one joint, and of one course: but a support belongs to no course, so that a stone of
/// several courses touches it in one joint.
bool same_joint(const JointPatch& p, const JointPatch& q) {
  return p.kind == q.kind && (p.ring == q.ring || p.kind == JointKind::base);
}

/// The union of p and q in the plane of p, if it is convex.
std::optional<JointPatch> convex_union(const JointPatch& p, const JointPatch& q, double tolerance) {
  std::vector<PatchCorner> corners = p.corners;
  for (const PatchCorner& corner : q.corners)
    corners.push_back({p.project(lift_to_faces(q, corner.position).on_a), corner.normal});
  std::vector<Vec2> points;
  for (const PatchCorner& corner : corners) points.push_back(corner.position);

  JointPatch joined = p;
  joined.corners.clear();
  for (int i : convex_hull(points, tolerance)) joined.corners.push_back(corners[i]);
  joined.min_gap = std::min(p.min_gap, q.min_gap);
  // Pieces with a common edge fill their hull up to the tolerance along the border.
  const double missing =
      polygon_area(joined.outline()) - polygon_area(p.outline()) - polygon_area(q.outline());
  if (missing > 4.0 * tolerance * perimeter(joined.outline())) return std::nullopt;
  return joined;
}

/// The union of two edge contacts in one line that meet or overlap.
std::optional<JointPatch> collinear_union(const JointPatch& p, const JointPatch& q, double tolerance) {
  if (p.touching.size() != 2 || q.touching.size() != 2 || !same_joint(p, q) ||
      p.normal.dot(q.normal) < kSameNormal)
    return std::nullopt;
  const Vec3 start = p.touching[0].on_a, line = p.touching[1].on_a - start;
  const double length = line.norm();
  const auto along = [&](const LiftedPoint& x) { return line.dot(x.on_a - start) / length; };
  const auto off_line = [&](const LiftedPoint& x) {
    return (x.on_a - start - along(x) / length * line).norm() > tolerance;
  };
  const auto [low, high] = std::minmax({along(q.touching[0]), along(q.touching[1])});
  if (low > length + tolerance || high < -tolerance || std::ranges::any_of(q.touching, off_line))
    return std::nullopt;
  JointPatch joined = p;
  std::array<double, 2> ends{0.0, length};
  for (std::size_t i = 0; i < 2; ++i) {
    const double s = along(q.touching[i]);
    if (s >= ends[0] && s <= ends[1]) continue;
    const std::size_t end = s < ends[0] ? 0 : 1;
    ends[end] = s;
    joined.touching[end] = q.touching[i];
    joined.corners[end] = {p.project(q.touching[i].on_a), q.corners[i].normal};
  }
  joined.min_gap = std::min(p.min_gap, q.min_gap);
  return joined;
}

}  // namespace

bool coplanar(const JointPatch& p, const JointPatch& q, double tolerance) {
  if (!p.has_area() || !q.has_area() || !same_joint(p, q)) return false;
  if (p.normal.dot(q.normal) < 0.5) return false;
  return std::all_of(q.corners.begin(), q.corners.end(), [&](const PatchCorner& corner) {
    const LiftedPoint x = lift_to_faces(q, corner.position);
    return lies_on(p.plane_a, x.on_a, tolerance) && lies_on(p.plane_b, x.on_b, tolerance);
  });
}

void JointPatch::set_normal(const Vec3& unit_normal) {
  CUPOLA_ASSERT(std::abs(unit_normal.squaredNorm() - 1.0) < 1e-9);
  normal = unit_normal;
  int smallest = 0;
  normal.cwiseAbs().minCoeff(&smallest);
  u = normal.cross(Vec3::Unit(smallest)).normalized();
  v = normal.cross(u);
}

std::vector<Vec2> JointPatch::outline() const {
  std::vector<Vec2> positions;
  positions.reserve(corners.size());
  for (const PatchCorner& corner : corners) positions.push_back(corner.position);
  return positions;
}

LiftedPoint lift_to_faces(const JointPatch& patch, const Vec2& x) {
  const Vec3 on_plane = patch.origin + x.x() * patch.u + x.y() * patch.v;
  const auto height = [&](const Plane& plane) {
    return (plane.offset - plane.normal.dot(on_plane)) / plane.normal.dot(patch.normal);
  };
  const double height_a = height(patch.plane_a);
  const double height_b = height(patch.plane_b);
  return {on_plane + height_a * patch.normal, on_plane + height_b * patch.normal, height_b - height_a};
}

bool is_bed(FaceKind kind) {
  return kind == FaceKind::bed || kind == FaceKind::top;
}

void classify(const CollisionPart& part_a, FaceKind face_a, const CollisionPart& part_b, FaceKind face_b,
              JointPatch* patch) {
  patch->ring = std::max(part_a.ring, part_b.ring);
  if (part_a.fixed || part_b.fixed) {
    patch->kind = JointKind::base;
  } else if (is_bed(face_a) && is_bed(face_b)) {
    patch->kind = JointKind::bed;
  } else if (face_a == FaceKind::head && face_b == FaceKind::head) {
    patch->kind = JointKind::head;
  } else if (face_a == FaceKind::wythe && face_b == FaceKind::wythe) {
    patch->kind = JointKind::wythe;
  } else {
    patch->kind = JointKind::other;
  }
}

void merge_coplanar(std::vector<JointPatch>* patches, double tolerance) {
  for (std::size_t i = 0; i < patches->size(); ++i) {
    for (std::size_t k = i + 1; k < patches->size();) {
      const JointPatch& p = (*patches)[i];
      const JointPatch& q = (*patches)[k];
      const std::optional<JointPatch> joined =
          coplanar(p, q, tolerance) ? convex_union(p, q, tolerance) : collinear_union(p, q, tolerance);
      if (!joined) {
        ++k;
        continue;
      }
      (*patches)[i] = *joined;
      patches->erase(patches->begin() + static_cast<std::ptrdiff_t>(k));
      k = i + 1;  // patches rejected before may fit the larger patch
    }
  }
}

}  // namespace cupola
