#pragma once

#include <array>
#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Closed triangle surface, counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
  /// Polygon of the file that each triangle belongs to, -1 for none; empty: none of them.
  std::vector<int> polygons;

  const Vec3& corner(int triangle, int i) const { return vertices[triangles[triangle][i]]; }
};

double mesh_volume(const TriangleMesh& mesh);
double mesh_size(const TriangleMesh& mesh);  ///< m, largest extent of its axis-aligned box

/// Connected triangles in one plane.
struct Facet {
  Plane plane;
  double area = 0.0;
  std::vector<int> triangles;
};

/// The triangles of each polygon of the file, and each other triangle by itself.
std::vector<std::vector<int>> triangles_of_polygons(const TriangleMesh& mesh);

/// Mean plane of triangles, weighted by area, and their total area.
Facet mean_facet(const TriangleMesh& mesh, std::vector<int> triangles);

/// Largest distance of a corner of the facet from its plane, m.
double unevenness(const TriangleMesh& mesh, const Facet& facet);

/// Clusters connected polygons into facets. Their normals differ by at most `angle` (rad) from that of the
/// largest polygon of the facet, and their corners lie within `distance` (m) of their mean plane. A polygon
/// that is not plane within `distance` counts as several triangles. `facet_of` receives the facet of each
/// triangle.
std::vector<Facet> find_facets(const TriangleMesh& mesh, double angle, double distance,
                               std::vector<int>* facet_of);

/// Per triangle, the triangle across the edge from corner i to corner i + 1; -1 for none.
std::vector<std::array<int, 3>> triangle_neighbours(const TriangleMesh& mesh);

/// Largest distance of a facet's corner from the plane of the facet, m: a measure of the noise in the
/// coordinates.
double unevenness(const TriangleMesh& mesh, const std::vector<Facet>& facets);

/// Boundary of a facet as one counter-clockwise polygon; empty if the facet has holes. It begins at the
/// vertex that most of the facet's triangles share, so that a fan from there bounds the same volume even if
/// the facet is warped.
std::vector<int> facet_loop(const TriangleMesh& mesh, const Facet& facet);

/// Line segment where two facets enclose more than 180 deg of solid.
struct ReflexEdge {
  Vec3 start, end;
  int facet_a = 0, facet_b = 0;
};

/// Edges that are reflex by more than `angle` (rad). Adjoining segments between the same two facets form one
/// edge.
std::vector<ReflexEdge> find_reflex_edges(const TriangleMesh& mesh, const std::vector<Facet>& facets,
                                          const std::vector<int>& facet_of, double angle);

/// Winding number of the surface about a point: 1 inside, 0 outside (sum of solid angles over 4 pi).
double winding_number(const TriangleMesh& mesh, const Vec3& point);

}  // namespace cupola
