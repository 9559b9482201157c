#pragma once

#include <compare>
#include <span>
#include <vector>

#include "solver/collision/convex_polygon.hpp"

namespace cupola {

/// Position of the contact points of a patch.
enum class PatchPoints {
  corners,    ///< the corners of the overlap polygon, for compliance per point
  quadrature  ///< integration points of the polygon, for compliance per area
};

struct PatchSampling {
  PatchPoints points = PatchPoints::corners;
  int subdivide = 1;  ///< quadrature only, >= 1: each patch or triangle of it is cut into subdivide^2 pieces
  auto operator<=>(const PatchSampling&) const = default;
};

/// One contact point of a patch.
struct PatchPoint {
  Vec2 position = Vec2::Zero();  ///< m, in the plane of the patch
  double area = 0.0;             ///< m2, tributary area
  int corner = 0;                ///< corners of the polygon: 0, 1, ...; all other points: -1, -2, ...
};

/// The corners of a convex polygon, each with an equal share of its area.
std::vector<PatchPoint> corner_points(std::span<const Vec2> polygon);

/// Quadrature of a convex polygon that is exact for quadratic functions, so that a joint with compliance per
/// area has the exact axial and rotational stiffness. It includes the corners, so that hinges stay on the
/// edge. Weights as fractions of the area:
///
///     parallelogram   corners 1/12 each, centroid 2/3
///     triangle        corners 1/12 each, centroid 3/4
///     other polygons  sum of the triangle rule over the triangles between the centroid and each edge,
///                     which keeps the symmetry of the polygon
///
/// `subdivide` cuts a parallelogram into subdivide x subdivide parallelograms, and every triangle into
/// subdivide^2 similar ones, and applies the rule to each: joints with strength need points where a part of
/// the joint is at its limit.
std::vector<PatchPoint> quadrature_points(std::span<const Vec2> polygon, int subdivide = 1);

std::vector<PatchPoint> patch_points(std::span<const Vec2> polygon, const PatchSampling& sampling);

}  // namespace cupola
