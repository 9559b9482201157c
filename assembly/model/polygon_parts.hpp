#pragma once

#include <span>
#include <utility>
#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// A convex polygon in space and its plane.
struct PlanePolygon {
  explicit PlanePolygon(std::vector<Vec3> points)
      : corners(std::move(points)), plane(polygon_plane(corners)) {}

  std::vector<Vec3> corners;  ///< m, counter-clockwise about the normal of the plane
  Plane plane;
};

/// All faces of the parts of a block, `internal` ones among them.
std::vector<PlanePolygon> faces_of_block(const Assembly& assembly, int block);

/// A convex polygon, divided by the prism over another one.
struct DividedPolygon {
  std::vector<Vec3> inside;  ///< empty if they do not overlap
  std::vector<std::vector<Vec3>> outside;
};

/// Corners within the tolerance (m) of a side of `other` lie on it.
DividedPolygon divide(const std::vector<Vec3>& polygon, const PlanePolygon& other, double tolerance);

/// The pieces of a face of a convex part that no face in the same plane, seen from its other side, covers.
std::vector<std::vector<Vec3>> uncovered(const PlanePolygon& face, std::span<const PlanePolygon> others,
                                         double tolerance);

}  // namespace cupola
