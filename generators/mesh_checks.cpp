#include "generators/mesh_checks.hpp"

#include <algorithm>
#include <map>

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>

namespace cupola {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Boundary of one block as triangles; a face that cannot be attached (an edge used twice in one direction)
/// is left out and leaves its border open.
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
      for (size_t i = 2; i < ids.size(); ++i)
        mesh.add_face(mesh_vertex(ids[0]), mesh_vertex(ids[i - 1]), mesh_vertex(ids[i]));
    }
  return mesh;
}

BoundaryDefect check_boundary(int block, const SurfaceMesh& mesh) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  using enum BoundaryDefect::Kind;
  int boundary_edges = 0;
  for (const auto edge : mesh.edges()) boundary_edges += mesh.is_border(edge) ? 1 : 0;
  if (boundary_edges > 0 || mesh.number_of_faces() == 0) return {block, open, boundary_edges};
  if (pmp::does_self_intersect(mesh)) return {block, self_intersecting, 0};
  if (!pmp::is_outward_oriented(mesh)) return {block, inside_out, 0};
  return {block, none, 0};
}

}  // namespace

std::vector<BoundaryDefect> find_boundary_defects(const Assembly& assembly, bool part_by_part) {
  std::vector<BoundaryDefect> defects;
  const Part* const parts_end = assembly.parts.data() + assembly.parts.size();
  for (const Part* begin = assembly.parts.data(); begin != parts_end;) {
    const Part* end = begin + 1;
    while (!part_by_part && end != parts_end && end->block == begin->block) ++end;
    const BoundaryDefect found =
        check_boundary(begin->block, boundary_of(assembly, begin, end, part_by_part));
    if (found.kind != BoundaryDefect::Kind::none) defects.push_back(found);
    begin = end;
  }
  return defects;
}

std::vector<std::pair<int, int>> touching_boxes(const Assembly& assembly, double margin) {
  struct PartBox : CGAL::Box_intersection_d::Box_d<double, 3> {
    PartBox(const CGAL::Bbox_3& box, int part_id) : Box_d(box), part(part_id) {}
    int part;
  };
  std::vector<PartBox> boxes;
  for (size_t p = 0; p < assembly.parts.size(); ++p) {
    Vec3 low = Vec3::Constant(INFINITY), high = -low;
    const Part& part = assembly.parts[p];
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      for (int v : assembly.face(f)) {
        low = low.cwiseMin(assembly.vertices[v]);
        high = high.cwiseMax(assembly.vertices[v]);
      }
    low.array() -= margin;
    high.array() += margin;
    boxes.emplace_back(CGAL::Bbox_3(low.x(), low.y(), low.z(), high.x(), high.y(), high.z()),
                       static_cast<int>(p));
  }
  std::vector<std::pair<int, int>> pairs;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const PartBox& a, const PartBox& b) {
    pairs.emplace_back(std::min(a.part, b.part), std::max(a.part, b.part));
  });
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace cupola
