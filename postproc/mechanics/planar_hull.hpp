#pragma once

#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// A convex polygon in a plane in space, with its area and second moments.
struct PlanarHull {
  Plane plane;                  ///< of the given normal, through the mean of the points
  Vec3 axis_1 = Vec3::UnitX();  ///< unit vectors spanning the plane
  Vec3 axis_2 = Vec3::UnitY();
  std::vector<Eigen::Vector2d> outline;  ///< m, counter-clockwise about the normal, relative to `centroid`
  Vec3 centroid = Vec3::Zero();          ///< m
  double area = 0.0;                     ///< m2
  Eigen::Matrix2d second_moment = Eigen::Matrix2d::Zero();  ///< m4, integral of x x^T about the centroid

  Eigen::Vector2d coordinates(const Vec3& point) const;     ///< m, in the plane, relative to `centroid`
  Vec3 position(const Eigen::Vector2d& coordinates) const;  ///< m, in space
};

/// Convex hull of points, projected onto the plane through their mean with the given unit normal. Fewer than
/// three points and points on a line, but for rounding, give an outline of zero area.
PlanarHull planar_hull(const std::vector<Vec3>& points, const Vec3& normal);

/// Distance of a point from the outline, m: positive inside, negative outside; 0 for a hull of zero area.
double distance_to_outline(const PlanarHull& hull, const Eigen::Vector2d& point);

/// Kern utilisation k of a normal force that acts at `point`; NaN for a hull of zero area, which is a hinge.
///
/// With a linear distribution of pressure (Navier), the least pressure on the outline is 1 - k times the
/// mean. For k <= 1 the force lies in the kern and the whole joint is compressed. A rectangle of width b has
/// k = 6 e / b.
double kern_use(const PlanarHull& hull, const Eigen::Vector2d& point);

}  // namespace cupola
