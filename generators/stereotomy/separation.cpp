#include "generators/stereotomy/separation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "assembly/base/error.hpp"
#include "assembly/model/polygon_parts.hpp"

namespace cupola {
namespace {

constexpr double kParallel = 1e-9;  // sine below which two directions count as one axis

double highest(std::span<const Vec3> points, const Vec3& axis) {
  double value = -std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) value = std::max(value, axis.dot(p));
  return value;
}

/// Depth to which B extends below a face plane of A, m.
double depth_below(const Plane& plane, const ConvexShape& b) {
  return plane.offset + highest(b.vertices, -plane.normal);
}

/// Overlap of the projections on a unit axis, m, for B on either side.
double depth_on_axis(std::span<const Vec3> a, std::span<const Vec3> b, const Vec3& axis) {
  return std::min(highest(a, axis) + highest(b, -axis), highest(b, axis) + highest(a, -axis));
}

}  // namespace

ConvexShape convex_shape(const Assembly& assembly, const Part& part) {
  ConvexShape shape;
  std::vector<int> vertex_ids;
  for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
    const std::vector<Vec3> corners = face_points(assembly, f);
    shape.planes.push_back(polygon_plane(corners));
    CUPOLA_ASSERT(std::abs(shape.planes.back().normal.norm() - 1.0) < 1e-12);
    shape.faces.push_back(f);
    const auto ids = assembly.face(f);
    vertex_ids.insert(vertex_ids.end(), ids.begin(), ids.end());
    for (size_t i = 0; i < corners.size(); ++i) {
      const Vec3 edge = (corners[(i + 1) % corners.size()] - corners[i]).normalized();
      const bool known = std::ranges::any_of(shape.edge_directions,
                                             [&](const Vec3& d) { return d.cross(edge).norm() < kParallel; });
      if (!known) shape.edge_directions.push_back(edge);
    }
  }
  std::ranges::sort(vertex_ids);
  vertex_ids.erase(std::unique(vertex_ids.begin(), vertex_ids.end()), vertex_ids.end());
  for (int v : vertex_ids) shape.vertices.push_back(assembly.vertices[v]);
  return shape;
}

double overlap_depth(const ConvexShape& a, const ConvexShape& b, double good_enough) {
  double depth = std::numeric_limits<double>::infinity();
  for (const auto& [shape, other] : {std::pair(&a, &b), std::pair(&b, &a)})
    for (const Plane& plane : shape->planes) {
      depth = std::min(depth, depth_below(plane, *other));
      if (depth <= good_enough) return depth;
    }
  for (const Vec3& edge_a : a.edge_directions)
    for (const Vec3& edge_b : b.edge_directions) {
      const Vec3 axis = edge_a.cross(edge_b);
      const double length = axis.norm();
      if (length < kParallel) continue;
      depth = std::min(depth, depth_on_axis(a.vertices, b.vertices, axis / length));
      if (depth <= good_enough) return depth;
    }
  return depth;
}

double overlap_width(std::span<const Vec3> a, std::span<const Vec3> b, const Vec3& normal) {
  double width = std::numeric_limits<double>::infinity();
  for (const std::span<const Vec3> polygon : {a, b})
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 axis = (polygon[(i + 1) % polygon.size()] - polygon[i]).cross(normal);
      const double length = axis.norm();
      if (length == 0.0) continue;  // a corner that is there twice
      width = std::min(width, depth_on_axis(a, b, axis / length));
      if (width <= 0.0) return width;
    }
  return width;
}

double common_width(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  const std::vector<Vec3> common = divide(a, PlanePolygon(b), 0.0).inside;
  if (common.empty()) return 0.0;
  const Vec3 normal = polygon_plane(common).normal;
  double width = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < common.size(); ++i) {
    const Vec3 axis = (common[(i + 1) % common.size()] - common[i]).cross(normal);
    if (const double length = axis.norm(); length > 0.0)  // else a corner that is there twice
      width = std::min(width, highest(common, axis / length) + highest(common, -axis / length));
  }
  return width;
}

}  // namespace cupola
