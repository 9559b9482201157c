#pragma once

#include <span>
#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Convex polyhedron. Each face is counter-clockwise seen from outside.
struct Polytope {
  std::vector<Vec3> vertices;           ///< m
  std::vector<std::vector<int>> faces;  ///< into vertices
};

/// Intersection of the half-spaces n.x <= d - inset (m). Its corners are the intersections of three planes
/// that satisfy all inequalities; corners within `tolerance` (m) of each other are merged. Returns a polytope
/// without corners when the intersection is empty. Cost: fourth power of the number of planes, once per part.
Polytope inset_polytope(std::span<const Plane> planes, double inset, double tolerance);

}  // namespace cupola
