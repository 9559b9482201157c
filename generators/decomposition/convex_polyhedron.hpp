#pragma once

#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Convex solid with plane faces, loops counter-clockwise seen from outside.
struct ConvexPolyhedron {
  std::vector<Vec3> vertices;
  std::vector<std::vector<int>> faces;
  std::vector<Plane> planes;  ///< of the faces, outward

  bool empty() const { return faces.empty(); }
};

ConvexPolyhedron box_polyhedron(const Vec3& low, const Vec3& high);
ConvexPolyhedron tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Keeps n.x <= offset. Vertices within `tolerance` (m) of the plane count as on it.
ConvexPolyhedron clip(const ConvexPolyhedron& solid, const Plane& plane, double tolerance);

double polyhedron_volume(const ConvexPolyhedron& solid);
Vec3 vertex_mean(const ConvexPolyhedron& solid);

}  // namespace cupola
