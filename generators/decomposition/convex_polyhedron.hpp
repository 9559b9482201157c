#pragma once

#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Convex solid with plane faces.
struct ConvexPolyhedron {
  std::vector<Vec3> vertices;           ///< m
  std::vector<std::vector<int>> faces;  ///< vertex ids, counter-clockwise seen from outside
  std::vector<Plane> planes;            ///< of the faces, outward normals

  bool empty() const { return faces.empty(); }
};

ConvexPolyhedron box_polyhedron(const Vec3& low, const Vec3& high);
ConvexPolyhedron tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// The part of a solid with normal . x <= offset. Vertices within `tolerance` (m) of the plane count as on
/// it.
ConvexPolyhedron clip(const ConvexPolyhedron& solid, const Plane& plane, double tolerance);

double polyhedron_volume(const ConvexPolyhedron& solid);  ///< m3
Vec3 vertex_mean(const ConvexPolyhedron& solid);          ///< m

}  // namespace cupola
