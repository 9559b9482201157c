#include "solver/collision/inset.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace cupola {
namespace {

bool inside_all(std::span<const Plane> planes, double inset, const Vec3& x, double tolerance) {
  return std::all_of(planes.begin(), planes.end(), [&](const Plane& plane) {
    return plane.normal.dot(x) <= plane.offset - inset + tolerance;
  });
}

void add_vertex(const Vec3& x, double tolerance, std::vector<Vec3>* vertices) {
  const bool known = std::any_of(vertices->begin(), vertices->end(),
                                 [&](const Vec3& y) { return (y - x).norm() <= tolerance; });
  if (!known) vertices->push_back(x);
}

/// Vertices on a plane, counter-clockwise about its normal.
std::vector<int> face_of(const Plane& plane, double inset, const std::vector<Vec3>& vertices,
                         double tolerance) {
  std::vector<int> ids;
  Vec3 center = Vec3::Zero();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (std::abs(plane.normal.dot(vertices[i]) - plane.offset + inset) > tolerance) continue;
    ids.push_back(static_cast<int>(i));
    center += vertices[i];
  }
  if (ids.size() < 3) return {};
  center /= static_cast<double>(ids.size());
  const Vec3 u = (vertices[ids[0]] - center).normalized();
  const Vec3 v = plane.normal.cross(u);
  const auto angle = [&](int i) {
    const Vec3 r = vertices[i] - center;
    return std::atan2(v.dot(r), u.dot(r));
  };
  std::sort(ids.begin(), ids.end(), [&](int i, int k) { return angle(i) < angle(k); });
  return ids;
}

}  // namespace

Polytope inset_polytope(std::span<const Plane> planes, double inset, double tolerance) {
  constexpr double kParallel = 1e-9;  // determinant below which three planes have no common point
  Polytope polytope;
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = i + 1; j < planes.size(); ++j)
      for (std::size_t k = j + 1; k < planes.size(); ++k) {
        Mat3 normals;
        normals << planes[i].normal.transpose(), planes[j].normal.transpose(), planes[k].normal.transpose();
        if (std::abs(normals.determinant()) < kParallel) continue;
        const Vec3 offsets(planes[i].offset - inset, planes[j].offset - inset, planes[k].offset - inset);
        const Vec3 x = normals.partialPivLu().solve(offsets);
        if (inside_all(planes, inset, x, tolerance)) add_vertex(x, tolerance, &polytope.vertices);
      }
  for (const Plane& plane : planes) {
    std::vector<int> face = face_of(plane, inset, polytope.vertices, tolerance);
    if (!face.empty()) polytope.faces.push_back(std::move(face));
  }
  if (polytope.vertices.size() < 4 || polytope.faces.size() < 4) return {};
  return polytope;
}

}  // namespace cupola
