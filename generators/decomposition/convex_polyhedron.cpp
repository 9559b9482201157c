#include "generators/decomposition/convex_polyhedron.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Geometry>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

ConvexPolyhedron with_planes(std::vector<Vec3> vertices, std::vector<std::vector<int>> faces) {
  ConvexPolyhedron solid{std::move(vertices), std::move(faces), {}};
  for (const auto& face : solid.faces) {
    std::vector<Vec3> corners;
    for (int v : face) corners.push_back(solid.vertices[v]);
    solid.planes.push_back(polygon_plane(corners));
  }
  return solid;
}

/// Loop of the new face in the cutting plane: its vertices sorted by angle about their mean.
std::vector<int> cap_loop(const std::vector<Vec3>& vertices, std::vector<int> ids, const Vec3& normal) {
  Vec3 center = Vec3::Zero();
  for (int v : ids) center += vertices[v] / static_cast<double>(ids.size());
  const Vec3 x = normal.unitOrthogonal();
  const Vec3 y = normal.cross(x);
  const auto angle = [&](int v) {
    return std::atan2(y.dot(vertices[v] - center), x.dot(vertices[v] - center));
  };
  std::ranges::sort(ids, {}, angle);
  return ids;
}

ConvexPolyhedron without_unused_vertices(const ConvexPolyhedron& solid) {
  ConvexPolyhedron result;
  result.planes = solid.planes;
  std::vector<int> new_id(solid.vertices.size(), -1);
  for (const auto& face : solid.faces) {
    result.faces.emplace_back();
    for (int v : face) {
      if (new_id[v] < 0) {
        new_id[v] = static_cast<int>(result.vertices.size());
        result.vertices.push_back(solid.vertices[v]);
      }
      result.faces.back().push_back(new_id[v]);
    }
  }
  return result;
}

}  // namespace

ConvexPolyhedron box_polyhedron(const Vec3& low, const Vec3& high) {
  std::vector<Vec3> v;
  for (int i = 0; i < 8; ++i)
    v.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(), i & 4 ? high.z() : low.z());
  return with_planes(v, {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}});
}

ConvexPolyhedron tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const bool positive = (b - a).cross(c - a).dot(d - a) > 0.0;
  return positive ? with_planes({a, b, c, d}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
                  : with_planes({a, c, b, d}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
}

ConvexPolyhedron clip(const ConvexPolyhedron& solid, const Plane& plane, double tolerance) {
  CUPOLA_ASSERT(std::abs(plane.normal.norm() - 1.0) < 1e-9);
  std::vector<double> height;  // of the vertices above the plane
  bool any_inside = false, any_outside = false;
  for (const Vec3& v : solid.vertices) {
    double h = plane.normal.dot(v) - plane.offset;
    if (std::abs(h) <= tolerance) h = 0.0;
    any_inside = any_inside || h < 0.0;
    any_outside = any_outside || h > 0.0;
    height.push_back(h);
  }
  if (!any_outside) return solid;
  if (!any_inside) return {};

  ConvexPolyhedron result;
  result.vertices = solid.vertices;
  std::map<std::pair<int, int>, int> crossing;  // edge -> new vertex on it
  std::vector<int> cap;
  for (size_t f = 0; f < solid.faces.size(); ++f) {
    const auto& face = solid.faces[f];
    std::vector<int> loop;
    for (size_t i = 0; i < face.size(); ++i) {
      const int a = face[i], b = face[(i + 1) % face.size()];
      if (height[a] <= 0.0) loop.push_back(a);
      if (height[a] * height[b] >= 0.0) continue;
      const auto [it, is_new] =
          crossing.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(result.vertices.size()));
      if (is_new) {
        const Vec3& p = solid.vertices[it->first.first];
        const Vec3& q = solid.vertices[it->first.second];
        const double hp = height[it->first.first], hq = height[it->first.second];
        result.vertices.push_back(p + hp / (hp - hq) * (q - p));
      }
      loop.push_back(it->second);
    }
    const bool flat = std::ranges::all_of(loop, [&](int v) {
      return v >= static_cast<int>(height.size()) || height[v] == 0.0;  // in the cutting plane
    });
    if (loop.size() < 3 || flat) continue;
    result.faces.push_back(loop);
    result.planes.push_back(solid.planes[f]);
    for (int v : loop)
      if (v >= static_cast<int>(height.size()) || height[v] == 0.0) cap.push_back(v);
  }
  std::ranges::sort(cap);
  cap.erase(std::unique(cap.begin(), cap.end()), cap.end());
  if (cap.size() >= 3) {
    result.faces.push_back(cap_loop(result.vertices, cap, plane.normal));
    result.planes.push_back(plane);
  }
  return without_unused_vertices(result);
}

double polyhedron_volume(const ConvexPolyhedron& solid) {
  double six_volumes = 0.0;
  for (const auto& face : solid.faces)
    for (size_t i = 2; i < face.size(); ++i) {
      const Vec3& origin = solid.vertices.front();
      six_volumes += (solid.vertices[face[0]] - origin)
                         .dot((solid.vertices[face[i - 1]] - origin).cross(solid.vertices[face[i]] - origin));
    }
  return six_volumes / 6.0;
}

Vec3 vertex_mean(const ConvexPolyhedron& solid) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& v : solid.vertices) sum += v;
  return sum / static_cast<double>(solid.vertices.size());
}

}  // namespace cupola
