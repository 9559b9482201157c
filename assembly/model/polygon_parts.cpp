#include "assembly/model/polygon_parts.hpp"

#include <algorithm>
#include <cmath>

namespace cupola {
namespace {

using Polygon = std::vector<Vec3>;

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

}  // namespace

std::vector<PlanePolygon> faces_of_block(const Assembly& assembly, int block) {
  std::vector<PlanePolygon> faces;
  const std::vector<Part>& parts = assembly.parts;
  for (auto part = std::ranges::lower_bound(parts, block, {}, &Part::block);
       part != parts.end() && part->block == block; ++part)
    for (int f = part->face_start; f < part->face_start + part->num_faces; ++f)
      faces.emplace_back(face_points(assembly, f));
  return faces;
}

DividedPolygon divide(const std::vector<Vec3>& polygon, const PlanePolygon& other, double tolerance) {
  DividedPolygon parts;
  parts.inside = polygon;
  for (size_t i = 0; i < other.corners.size() && !parts.inside.empty(); ++i) {
    const Vec3 edge = other.corners[(i + 1) % other.corners.size()] - other.corners[i];
    const Vec3 outward = edge.cross(other.plane.normal).normalized();
    auto [beyond, before] = split(parts.inside, {outward, outward.dot(other.corners[i])}, tolerance);
    if (!beyond.empty()) parts.outside.push_back(std::move(beyond));
    parts.inside = std::move(before);
  }
  if (parts.inside.empty()) parts.outside = {polygon};
  return parts;
}

std::vector<std::vector<Vec3>> uncovered(const PlanePolygon& face, std::span<const PlanePolygon> others,
                                         double tolerance) {
  constexpr double kParallel = 1e-9;  // cosine
  std::vector<Polygon> pieces{face.corners};
  for (const PlanePolygon& other : others) {
    if (face.plane.normal.dot(other.plane.normal) > kParallel - 1.0 ||
        std::abs(face.plane.offset + other.plane.offset) > tolerance)
      continue;
    std::vector<Polygon> left;
    for (const Polygon& piece : pieces)
      for (Polygon& rest : divide(piece, other, tolerance).outside) left.push_back(std::move(rest));
    pieces = std::move(left);
  }
  return pieces;
}

}  // namespace cupola
