#pragma once

#include <array>
#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Closed triangle surface, counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;

  const Vec3& corner(int triangle, int i) const { return vertices[triangles[triangle][i]]; }
};

double mesh_volume(const TriangleMesh& mesh);
double mesh_size(const TriangleMesh& mesh);  ///< m, largest extent of its box

/// Triangles in one plane that hang together.
struct Facet {
  Plane plane;
  double area = 0.0;
  std::vector<int> triangles;
};

/// Clusters triangles whose normals differ by at most `angle` (rad) from the largest one of the cluster, and
/// that lie in its plane within `distance` (m). `facet_of` receives the facet of each triangle.
std::vector<Facet> find_facets(const TriangleMesh& mesh, double angle, double distance,
                               std::vector<int>* facet_of);

/// Triangle beyond the edge from corner i to corner i + 1 of each triangle; -1 for none.
std::vector<std::array<int, 3>> triangle_neighbours(const TriangleMesh& mesh);

/// Largest distance of a facet's corner from the facet's plane, m: how noisy the coordinates are.
double unevenness(const TriangleMesh& mesh, const std::vector<Facet>& facets);

/// Boundary of a facet without holes as one polygon, counter-clockwise; empty when it has holes. Begins where
/// most of its triangles meet, so that a fan from there bounds the same volume although the facet is warped.
std::vector<int> facet_loop(const TriangleMesh& mesh, const Facet& facet);

/// Line segment where two facets meet with more than 180 deg of solid between them.
struct ReflexEdge {
  Vec3 start, end;
  int facet_a = 0, facet_b = 0;
};

/// Edges that are reflex by more than `angle` (rad); pieces of one line between the same facets are one edge.
std::vector<ReflexEdge> find_reflex_edges(const TriangleMesh& mesh, const std::vector<Facet>& facets,
                                          const std::vector<int>& facet_of, double angle);

/// How many times the surface winds round a point: 1 inside, 0 outside (sum of solid angles over 4 pi).
double winding_number(const TriangleMesh& mesh, const Vec3& point);

}  // namespace cupola
