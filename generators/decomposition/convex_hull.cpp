#include "generators/decomposition/convex_hull.hpp"

#include <map>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

namespace cupola {

TriangleMesh convex_hull(std::span<const Vec3> points) {
  using HullPoint = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  using HullMesh = CGAL::Surface_mesh<HullPoint>;
  std::vector<HullPoint> input;
  for (const Vec3& p : points) input.emplace_back(p.x(), p.y(), p.z());
  HullMesh hull;
  CGAL::convex_hull_3(input.begin(), input.end(), hull);
  if (hull.number_of_faces() < 4) return {};  // CGAL makes one face of coplanar points, else triangles
  TriangleMesh mesh;
  std::map<HullMesh::Vertex_index, int> id;
  for (const auto v : hull.vertices()) {
    id[v] = static_cast<int>(mesh.vertices.size());
    mesh.vertices.emplace_back(hull.point(v).x(), hull.point(v).y(), hull.point(v).z());
  }
  for (const auto f : hull.faces()) {
    std::array<int, 3> triangle{};
    int i = 0;
    for (const auto v : CGAL::vertices_around_face(hull.halfedge(f), hull)) triangle.at(i++) = id[v];
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace cupola
