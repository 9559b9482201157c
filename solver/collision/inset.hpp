#pragma once

#include <span>
#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Convex polyhedron by its corners and faces, each face counter-clockwise seen from outside.
struct Polytope {
  std::vector<Vec3> vertices;           ///< m
  std::vector<std::vector<int>> faces;  ///< into vertices
};

/// The polyhedron between half-spaces n.x <= d, all moved inwards by `inset` (m): the corners are the meets
/// of three planes that no other plane cuts off. Corners nearer than `tolerance` (m) are one. Without corners
/// when nothing is left. Cost: cubic in the number of planes, once per part.
Polytope inset_polytope(std::span<const Plane> planes, double inset, double tolerance);

}  // namespace cupola
