#include "solver/analysis/admissible/joint_extent.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/analysis/admissible/joint_geometry.hpp"

namespace cupola {
namespace {

/// The plane of a face, through a point.
struct FacePlane {
  Vec3 origin, u, v;
  Vec2 project(const Vec3& x) const { return {u.dot(x - origin), v.dot(x - origin)}; }
};

Vec3 middle_of(const Contact& point) {
  return 0.5 * (point.point_a + point.point_b);
}

/// The hull of points; of points on a line its two ends.
std::vector<Vec2> hull_of(const std::vector<Vec2>& points, double tolerance) {
  std::vector<Vec2> hull;
  for (const int i : convex_hull(points, tolerance)) hull.push_back(points[i]);
  if (!hull.empty()) return hull;
  const auto [first, last] =
      std::ranges::minmax_element(points, {}, [](const Vec2& x) { return std::pair(x.x(), x.y()); });
  return {*first, *last};
}

/// Corners of what a convex polygon, or a line, shares with another polygon.
std::vector<Vec2> shared(std::vector<Vec2> polygon, const std::vector<Vec2>& border, double tolerance) {
  for (size_t i = 0; i < border.size(); ++i) {
    const Vec2 along = (border[(i + 1) % border.size()] - border[i]).normalized();
    const auto height = [&](const Vec2& x) {
      return along.x() * (x.y() - border[i].y()) - along.y() * (x.x() - border[i].x());
    };
    std::vector<Vec2> kept;
    for (size_t k = 0; k < polygon.size(); ++k) {
      const Vec2 &start = polygon[k], &end = polygon[(k + 1) % polygon.size()];
      const double from = height(start), to = height(end);
      if (from >= -tolerance) kept.push_back(start);
      if ((from >= -tolerance) != (to >= -tolerance))
        kept.push_back(start + std::clamp(from / (from - to), 0.0, 1.0) * (end - start));
    }
    polygon = std::move(kept);
  }
  std::vector<Vec2> corners;
  for (const Vec2& x : polygon)
    if (std::ranges::none_of(corners, [&](const Vec2& y) { return (x - y).norm() <= tolerance; }))
      corners.push_back(x);
  return corners;
}

/// The points of a face that is open in part, `closed` before, at a reduced extent about `centroid`.
std::vector<Contact> reduced(const Patch& face, const std::vector<Contact>& closed, const Vec3& centroid,
                             double extent, const PatchSampling& sampling) {
  constexpr double kRounding = 1e-9;  // of the size of a face: rounding of its corners
  FacePlane plane{centroid, Vec3::Zero(), Vec3::Zero()};
  Vec3 normal = Vec3::Zero();
  for (const Contact& point : closed) normal += point.normal;
  normal.normalize();
  plane.u = normal.unitOrthogonal();
  plane.v = normal.cross(plane.u);

  std::vector<Vec2> border, points;
  for (const Vec3& x : face.polygon) border.push_back(extent * plane.project(x));
  for (const Contact& point : closed) points.push_back(plane.project(middle_of(point)));
  const double tolerance = kRounding * std::sqrt(face.area);
  const std::vector<Vec2> part = shared(hull_of(points, tolerance), border, tolerance);
  std::vector<PatchPoint> places;
  if (part.size() > 2) {
    places = patch_points(part, sampling);
  } else {  // a plane scene, or a closed part without area
    double area = 0.0;
    for (const Contact& point : closed) area += extent * extent * point.area;
    for (size_t i = 0; i < part.size(); ++i)
      places.push_back({part[i], area / static_cast<double>(part.size()), static_cast<int>(i)});
  }
  std::vector<Contact> out;
  for (const PatchPoint& place : places) {
    const auto distance = [&](const Vec2& x) { return (x - place.position).norm(); };
    const auto nearest = std::ranges::min_element(points, {}, distance) - points.begin();
    Contact point = closed[nearest];
    const Vec2 by = place.position - points[nearest];
    for (Vec3* x : {&point.point_a, &point.point_b}) *x += by.x() * plane.u + by.y() * plane.v;
    point.area = place.area;
    point.id.corner = place.corner;
    out.push_back(point);
  }
  return out;
}

}  // namespace

bool scale_joints(const Assembly& assembly, double extent, const PatchSampling& sampling,
                  ContactSet* contacts) {
  constexpr double kWhole = 1.0 - 1e-9;  // of an area: rounding of its shares
  const JointGeometry joints(assembly, *contacts);
  std::vector<double> closed_area(contacts->patches.size(), 0.0);
  for (const Contact& point : contacts->points) closed_area[point.patch] += point.area;
  bool any_open = false;
  std::vector<Contact> scaled;
  for (size_t i = 0, end = 0; i < contacts->points.size(); i = end) {
    while (end < contacts->points.size() && contacts->points[end].patch == contacts->points[i].patch) ++end;
    const std::vector<Contact> closed(contacts->points.begin() + i, contacts->points.begin() + end);
    const Patch& face = contacts->patches[closed.front().patch];
    const Vec3& centroid = joints.pair(face.block_a, face.block_b).centroid;
    const bool open = closed_area[closed.front().patch] < kWhole * face.area;
    any_open = any_open || open;
    if (open && extent < 1.0) {
      for (const Contact& point : reduced(face, closed, centroid, extent, sampling)) scaled.push_back(point);
      continue;
    }
    for (Contact point : closed) {
      const Vec3 shift = (extent - 1.0) * (middle_of(point) - centroid);
      point.point_a += shift;
      point.point_b += shift;
      point.area *= extent * extent;
      scaled.push_back(point);
    }
  }
  contacts->points = std::move(scaled);
  return any_open;
}

}  // namespace cupola
