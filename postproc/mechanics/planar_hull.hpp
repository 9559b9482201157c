#pragma once

#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// A convex polygon in a plane of space with the moments of its area.
struct PlanarHull {
  Plane plane;                  ///< normal as given, through the points' mean
  Vec3 axis_1 = Vec3::UnitX();  ///< unit vectors spanning the plane
  Vec3 axis_2 = Vec3::UnitY();
  std::vector<Eigen::Vector2d> outline;  ///< m, counter-clockwise about the normal, from `centroid`
  Vec3 centroid = Vec3::Zero();          ///< m
  double area = 0.0;                     ///< m2
  Eigen::Matrix2d second_moment = Eigen::Matrix2d::Zero();  ///< m4, integral of x x^T about the centroid

  Eigen::Vector2d coordinates(const Vec3& point) const;
  Vec3 position(const Eigen::Vector2d& coordinates) const;
};

/// Convex hull of points projected on the plane of the given unit normal through their mean. Fewer than
/// three points, or points in line, give an outline without area.
PlanarHull planar_hull(const std::vector<Vec3>& points, const Vec3& normal);

/// Distance from an inner point to the outline, m, negative outside; 0 without area.
double distance_to_outline(const PlanarHull& hull, const Eigen::Vector2d& point);

/// Pressure under an eccentric force relative to the mean pressure, the least over the outline, by linear
/// distribution (Navier): 1 - kern_use; kern_use <= 1 says the force lies in the kern and the whole joint is
/// pressed. 6 e / b for a rectangle. 0 without area.
double kern_use(const PlanarHull& hull, const Eigen::Vector2d& point);

}  // namespace cupola
