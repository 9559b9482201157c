#include "generators/stereotomy/part_supports.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "generators/stereotomy/convex_clip.hpp"
#include "generators/stereotomy/separation.hpp"

namespace cupola {
namespace {

using Parts = std::span<const ConvexShape>;  // all of a support, or one

/// A fixed block.
struct Support {
  int block = 0;
  size_t storey = 0;
  std::vector<ConvexShape> parts;
  Eigen::AlignedBox3d box;
  std::vector<std::vector<Vec3>> bed;  // m, faces of the stones on it
  std::vector<Plane> limits;           // m, up to which it stays
};

bool is_on(Parts parts, const Vec3& corner, double near) {
  return std::ranges::any_of(parts, [&](const ConvexShape& part) {
    return std::ranges::all_of(part.planes,
                               [&](const Plane& p) { return p.normal.dot(corner) - p.offset <= near; });
  });
}

/// The faces of stones of a storey that lie on a support.
std::vector<std::vector<Vec3>> stones_on(const Support& support, const MemberStart& from,
                                         const MemberStart& to, double near, const Assembly& assembly) {
  std::vector<std::vector<Vec3>> bed;
  for (size_t p = from.part; p < to.part; ++p) {
    const Part& part = assembly.parts[p];
    if (assembly.blocks[part.block].fixed) continue;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      std::vector<Vec3> face = face_points(assembly, f);
      if (std::ranges::all_of(face, [&](const Vec3& corner) {
            return support.box.squaredExteriorDistance(corner) <= near * near &&
                   is_on(support.parts, corner, near);
          }))
        bed.push_back(std::move(face));
    }
  }
  return bed;
}

/// Corners of the stones that lie on some parts of a support, or that reach over them.
std::vector<Vec3> bed_on(const Support& support, Parts parts, double near) {
  std::vector<Vec3> corners;
  for (const std::vector<Vec3>& face : support.bed)
    if (std::ranges::any_of(face, [&](const Vec3& corner) { return is_on(parts, corner, near); }))
      corners.insert(corners.end(), face.begin(), face.end());
  return corners;
}

std::vector<Support> supports_of(std::span<const MemberStart> starts, const Assembly& assembly) {
  std::vector<Support> supports;
  for (size_t storey = 0; storey + 1 < starts.size(); ++storey)
    for (size_t p = starts[storey].part; p < starts[storey + 1].part; ++p) {
      const int block = assembly.parts[p].block;
      if (!assembly.blocks[block].fixed) continue;
      if (supports.empty() || supports.back().block != block)
        supports.push_back({block, storey, {}, {}, {}, {}});
      supports.back().parts.push_back(convex_shape(assembly, assembly.parts[p]));
      for (const Vec3& v : supports.back().parts.back().vertices) supports.back().box.extend(v);
    }
  return supports;
}

bool overlap(Parts a, Parts b, double near) {
  return std::ranges::any_of(a, [&](const ConvexShape& of_a) {
    return std::ranges::any_of(
        b, [&](const ConvexShape& of_b) { return overlap_depth(of_a, of_b, near) > near; });
  });
}

/// Where points begin and end along a direction, m.
std::pair<double, double> extent(const std::vector<Vec3>& points, const Vec3& direction) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : points) {
    low = std::min(low, direction.dot(p));
    high = std::max(high, direction.dot(p));
  }
  return {low, high};
}

/// The plane along a side of parts of either support midway between the stones on both, on whose lower side
/// those on `a` lie: the one with the most room. None if there is no such plane.
std::optional<Plane> plane_between(const Support& a, Parts of_a, const Support& b, Parts of_b, double near) {
  std::optional<Plane> widest;
  double most = -near;
  const std::vector<Vec3> bed_a = bed_on(a, of_a, near), bed_b = bed_on(b, of_b, near);
  if (bed_a.empty() || bed_b.empty()) return widest;
  const auto consider = [&](const Vec3& normal) {
    const auto [low, end] = extent(bed_a, normal);
    const auto [start, high] = extent(bed_b, normal);
    const bool is_level = end - low <= near || high - start <= near;  // stones lie in such a plane
    if (is_level || start - end <= most) return;
    most = start - end;
    widest = Plane{normal, 0.5 * (start + end)};
  };
  for (const ConvexShape& part : of_a)
    for (const Plane& plane : part.planes) consider(plane.normal);
  for (const ConvexShape& part : of_b)
    for (const Plane& plane : part.planes) consider(-plane.normal);
  return widest;
}

/// Limits two supports by the plane between them; if there is none, as about a support in an opening of the
/// other, by those between their parts, each as far as all of its stones lie on one side.
void limit(double near, Support* a, Support* b) {
  const auto add = [&](const std::optional<Plane>& between) {
    if (!between) return;
    for (const auto& [support, plane] :
         {std::pair(a, *between), {b, Plane{-between->normal, -between->offset}}})
      if (extent(bed_on(*support, support->parts, near), plane.normal).second <= plane.offset + near)
        support->limits.push_back(plane);
  };
  const std::optional<Plane> whole = plane_between(*a, a->parts, *b, b->parts, near);
  add(whole);
  if (whole) return;
  for (const ConvexShape& of_a : a->parts)
    for (const ConvexShape& of_b : b->parts)
      if (overlap({&of_a, 1}, {&of_b, 1}, near)) add(plane_between(*a, {&of_a, 1}, *b, {&of_b, 1}, near));
}

/// Writes all parts again, those of supports cut by their limits; parts beyond these are dropped.
void clip(const std::vector<Support>& supports, double rounding, Assembly* assembly) {
  std::map<int, ConvexClip> clips;  // of blocks, whose parts share the vertices of the cuts
  for (const Support& support : supports)
    if (!support.limits.empty()) clips.try_emplace(support.block, support.limits, rounding, assembly);
  const Assembly before = *assembly;
  assembly->parts.clear();
  assembly->face_kinds.clear();
  assembly->face_vertices.clear();
  assembly->face_vertex_start.clear();
  for (Part part : before.parts) {
    ConvexPiece piece = piece_of(before, part);
    if (const auto cut = clips.find(part.block); cut != clips.end()) piece = cut->second.inside(piece);
    if (piece.faces.empty()) continue;
    part.face_start = assembly->num_faces();
    part.num_faces = 0;
    assembly->parts.push_back(part);
    for (const ConvexPiece::Face& face : piece.faces) assembly->add_face(face.vertices, face.kind);
  }
}

}  // namespace

void part_supports(std::span<const MemberStart> starts, double gap, Assembly* assembly) {
  Eigen::AlignedBox3d box;
  for (const Vec3& v : assembly->vertices) box.extend(v);
  const double rounding = 1e-12 * box.diagonal().norm(), near = 1e3 * rounding + 2.0 * gap;
  std::vector<Support> supports = supports_of(starts, *assembly);
  for (Support& a : supports)
    for (Support& b : supports) {
      if (a.storey >= b.storey || !a.box.intersects(b.box) || !overlap(a.parts, b.parts, near)) continue;
      for (Support* support : {&a, &b})
        if (support->bed.empty())
          support->bed =
              stones_on(*support, starts[support->storey], starts[support->storey + 1], near, *assembly);
      limit(near, &a, &b);
    }
  if (std::ranges::all_of(supports, [](const Support& s) { return s.limits.empty(); })) return;
  if (!assembly->vertex_layers.empty()) {
    assembly->vertex_layers.resize(assembly->vertices.size(), -1);  // corners of supports
    assembly->vertex_depths.resize(assembly->vertices.size(), 0.0);
  }
  clip(supports, rounding, assembly);
}

}  // namespace cupola
