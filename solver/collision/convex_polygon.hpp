#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace cupola {

using Vec2 = Eigen::Vector2d;

/// Corner of an overlap polygon. Edges are labelled 0 .. n-1 on the subject polygon (edge i starts at its
/// corner i) and n .. n+m-1 on the clip polygon.
struct ClipCorner {
  Vec2 position = Vec2::Zero();
  int edge_in = 0;   ///< edge that ends here
  int edge_out = 0;  ///< edge that starts here
};

/// Overlap of two convex polygons, both counter-clockwise, by Sutherland-Hodgman clipping. Empty when they do
/// not overlap. `tolerance` and `crossing_height` in m.
///
/// - Corners within `tolerance` of an edge count as inside it, corners within `tolerance` of each other are
///   merged, and corners on the chord of their neighbours are removed. Two polygons that are equal up to
///   rounding therefore give the same polygon.
/// - A crossing of two nearly coincident edges is removed when it lies within `crossing_height` of the chord
///   of its neighbours. A polygon and a slightly rotated copy therefore give a polygon with as many corners.
std::vector<ClipCorner> clip_convex_polygon(std::span<const Vec2> subject, std::span<const Vec2> clip,
                                            double tolerance, double crossing_height = 0.0);

/// Area, m2, positive when counter-clockwise.
double polygon_area(std::span<const Vec2> polygon);
Vec2 polygon_centroid(std::span<const Vec2> polygon);

/// Indices of the corners that define a polygon, in order: one of several corners within `tolerance` (m) of
/// each other, and none within `tolerance` of the chord of its neighbours. Empty when fewer than three
/// remain.
std::vector<int> essential_corners(std::span<const Vec2> polygon, double tolerance);

/// Indices of the corners of the convex hull, counter-clockwise, without points within `tolerance` (m) of its
/// edges.
std::vector<int> convex_hull(std::span<const Vec2> points, double tolerance);

/// Width of a convex polygon, m: smallest distance between two parallel lines that enclose it.
double polygon_width(std::span<const Vec2> polygon);

}  // namespace cupola
