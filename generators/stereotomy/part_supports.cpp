#include "generators/stereotomy/part_supports.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "generators/stereotomy/convex_clip.hpp"
#include "generators/stereotomy/separation.hpp"

namespace cupola {
namespace {

/// A convex part of a support.
struct Plate {
  size_t part = 0, storey = 0;
  bool is_whole = false;  // all of its support: the parts of others must stay closed against each other
  ConvexShape shape;
  std::vector<Vec3> bed;      // m, corners of the stones on it
  std::vector<Plane> limits;  // m, up to which it stays
};

/// Corners of the faces of stones of a storey that lie on a shape.
std::vector<Vec3> stones_on(const ConvexShape& shape, const MemberStart& from, const MemberStart& to,
                            double near, const Assembly& assembly) {
  const auto is_on = [&](const Vec3& corner) {
    return std::ranges::all_of(
        shape.planes, [&](const Plane& plane) { return plane.normal.dot(corner) - plane.offset <= near; });
  };
  std::vector<Vec3> corners;
  for (size_t p = from.part; p < to.part; ++p) {
    const Part& part = assembly.parts[p];
    if (assembly.blocks[part.block].fixed) continue;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      const std::vector<Vec3> face = face_points(assembly, f);
      if (std::ranges::all_of(face, is_on)) corners.insert(corners.end(), face.begin(), face.end());
    }
  }
  return corners;
}

std::vector<Plate> plates_of(std::span<const MemberStart> starts, const Assembly& assembly) {
  std::map<int, int> parts;  // of blocks
  for (const Part& part : assembly.parts) ++parts[part.block];
  std::vector<Plate> plates;
  for (size_t storey = 0; storey + 1 < starts.size(); ++storey)
    for (size_t p = starts[storey].part; p < starts[storey + 1].part; ++p) {
      const int block = assembly.parts[p].block;
      if (assembly.blocks[block].fixed)
        plates.push_back({p, storey, parts[block] == 1, convex_shape(assembly, assembly.parts[p]), {}, {}});
    }
  return plates;
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

/// The plane along a side of either plate midway between the stones on both, on whose lower side those on `a`
/// lie: the one with the most room. None if there is no such plane.
std::optional<Plane> plane_between(const Plate& a, const Plate& b, double near) {
  std::optional<Plane> widest;
  double most = -near;
  if (a.bed.empty() || b.bed.empty()) return widest;
  const auto consider = [&](const Vec3& normal) {
    const auto [low, end] = extent(a.bed, normal);
    const auto [start, high] = extent(b.bed, normal);
    const bool is_level = end - low <= near || high - start <= near;  // stones lie in such a plane
    if (is_level || start - end <= most) return;
    most = start - end;
    widest = Plane{normal, 0.5 * (start + end)};
  };
  for (const Plane& plane : a.shape.planes) consider(plane.normal);
  for (const Plane& plane : b.shape.planes) consider(-plane.normal);
  return widest;
}

/// Writes all parts again, the plates cut by their limits.
void clip(const std::vector<Plate>& plates, double rounding, Assembly* assembly) {
  std::map<size_t, ConvexPiece> pieces;  // of parts
  for (const Plate& plate : plates)
    if (!plate.limits.empty())
      pieces[plate.part] = ConvexClip(plate.limits, rounding, assembly)
                               .inside(piece_of(*assembly, assembly->parts[plate.part]));
  const Assembly before = *assembly;
  assembly->parts.clear();
  assembly->face_kinds.clear();
  assembly->face_vertices.clear();
  assembly->face_vertex_start.clear();
  for (size_t p = 0; p < before.parts.size(); ++p) {
    Part part = before.parts[p];
    part.face_start = assembly->num_faces();
    part.num_faces = 0;
    assembly->parts.push_back(part);
    const int first = before.parts[p].face_start, end = first + before.parts[p].num_faces;
    if (const auto cut = pieces.find(p); cut != pieces.end())
      for (const ConvexPiece::Face& face : cut->second.faces) assembly->add_face(face.vertices, face.kind);
    else
      for (int f = first; f < end; ++f) assembly->add_face(before.face(f), before.face_kinds[f]);
  }
}

}  // namespace

void part_supports(std::span<const MemberStart> starts, double gap, Assembly* assembly) {
  Eigen::AlignedBox3d box;
  for (const Vec3& v : assembly->vertices) box.extend(v);
  const double rounding = 1e-12 * box.diagonal().norm(), near = 1e3 * rounding + 2.0 * gap;
  std::vector<Plate> plates = plates_of(starts, *assembly);
  bool any = false;
  for (Plate& a : plates)
    for (Plate& b : plates) {
      if (a.storey >= b.storey || !(a.is_whole || b.is_whole) ||
          overlap_depth(a.shape, b.shape, near) <= near)
        continue;
      for (Plate* plate : {&a, &b})
        if (plate->bed.empty())
          plate->bed =
              stones_on(plate->shape, starts[plate->storey], starts[plate->storey + 1], near, *assembly);
      const std::optional<Plane> between = plane_between(a, b, near);
      if (!between) continue;
      if (a.is_whole) a.limits.push_back(*between);
      if (b.is_whole) b.limits.push_back({-between->normal, -between->offset});
      any = true;
    }
  if (!any) return;
  if (!assembly->vertex_layers.empty()) {
    assembly->vertex_layers.resize(assembly->vertices.size(), -1);  // corners of supports
    assembly->vertex_depths.resize(assembly->vertices.size(), 0.0);
  }
  clip(plates, rounding, assembly);
}

}  // namespace cupola
