#include "assembly/export/block_union.hpp"

#include <algorithm>

#include <Eigen/Geometry>

namespace cupola {
namespace {

using Polygon = std::vector<Vec3>;

/// Of the size of the block: above the rounding of coordinates, below any edge of a block.
constexpr double kSamePlace = 1e-9;

/// The corners of an edge that end or begin other faces, from one end to the other, without the ends.
Polygon corners_between(const Vec3& p, const Vec3& q, const std::vector<Vec3>& corners, double tolerance) {
  const double length = (q - p).norm();
  const Vec3 along = (q - p) / length;
  std::vector<std::pair<double, Vec3>> found;
  for (const Vec3& corner : corners) {
    const double at = (corner - p).dot(along);
    if (at > tolerance && at < length - tolerance && (corner - p - at * along).norm() <= tolerance)
      found.emplace_back(at, corner);
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  Polygon between;
  for (const auto& [at, corner] : found)
    if (between.empty() || (corner - between.back()).norm() > tolerance) between.push_back(corner);
  return between;
}

}  // namespace

std::vector<std::vector<Vec3>> union_faces(const std::vector<PlanePolygon>& faces) {
  Eigen::AlignedBox<double, 3> box;
  for (const PlanePolygon& face : faces)
    for (const Vec3& p : face.corners) box.extend(p);
  const double tolerance = kSamePlace * box.diagonal().norm();
  std::vector<Polygon> outer;
  for (const PlanePolygon& face : faces)
    for (Polygon& piece : uncovered(face, faces, tolerance)) outer.push_back(std::move(piece));
  std::vector<Vec3> corners;
  for (const Polygon& polygon : outer) corners.insert(corners.end(), polygon.begin(), polygon.end());
  for (Polygon& polygon : outer) {
    Polygon divided;
    for (size_t i = 0; i < polygon.size(); ++i) {
      divided.push_back(polygon[i]);
      for (const Vec3& p : corners_between(polygon[i], polygon[(i + 1) % polygon.size()], corners, tolerance))
        divided.push_back(p);
    }
    polygon = std::move(divided);
  }
  return outer;
}

}  // namespace cupola
