#include "solver/collision/patch_quadrature.hpp"

namespace cupola {
namespace {

bool is_parallelogram(std::span<const Vec2> polygon) {
  if (polygon.size() != 4) return false;
  const Vec2 diagonal_mismatch = polygon[0] + polygon[2] - polygon[1] - polygon[3];
  const double size = (polygon[2] - polygon[0]).norm() + (polygon[3] - polygon[1]).norm();
  // The error of the rule is proportional to the mismatch. 1e-9 allows for rounding far from the origin.
  return diagonal_mismatch.norm() <= 1e-9 * size;
}

std::vector<PatchPoint> corners_with_area(std::span<const Vec2> polygon, double area) {
  std::vector<PatchPoint> points;
  for (std::size_t i = 0; i < polygon.size(); ++i) points.push_back({polygon[i], area, static_cast<int>(i)});
  return points;
}

/// The triangle rule applied to the triangles (centroid, corner i, corner i + 1).
std::vector<PatchPoint> fan_about_centroid(std::span<const Vec2> polygon) {
  const std::size_t n = polygon.size();
  const Vec2 centroid = polygon_centroid(polygon);
  std::vector<PatchPoint> points = corners_with_area(polygon, 0.0);
  PatchPoint center{centroid, 0.0, -1};
  std::vector<PatchPoint> inner;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    const Vec2 triangle[] = {centroid, polygon[i], polygon[next]};
    const double area = polygon_area(triangle);
    points[i].area += area / 12.0;
    points[next].area += area / 12.0;
    center.area += area / 12.0;
    inner.push_back({(triangle[0] + triangle[1] + triangle[2]) / 3.0, 0.75 * area, -2 - static_cast<int>(i)});
  }
  points.push_back(center);
  points.insert(points.end(), inner.begin(), inner.end());
  return points;
}

}  // namespace

std::vector<PatchPoint> corner_points(std::span<const Vec2> polygon) {
  return corners_with_area(polygon, polygon_area(polygon) / static_cast<double>(polygon.size()));
}

std::vector<PatchPoint> quadrature_points(std::span<const Vec2> polygon) {
  const bool triangle = polygon.size() == 3;
  if (!triangle && !is_parallelogram(polygon)) return fan_about_centroid(polygon);
  const double area = polygon_area(polygon);
  std::vector<PatchPoint> points = corners_with_area(polygon, area / 12.0);
  points.push_back({polygon_centroid(polygon), triangle ? 0.75 * area : area / 1.5, -1});
  return points;
}

std::vector<PatchPoint> patch_points(std::span<const Vec2> polygon, PatchPoints kind) {
  return kind == PatchPoints::corners ? corner_points(polygon) : quadrature_points(polygon);
}

}  // namespace cupola
