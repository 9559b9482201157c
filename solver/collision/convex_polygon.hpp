#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace cupola {

using Vec2 = Eigen::Vector2d;

/// Corner of an overlap polygon. Labels tell which edges of the two polygons meet there: 0 .. n-1 for the
/// edges of the subject (edge i starts at its corner i), n .. n+m-1 for those of the clip polygon.
struct ClipCorner {
  Vec2 position = Vec2::Zero();
  int edge_in = 0;   ///< edge that ends here
  int edge_out = 0;  ///< edge that starts here
};

/// Overlap of two convex polygons, both counter-clockwise, by Sutherland-Hodgman clipping; empty when they do
/// not overlap. Corners nearer than `tolerance` (m) to an edge count as on its inside, corners nearer than
/// that to each other are one, and corners on the chord of their neighbours are dropped: two equal polygons
/// give that polygon, whatever the rounding of their corners. Where two edges cross that nearly coincide, so
/// that the crossing lies within `crossing_height` (m) of the chord of its neighbours, it is no corner: two
/// equal polygons, one turned a little, give a polygon with as many corners.
std::vector<ClipCorner> clip_convex_polygon(std::span<const Vec2> subject, std::span<const Vec2> clip,
                                            double tolerance, double crossing_height = 0.0);

/// Area, m2, positive for counter-clockwise.
double polygon_area(std::span<const Vec2> polygon);
Vec2 polygon_centroid(std::span<const Vec2> polygon);

/// Indices of the corners that a polygon needs, in order: of corners nearer than `tolerance` (m) to each
/// other one, and none that lies so near to the chord of its neighbours. Empty when fewer than three are
/// left.
std::vector<int> essential_corners(std::span<const Vec2> polygon, double tolerance);

/// Indices of the corners of the convex hull, counter-clockwise, without corners on its edges.
std::vector<int> convex_hull(std::span<const Vec2> points, double tolerance);

/// Smallest distance between two parallel lines that hold the convex polygon between them, m.
double polygon_width(std::span<const Vec2> polygon);

}  // namespace cupola
