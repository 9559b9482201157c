#include "generators/importer/mesh_repair.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "generators/decomposition/convex_hull.hpp"
#include "generators/importer/polygon_triangles.hpp"

namespace cupola {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<Point>;
using FaceNumbers = SurfaceMesh::Property_map<SurfaceMesh::Face_index, int>;
using Polygons = std::vector<std::vector<std::size_t>>;

[[noreturn]] void fail(const RawBlock& block, const std::string& message) {
  throw InputError(block.where, fmt::format("block {}: {}", block.name, message));
}

double extent(const std::vector<Vec3>& points) {
  Vec3 low = points.front(), high = low;
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).maxCoeff();
}

/// Merges vertices within `distance` (m) of an earlier one, by a sweep along x, and drops faces without area.
PolygonMesh weld_vertices(const PolygonMesh& mesh, double distance) {
  std::vector<int> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int v) { return mesh.vertices[v].x(); });
  std::vector<int> representative(mesh.vertices.size(), -1);
  for (size_t i = 0; i < order.size(); ++i) {
    const int v = order[i];
    if (representative[v] < 0) representative[v] = v;
    for (size_t j = i + 1; j < order.size(); ++j) {
      const int w = order[j];
      if (mesh.vertices[w].x() - mesh.vertices[v].x() > distance) break;
      if (representative[w] < 0 && (mesh.vertices[w] - mesh.vertices[v]).norm() <= distance)
        representative[w] = representative[v];
    }
  }
  PolygonMesh welded;
  std::vector<int> new_id(mesh.vertices.size(), -1);
  for (const auto& face : mesh.faces) {
    std::vector<int> loop;
    for (int v : face) {
      const int r = representative[v];
      if (!loop.empty() && loop.back() == r) continue;
      loop.push_back(r);
    }
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    if (loop.size() < 3) continue;
    for (int& v : loop) {
      if (new_id[v] < 0) {
        new_id[v] = static_cast<int>(welded.vertices.size());
        welded.vertices.push_back(mesh.vertices[v]);
      }
      v = new_id[v];
    }
    welded.faces.push_back(std::move(loop));
  }
  return welded;
}

/// Drops the faces that have the corners of an earlier one. Returns how many.
int drop_doubled_faces(PolygonMesh* mesh) {
  std::set<std::vector<int>> known;
  const auto is_new = [&](const std::vector<int>& face) {
    std::vector<int> corners = face;
    std::ranges::sort(corners);
    return known.insert(std::move(corners)).second;
  };
  return static_cast<int>(std::erase_if(mesh->faces, [&](const auto& face) { return !is_new(face); }));
}

/// Which corner of a triangle lies within `distance` (m) of its opposite side, between the ends of that; -1 if
/// none does.
int corner_on_side(const PolygonMesh& mesh, const std::vector<int>& face, double distance) {
  for (int i = 0; face.size() == 3 && i < 3; ++i) {
    const Vec3& from = mesh.vertices[face[(i + 1) % 3]];
    const Vec3 side = mesh.vertices[face[(i + 2) % 3]] - from, to_corner = mesh.vertices[face[i]] - from;
    const double share = side.dot(to_corner) / side.squaredNorm();
    if (share > 0.0 && share < 1.0 && (to_corner - share * side).norm() <= distance) return i;
  }
  return -1;
}

/// Makes a vertex a corner of a face between two of its neighbouring corners. False if it has no such pair.
bool insert_between(int a, int b, int vertex, std::vector<int>* face) {
  for (size_t i = 0; i < face->size(); ++i) {
    const int from = (*face)[i], to = (*face)[(i + 1) % face->size()];
    if (std::minmax(from, to) != std::minmax(a, b)) continue;
    face->insert(face->begin() + static_cast<std::ptrdiff_t>(i) + 1, vertex);
    return true;
  }
  return false;
}

/// Drops triangles of three corners on a line, as a fan makes of a face with a corner on a side: the face
/// across the longest side gets the third corner.
void drop_flat_triangles(PolygonMesh* mesh, double distance) {
  std::vector<int> middle;
  for (const auto& face : mesh->faces) middle.push_back(corner_on_side(*mesh, face, distance));
  for (bool changed = true; changed;) {  // the face across may be such a triangle, too, and goes first
    changed = false;
    for (size_t f = 0; f < middle.size(); ++f) {
      if (middle[f] < 0) continue;
      const auto corner = [&, face = mesh->faces[f]](int i) { return face[(middle[f] + i) % 3]; };
      for (size_t g = 0; g < middle.size() && middle[f] >= 0; ++g) {
        if (middle[g] >= 0 || !insert_between(corner(1), corner(2), corner(0), &mesh->faces[g])) continue;
        mesh->faces[f].clear();
        middle[f] = -1;
        changed = true;
      }
    }
  }
  std::erase_if(mesh->faces, [](const auto& face) { return face.empty(); });
}

bool has_corner_twice(std::vector<int> face) {
  std::ranges::sort(face);
  return std::ranges::adjacent_find(face) != face.end();
}

/// The surface as a soup of triangles. A face that triangulate_polygon() cannot split remains a polygon.
struct Soup {
  Polygons polygons;
  std::vector<int> face;  // of the file, per polygon
};

Soup triangle_soup(const RawBlock& block, const PolygonMesh& mesh) {
  Soup soup;
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<int>& face = mesh.faces[f];
    std::vector<Vec3> corners;
    for (int v : face) corners.push_back(mesh.vertices[v]);
    const auto triangles = triangulate_polygon(corners);
    for (const auto& t : triangles)
      soup.polygons.push_back({static_cast<std::size_t>(face[t[0]]), static_cast<std::size_t>(face[t[1]]),
                               static_cast<std::size_t>(face[t[2]])});
    if (triangles.empty() && has_corner_twice(face))  // orient_polygon_soup() would not return
      fail(block, "a face passes through a corner twice: divide it");
    if (triangles.empty()) soup.polygons.emplace_back(face.begin(), face.end());
    soup.face.resize(soup.polygons.size(), static_cast<int>(f));
  }
  return soup;
}

/// Turns the faces outwards, those of a cavity into it, unless the drawing turns them `consistently`.
void orient(const RawBlock& block, bool consistently, SurfaceMesh* surface) {
  if (!consistently)
    pmp::orient_to_bound_a_volume(*surface);
  else if (!pmp::does_bound_a_volume(*surface))
    fail(block,
         "one of its closed surfaces is inside out: the faces of solids look outwards, those of cavities "
         "into the cavity");
  else if (!pmp::is_outward_oriented(*surface))
    fail(block,
         "inside out: reverse its faces, or, if it is the cavity of another block, draw both as one object "
         "(OBJ)");
}

TriangleMesh to_triangles(const SurfaceMesh& surface, const FaceNumbers& face_of_file) {
  TriangleMesh mesh;
  std::vector<int> id(surface.num_vertices(), -1);
  for (const auto v : surface.vertices()) {
    id[v] = static_cast<int>(mesh.vertices.size());
    const Point& p = surface.point(v);
    mesh.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : surface.faces()) {
    std::array<int, 3> triangle{};
    int i = 0;
    for (const auto v : CGAL::vertices_around_face(surface.halfedge(f), surface)) triangle.at(i++) = id[v];
    mesh.triangles.push_back(triangle);
    mesh.polygons.push_back(face_of_file[f]);
  }
  return mesh;
}

}  // namespace

TriangleMesh repair_mesh(const RawBlock& block, double weld, int* doubled) {
  constexpr double kFarthest = 1e9;  // m, beyond which no size of a stone is left of a double
  for (const Vec3& v : block.mesh.vertices)
    if (!v.allFinite())
      fail(block, "a coordinate is not finite");
    else if (v.cwiseAbs().maxCoeff() > kFarthest)
      fail(block, fmt::format("a coordinate of {:.3g} m: correct it, or geometry.import.metres_per_unit",
                              v.cwiseAbs().maxCoeff()));
  const double distance = weld * extent(block.mesh.vertices);
  PolygonMesh welded = weld_vertices(block.mesh, distance);
  const int dropped = drop_doubled_faces(&welded);
  drop_flat_triangles(&welded, distance);
  if (doubled) *doubled = dropped;
  if (welded.faces.empty()) fail(block, "all faces have zero area");
  std::vector<Point> points;
  for (const Vec3& v : welded.vertices) points.emplace_back(v.x(), v.y(), v.z());
  Soup soup = triangle_soup(block, welded);
  const bool consistent = pmp::is_polygon_soup_a_polygon_mesh(soup.polygons);
  if (!consistent && !pmp::orient_polygon_soup(points, soup.polygons))
    fail(block, "its faces do not form a manifold surface");
  SurfaceMesh surface;
  pmp::polygon_soup_to_polygon_mesh(points, soup.polygons, surface);
  CUPOLA_ASSERT(surface.number_of_faces() == soup.face.size());
  FaceNumbers face_of_file =
      surface.add_property_map<SurfaceMesh::Face_index, int>("f:face_of_file", -1).first;
  for (const auto f : surface.faces()) face_of_file[f] = soup.face[f];
  int open_edges = 0;
  for (const auto edge : surface.edges()) open_edges += surface.is_border(edge) ? 1 : 0;
  if (open_edges > 0) fail(block, fmt::format("not closed, {}", counted(open_edges, "boundary edge")));
  if (!pmp::triangulate_faces(surface)) fail(block, "a face cannot be triangulated");
  if (pmp::does_self_intersect(surface)) fail(block, "its surface intersects itself");
  orient(block, consistent, &surface);
  surface.collect_garbage();
  return to_triangles(surface, face_of_file);
}

TriangleMesh hull_mesh(const RawBlock& block, std::span<const Vec3> points) {
  TriangleMesh hull = convex_hull(points);
  if (hull.triangles.empty()) fail(block, "the corners of a part lie in one plane");
  return hull;
}

}  // namespace cupola
