#include "generators/stereotomy/mesh_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>

namespace cupola {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Boundary of one block as triangles, or of one part as polygons with its internal faces. CGAL refuses a
/// face that uses an edge twice in one direction, which then leaves the boundary open.
SurfaceMesh boundary_of(const Assembly& assembly, const Part* begin, const Part* end, bool with_internal) {
  SurfaceMesh mesh;
  std::map<int, SurfaceMesh::Vertex_index> vertex;
  const auto mesh_vertex = [&](int id) {
    const auto [it, is_new] = vertex.try_emplace(id);
    const Vec3& p = assembly.vertices[id];
    if (is_new) it->second = mesh.add_vertex({p.x(), p.y(), p.z()});
    return it->second;
  };
  for (const Part* part = begin; part != end; ++part)
    for (int f = part->face_start; f < part->face_start + part->num_faces; ++f) {
      if (!with_internal && assembly.face_kinds[f] == FaceKind::internal) continue;
      const auto ids = assembly.face(f);
      if (with_internal) {
        std::vector<SurfaceMesh::Vertex_index> loop;
        for (int id : ids) loop.push_back(mesh_vertex(id));
        mesh.add_face(loop);
        continue;
      }
      for (size_t i = 2; i < ids.size(); ++i)
        mesh.add_face(mesh_vertex(ids[0]), mesh_vertex(ids[i - 1]), mesh_vertex(ids[i]));
    }
  return mesh;
}

BoundaryDefect check_boundary(int block, const SurfaceMesh& mesh, bool triangles) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  using enum BoundaryDefect::Kind;
  int boundary_edges = 0;
  for (const auto edge : mesh.edges()) boundary_edges += mesh.is_border(edge) ? 1 : 0;
  if (boundary_edges > 0 || mesh.number_of_faces() == 0) return {block, open, boundary_edges};
  if (!triangles) return {block, none, 0};
  if (!pmp::is_outward_oriented(mesh)) return {block, inside_out, 0};
  return {block, none, 0};
}

/// Ranges of x, y, z (m) and of the azimuth (rad, between -pi and 2 pi) of a part.
struct Ranges {
  std::array<double, 4> low, high;
};

Ranges ranges_of(const Assembly& assembly, const Part& part, double margin) {
  using std::numbers::pi;
  Ranges r;
  r.low.fill(std::numeric_limits<double>::infinity());
  r.high.fill(-std::numeric_limits<double>::infinity());
  const Vec3& first = assembly.vertices[assembly.face(part.face_start)[0]];
  const double azimuth = std::atan2(first.y(), first.x());
  double nearest = std::numeric_limits<double>::infinity();  // to the axis
  for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
    for (int v : assembly.face(f)) {
      const Vec3& p = assembly.vertices[v];
      const double turned = azimuth + std::remainder(std::atan2(p.y(), p.x()) - azimuth, 2.0 * pi);
      nearest = std::min(nearest, std::hypot(p.x(), p.y()));
      const std::array<double, 4> at{p.x(), p.y(), p.z(), turned};
      for (size_t i = 0; i < 4; ++i) {
        const double grown = i < 3 ? margin : 0.0;
        r.low.at(i) = std::min(r.low.at(i), at.at(i) - grown);
        r.high.at(i) = std::max(r.high.at(i), at.at(i) + grown);
      }
    }
  // A convex part that does not reach the axis has its extreme azimuths at corners, less than pi apart.
  const double spread = r.high[3] - r.low[3];
  const double clear = nearest * std::cos(0.5 * spread);
  if (spread > 0.9 * pi || clear <= 2.0 * margin) {
    r.low[3] = -pi;
    r.high[3] = pi;
    return r;
  }
  r.low[3] -= margin / clear;
  r.high[3] += margin / clear;
  if (r.low[3] < -pi) {
    r.low[3] += 2.0 * pi;
    r.high[3] += 2.0 * pi;
  }
  return r;
}

struct PartBox : CGAL::Box_intersection_d::Box_d<double, 4> {
  PartBox(double* low, double* high, int part_id) : Box_d(low, high), part(part_id) {}
  int part;
};

}  // namespace

std::vector<BoundaryDefect> find_boundary_defects(const Assembly& assembly, bool part_by_part) {
  std::vector<BoundaryDefect> defects;
  const Part* const parts_end = assembly.parts.data() + assembly.parts.size();
  for (const Part* begin = assembly.parts.data(); begin != parts_end;) {
    const Part* end = begin + 1;
    while (!part_by_part && end != parts_end && end->block == begin->block) ++end;
    const BoundaryDefect found =
        check_boundary(begin->block, boundary_of(assembly, begin, end, part_by_part), !part_by_part);
    if (found.kind != BoundaryDefect::Kind::none) defects.push_back(found);
    begin = end;
  }
  return defects;
}

void visit_near_pairs(const Assembly& assembly, double margin, const std::function<void(int, int)>& visit) {
  std::vector<PartBox> boxes;
  for (int p = 0; p < static_cast<int>(assembly.parts.size()); ++p) {
    Ranges r = ranges_of(assembly, assembly.parts[p], margin);
    boxes.emplace_back(r.low.data(), r.high.data(), p);
    const double turn = 2.0 * std::numbers::pi;
    if (r.high[3] <= std::numbers::pi) continue;
    r.low[3] -= turn;  // a part across the azimuth of 180 deg has a second box one turn back
    r.high[3] -= turn;
    boxes.emplace_back(r.low.data(), r.high.data(), p);
  }
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const PartBox& a, const PartBox& b) {
    if (a.part != b.part) visit(std::min(a.part, b.part), std::max(a.part, b.part));
  });
}

}  // namespace cupola
