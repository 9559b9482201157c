#pragma once

#include <span>

#include "generators/decomposition/triangle_mesh.hpp"

namespace cupola {

/// Convex hull of points (CGAL). No triangles if the points lie in one plane.
TriangleMesh convex_hull(std::span<const Vec3> points);

}  // namespace cupola
