#include "assembly/export/block_union.hpp"

#include <algorithm>

#include <Eigen/Geometry>

namespace cupola {
namespace {

using Polygon = std::vector<Vec3>;

/// Of the size of the block: above the rounding of coordinates, below any edge of a block.
constexpr double kSamePlace = 1e-9;

/// The parts of a convex polygon on both sides of a plane; empty where there is none.
std::pair<Polygon, Polygon> split(const Polygon& polygon, const Plane& plane, double tolerance) {
  std::pair<Polygon, Polygon> sides;  // beyond, before
  const auto height = [&](const Vec3& p) {
    const double h = plane.normal.dot(p) - plane.offset;
    return std::abs(h) <= tolerance ? 0.0 : h;
  };
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double a = height(p), b = height(q);
    if (a >= 0.0) sides.first.push_back(p);
    if (a <= 0.0) sides.second.push_back(p);
    if (a * b < 0.0) {
      const Vec3 crossing = p + a / (a - b) * (q - p);
      sides.first.push_back(crossing);
      sides.second.push_back(crossing);
    }
  }
  for (Polygon* side : {&sides.first, &sides.second})
    if (side->size() < 3 || polygon_area(*side) <= tolerance * tolerance) side->clear();
  return sides;
}

/// The pieces of a convex polygon outside another one in the same plane.
std::vector<Polygon> difference(const Polygon& polygon, const Polygon& other, double tolerance) {
  const Vec3 normal = polygon_plane(other).normal;
  std::vector<Polygon> pieces;
  Polygon inside = polygon;
  for (size_t i = 0; i < other.size() && !inside.empty(); ++i) {
    const Vec3 edge = other[(i + 1) % other.size()] - other[i];
    const Vec3 outward = edge.cross(normal).normalized();
    auto [beyond, before] = split(inside, {outward, outward.dot(other[i])}, tolerance);
    if (!beyond.empty()) pieces.push_back(std::move(beyond));
    inside = std::move(before);
  }
  if (inside.empty()) return {polygon};  // they do not overlap
  return pieces;
}

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

std::vector<std::vector<Vec3>> union_faces(const std::vector<PartFace>& faces) {
  Eigen::AlignedBox<double, 3> box;
  for (const PartFace& face : faces)
    for (const Vec3& p : face.corners) box.extend(p);
  const double tolerance = kSamePlace * box.diagonal().norm();
  std::vector<Polygon> outer;
  for (const PartFace& face : faces) {
    const Plane plane = polygon_plane(face.corners);
    std::vector<Polygon> pieces{face.corners};
    for (const PartFace& other : faces) {
      const Plane opposite = polygon_plane(other.corners);
      if (other.part == face.part || plane.normal.dot(opposite.normal) > kSamePlace - 1.0 ||
          std::abs(plane.offset + opposite.offset) > tolerance)
        continue;
      std::vector<Polygon> left;
      for (const Polygon& piece : pieces)
        for (Polygon& rest : difference(piece, other.corners, tolerance)) left.push_back(std::move(rest));
      pieces = std::move(left);
    }
    for (Polygon& piece : pieces) outer.push_back(std::move(piece));
  }
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
