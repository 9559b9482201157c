#include "generators/importer/polygon_triangles.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_traits_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

namespace cupola {
namespace {

using ProjectionKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using ProjectionTraits = CGAL::Projection_traits_3<ProjectionKernel>;
using PlaneCells =
    CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<int, ProjectionTraits>,
                                         CGAL::Constrained_triangulation_face_base_2<ProjectionTraits>>;
using PlaneTriangulation = CGAL::Constrained_Delaunay_triangulation_2<ProjectionTraits, PlaneCells,
                                                                      CGAL::No_constraint_intersection_tag>;
using Vertex = PlaneTriangulation::Vertex_handle;

/// The corners as a cycle that a polygon and its reverse share: from the least corner (by x, y, z) towards
/// the lesser of its neighbours.
struct CommonCycle {
  std::vector<int> order;
  bool reversed = false;
};

CommonCycle common_cycle(std::span<const Vec3> corners) {
  const auto key = [&](int i) { return std::array{corners[i].x(), corners[i].y(), corners[i].z()}; };
  CommonCycle cycle;
  const int n = static_cast<int>(corners.size());
  int least = 0;
  for (int i = 1; i < n; ++i)
    if (key(i) < key(least)) least = i;
  cycle.reversed = key((least + n - 1) % n) < key((least + 1) % n);
  for (int i = 0; i < n; ++i) cycle.order.push_back((least + (cycle.reversed ? n - i : i)) % n);
  return cycle;
}

/// The sides of the cycle without those that it passes in both directions, such as the bridge to a hole.
std::vector<std::pair<Vertex, Vertex>> sides_of(const std::vector<Vertex>& cycle) {
  std::vector<std::pair<Vertex, Vertex>> sides;
  for (size_t i = 0; i < cycle.size(); ++i) {
    const Vertex from = cycle[i], to = cycle[(i + 1) % cycle.size()];
    const auto reverse = std::ranges::find(sides, std::pair(to, from));
    if (reverse == sides.end())
      sides.emplace_back(from, to);
    else
      sides.erase(reverse);
  }
  return sides;
}

/// The faces inside the constrained edges: those that an odd number of edges separates from infinity.
std::vector<PlaneTriangulation::Face_handle> faces_inside(const PlaneTriangulation& triangulation) {
  std::map<PlaneTriangulation::Face_handle, bool> inside{{triangulation.infinite_face(), false}};
  std::vector<PlaneTriangulation::Face_handle> open{triangulation.infinite_face()}, found;
  while (!open.empty()) {
    const auto face = open.back();
    open.pop_back();
    if (inside[face]) found.push_back(face);
    for (int i = 0; i < 3; ++i)
      if (inside.try_emplace(face->neighbor(i), inside[face] != face->is_constrained(i)).second)
        open.push_back(face->neighbor(i));
  }
  return found;
}

}  // namespace

std::vector<std::array<int, 3>> triangulate_polygon(std::span<const Vec3> corners) {
  if (corners.size() == 3) return {{0, 1, 2}};
  const CommonCycle cycle = common_cycle(corners);
  std::vector<Vec3> polygon;
  for (int i : cycle.order) polygon.push_back(corners[i]);
  const Vec3 normal = polygon_plane(polygon).normal;
  if (!normal.allFinite() || normal.isZero()) return {};
  PlaneTriangulation triangulation(ProjectionTraits({normal.x(), normal.y(), normal.z()}));
  std::vector<Vertex> vertices;
  std::vector<std::array<int, 3>> triangles;
  try {
    for (int i : cycle.order) {
      vertices.push_back(triangulation.insert({corners[i].x(), corners[i].y(), corners[i].z()}));
      vertices.back()->info() = i;
    }
    for (const auto& [from, to] : sides_of(vertices)) triangulation.insert_constraint(from, to);
  } catch (const PlaneTriangulation::Intersection_of_constraints_exception&) {
    return {};
  }
  std::set<std::array<double, 3>> distinct;
  for (const Vec3& p : corners) distinct.insert({p.x(), p.y(), p.z()});
  if (triangulation.dimension() < 2 || triangulation.number_of_vertices() < distinct.size()) return {};
  for (const auto face : faces_inside(triangulation)) {
    std::array<int, 3> t{face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
    if (cycle.reversed) std::swap(t[1], t[2]);
    triangles.push_back(t);
  }
  std::ranges::sort(triangles);
  return triangles.size() + 2 == corners.size() ? triangles : std::vector<std::array<int, 3>>{};
}

}  // namespace cupola
