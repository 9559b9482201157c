#pragma once

#include <span>
#include <vector>

#include "solver/collision/convex_polygon.hpp"

namespace cupola {

/// Where the contact points of a patch lie.
enum class PatchPoints {
  corners,    ///< the corners of the overlap polygon, for compliance per point
  quadrature  ///< integration points of the polygon, for compliance per area
};

/// One contact point of a patch. Corners are numbered 0, 1, ... along the polygon, inner points -1, -2, ...
struct PatchPoint {
  Vec2 position = Vec2::Zero();  ///< m, in the plane of the patch
  double area = 0.0;             ///< m2 that the point stands for
  int corner = 0;
};

/// The corners of a convex polygon, each with an equal share of its area.
std::vector<PatchPoint> corner_points(std::span<const Vec2> polygon);

/// Points that integrate every quadratic over the convex polygon exactly, so that a joint under compliance
/// per area has the true axial and rotational stiffness, with points on the corners, so that hinges stay on
/// the edge. Parallelogram: corners 1/12 of the area each and centroid 2/3;
/// triangle: corners 1/12 and centroid 3/4; other polygons: the triangles between the centroid and each edge,
/// which keeps the symmetry of the polygon.
std::vector<PatchPoint> quadrature_points(std::span<const Vec2> polygon);

std::vector<PatchPoint> patch_points(std::span<const Vec2> polygon, PatchPoints kind);

}  // namespace cupola
