#include "postproc/mechanics/planar_hull.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

using Vec2 = Eigen::Vector2d;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Andrew's monotone chain (1979): corners counter-clockwise, without collinear points.
std::vector<Vec2> convex_outline(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> hull;
  const auto extend = [&hull](const Vec2& p, size_t start) {
    while (hull.size() >= start + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
      hull.pop_back();
    hull.push_back(p);
  };
  for (const Vec2& p : points) extend(p, 0);
  const size_t upper_start = hull.size() - 1;
  for (size_t i = points.size() - 1; i-- > 0;) extend(points[i], upper_start);
  hull.pop_back();
  return hull;
}

/// Computes area, centroid and second moment of the polygon by triangles from its first corner.
void integrate(PlanarHull* hull) {
  const std::vector<Vec2>& p = hull->outline;
  double area = 0.0;
  Vec2 first = Vec2::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (size_t i = 2; i < p.size(); ++i) {
    const Vec2 a = p[i - 1] - p[0];
    const Vec2 b = p[i] - p[0];
    const double triangle = 0.5 * cross(a, b);
    const Vec2 sum = a + b;
    area += triangle;
    first += triangle / 3.0 * sum;
    second += triangle / 12.0 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose());
  }
  constexpr double kLine = 1e-9;  // of the square of its length: far above rounding, far below any joint
  double length = 0.0;
  for (const Vec2& q : p) length = std::max(length, (q - p[0]).norm());
  Vec2 centroid = Vec2::Zero();
  if (area > kLine * length * length) {
    centroid = p[0] + first / area;
    second -= area * (centroid - p[0]) * (centroid - p[0]).transpose();
  } else {
    area = 0.0;
    second.setZero();
    for (const Vec2& q : p) centroid += q / static_cast<double>(p.size());
  }
  hull->area = area;
  hull->second_moment = second;
  hull->centroid += centroid.x() * hull->axis_1 + centroid.y() * hull->axis_2;
  for (Vec2& q : hull->outline) q -= centroid;
}

}  // namespace

Vec2 PlanarHull::coordinates(const Vec3& point) const {
  return {axis_1.dot(point - centroid), axis_2.dot(point - centroid)};
}

Vec3 PlanarHull::position(const Vec2& x) const {
  return centroid + x.x() * axis_1 + x.y() * axis_2;
}

PlanarHull planar_hull(const std::vector<Vec3>& points, const Vec3& normal) {
  CUPOLA_ASSERT(!points.empty() && std::abs(normal.norm() - 1.0) < 1e-9);
  PlanarHull hull;
  for (const Vec3& p : points) hull.centroid += p / static_cast<double>(points.size());
  hull.plane = {normal, normal.dot(hull.centroid)};
  hull.axis_1 = normal.unitOrthogonal();
  hull.axis_2 = normal.cross(hull.axis_1);
  std::vector<Vec2> flat;
  for (const Vec3& p : points) flat.push_back(hull.coordinates(p));
  hull.outline = convex_outline(std::move(flat));
  integrate(&hull);
  return hull;
}

double distance_to_outline(const PlanarHull& hull, const Vec2& point) {
  if (hull.area <= 0.0) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < hull.outline.size(); ++i) {
    const Vec2& a = hull.outline[i];
    const Vec2 edge = hull.outline[(i + 1) % hull.outline.size()] - a;
    if (edge.norm() > 0.0) least = std::min(least, cross(edge, point - a) / edge.norm());
  }
  return least;
}

double kern_use(const PlanarHull& hull, const Vec2& point) {
  if (hull.area <= 0.0) return std::numeric_limits<double>::quiet_NaN();
  const Vec2 slope = hull.area * hull.second_moment.inverse() * point;
  double most = 0.0;
  for (const Vec2& corner : hull.outline) most = std::max(most, -slope.dot(corner));
  return most;
}

}  // namespace cupola
