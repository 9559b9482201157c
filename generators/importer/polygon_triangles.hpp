#pragma once

#include <array>
#include <span>
#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Splits a polygon in space into triangles: the constrained Delaunay triangulation (CGAL) of its projection
/// on the plane of its mean normal. A warped polygon and its reverse give the same triangles, so that both
/// sides of a joint have one shape. The polygon may pass an edge in both directions, as to a hole. Returns
/// indices into `corners`, in the sense of the polygon; none if the projection crosses itself.
std::vector<std::array<int, 3>> triangulate_polygon(std::span<const Vec3> corners);

}  // namespace cupola
