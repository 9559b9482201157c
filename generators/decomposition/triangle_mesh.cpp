#include "generators/decomposition/triangle_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

using Edge = std::pair<int, int>;  // directed, in the sense of its triangle

/// Triangle on the left of each directed edge.
std::map<Edge, int> edge_map(const TriangleMesh& mesh) {
  std::map<Edge, int> left;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    for (int i = 0; i < 3; ++i) left[{mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]}] = t;
  return left;
}

/// Outward normal times the area, m2.
Vec3 area_vector(const TriangleMesh& mesh, int t) {
  return 0.5 * (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0));
}

/// Connected triangles that a facet contains all or none of.
struct Patches {
  std::vector<Facet> patches;
  std::vector<int> of_triangle;
};

Patches flat_patches(const TriangleMesh& mesh, double distance) {
  Patches found;
  found.of_triangle.assign(mesh.triangles.size(), -1);
  const auto append = [&](Facet patch) {
    for (int t : patch.triangles) found.of_triangle[t] = static_cast<int>(found.patches.size());
    found.patches.push_back(std::move(patch));
  };
  for (std::vector<int>& triangles : triangles_of_polygons(mesh)) {
    Facet patch = mean_facet(mesh, triangles);
    if (triangles.size() == 1 || unevenness(mesh, patch) <= distance)
      append(std::move(patch));
    else
      for (int t : triangles) append(mean_facet(mesh, {t}));
  }
  return found;
}

/// The facet that contains the patch `seed`, found by a flood fill.
Facet grow(const TriangleMesh& mesh, const std::map<Edge, int>& left, const Patches& patches, int seed,
           double angle, double distance, int id, std::vector<int>* facet_of) {
  const Vec3 normal = patches.patches[seed].plane.normal;
  std::vector<int> open;
  Facet facet;
  const auto take = [&](int patch) {
    for (int t : patches.patches[patch].triangles) (*facet_of)[t] = id;
    std::ranges::copy(patches.patches[patch].triangles, std::back_inserter(open));
  };
  facet = patches.patches[seed];
  take(seed);
  while (!open.empty()) {
    const int t = open.back();
    open.pop_back();
    for (int i = 0; i < 3; ++i) {
      const auto across = left.find({mesh.triangles[t][(i + 1) % 3], mesh.triangles[t][i]});
      if (across == left.end() || (*facet_of)[across->second] >= 0) continue;
      const int other = patches.of_triangle[across->second];
      const Vec3& n = patches.patches[other].plane.normal;
      if (n.dot(normal) <= 0.0 || n.cross(normal).norm() > angle) continue;
      std::vector<int> triangles = facet.triangles;
      std::ranges::copy(patches.patches[other].triangles, std::back_inserter(triangles));
      Facet larger = mean_facet(mesh, std::move(triangles));
      if (unevenness(mesh, larger) > distance) continue;
      facet = std::move(larger);
      take(other);
    }
  }
  std::ranges::sort(facet.triangles);
  return facet;
}

}  // namespace

double mesh_volume(const TriangleMesh& mesh) {
  double six_volumes = 0.0;
  const Vec3& origin = mesh.vertices.front();
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    six_volumes +=
        (mesh.corner(t, 0) - origin).dot((mesh.corner(t, 1) - origin).cross(mesh.corner(t, 2) - origin));
  return six_volumes / 6.0;
}

double mesh_size(const TriangleMesh& mesh) {
  Vec3 low = mesh.vertices.front(), high = low;
  for (const Vec3& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return (high - low).maxCoeff();
}

std::vector<std::vector<int>> triangles_of_polygons(const TriangleMesh& mesh) {
  CUPOLA_ASSERT(mesh.polygons.empty() || mesh.polygons.size() == mesh.triangles.size());
  std::vector<std::vector<int>> groups;
  std::map<int, size_t> group_of;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const int polygon = mesh.polygons.empty() ? -1 : mesh.polygons[t];
    const size_t group =
        polygon < 0 ? groups.size() : group_of.try_emplace(polygon, groups.size()).first->second;
    if (group == groups.size()) groups.emplace_back();
    groups[group].push_back(t);
  }
  return groups;
}

Facet mean_facet(const TriangleMesh& mesh, std::vector<int> triangles) {
  Facet facet;
  Vec3 sum = Vec3::Zero(), weighted_centroid = Vec3::Zero();
  for (int t : triangles) {
    const Vec3 area = area_vector(mesh, t);
    sum += area;
    weighted_centroid += area.norm() * (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
    facet.area += area.norm();
  }
  facet.plane.normal = sum.normalized();
  facet.plane.offset = facet.plane.normal.dot(weighted_centroid / facet.area);
  facet.triangles = std::move(triangles);
  return facet;
}

double unevenness(const TriangleMesh& mesh, const Facet& facet) {
  double largest = 0.0;
  for (int t : facet.triangles)
    for (int i = 0; i < 3; ++i)
      largest = std::max(largest, std::abs(facet.plane.normal.dot(mesh.corner(t, i)) - facet.plane.offset));
  return largest;
}

std::vector<Facet> find_facets(const TriangleMesh& mesh, double angle, double distance,
                               std::vector<int>* facet_of) {
  const std::map<Edge, int> left = edge_map(mesh);
  const Patches patches = flat_patches(mesh, distance);
  std::vector<int> by_area(patches.patches.size());
  std::iota(by_area.begin(), by_area.end(), 0);
  std::ranges::stable_sort(by_area,
                           [&](int a, int b) { return patches.patches[a].area > patches.patches[b].area; });
  facet_of->assign(mesh.triangles.size(), -1);
  std::vector<Facet> facets;
  for (int seed : by_area)
    if ((*facet_of)[patches.patches[seed].triangles.front()] < 0)
      facets.push_back(
          grow(mesh, left, patches, seed, angle, distance, static_cast<int>(facets.size()), facet_of));
  return facets;
}

std::vector<std::array<int, 3>> triangle_neighbours(const TriangleMesh& mesh) {
  const std::map<Edge, int> left = edge_map(mesh);
  std::vector<std::array<int, 3>> neighbours(mesh.triangles.size());
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto across = left.find({mesh.triangles[t][(i + 1) % 3], mesh.triangles[t][i]});
      neighbours[t].at(i) = across == left.end() ? -1 : across->second;
    }
  return neighbours;
}

double unevenness(const TriangleMesh& mesh, const std::vector<Facet>& facets) {
  double largest = 0.0;
  for (const Facet& facet : facets) largest = std::max(largest, unevenness(mesh, facet));
  return largest;
}

std::vector<int> facet_loop(const TriangleMesh& mesh, const Facet& facet) {
  std::map<Edge, bool> edges;
  for (int t : facet.triangles)
    for (int i = 0; i < 3; ++i) edges[{mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]}] = true;
  std::map<int, int> next;
  size_t num_border = 0;
  for (const auto& [edge, unused] : edges) {
    if (edges.contains({edge.second, edge.first})) continue;
    next[edge.first] = edge.second;
    ++num_border;
  }
  if (next.size() != num_border || next.empty()) return {};
  std::vector<int> loop;
  for (int v = next.begin()->first; loop.empty() || v != loop.front(); v = next.at(v)) {
    loop.push_back(v);
    if (loop.size() > num_border) return {};
  }
  if (loop.size() != num_border) return {};
  std::map<int, int> num_triangles;
  for (int t : facet.triangles)
    for (int v : mesh.triangles[t]) ++num_triangles[v];
  const auto busiest = std::ranges::max_element(loop, {}, [&](int v) { return num_triangles[v]; });
  std::rotate(loop.begin(), busiest, loop.end());
  return loop;
}

std::vector<ReflexEdge> find_reflex_edges(const TriangleMesh& mesh, const std::vector<Facet>& facets,
                                          const std::vector<int>& facet_of, double angle) {
  struct Piece {
    int a, b;  // vertices
  };
  std::map<std::pair<int, int>, std::vector<Piece>> pieces;  // pair of facets -> edges between them
  const std::map<Edge, int> left = edge_map(mesh);
  for (const auto& [edge, t] : left) {
    const auto across = left.find({edge.second, edge.first});
    if (edge.first > edge.second || across == left.end()) continue;
    const int fa = facet_of[t], fb = facet_of[across->second];
    if (fa == fb) continue;
    const Vec3 direction = (mesh.vertices[edge.second] - mesh.vertices[edge.first]).normalized();
    // Facet a lies on the left of the edge seen from outside: the edge is convex if n_a x n_b points along
    // it.
    const double sine = facets[fa].plane.normal.cross(facets[fb].plane.normal).dot(direction);
    if (sine < -angle) pieces[{fa, fb}].push_back({edge.first, edge.second});
  }
  std::vector<ReflexEdge> edges;
  for (const auto& [pair, list] : pieces) {
    const Vec3 origin = mesh.vertices[list.front().a];
    const Vec3 direction = (mesh.vertices[list.front().b] - origin).normalized();
    std::vector<std::pair<double, double>> spans;
    for (const Piece& piece : list) {
      const double x = direction.dot(mesh.vertices[piece.a] - origin),
                   y = direction.dot(mesh.vertices[piece.b] - origin);
      spans.emplace_back(std::min(x, y), std::max(x, y));
    }
    std::ranges::sort(spans);
    for (size_t i = 0; i < spans.size();) {
      auto [start, end] = spans[i];
      for (++i; i < spans.size() && spans[i].first <= end + 1e-9 * (1.0 + std::abs(end)); ++i)
        end = std::max(end, spans[i].second);
      edges.push_back({origin + start * direction, origin + end * direction, pair.first, pair.second});
    }
  }
  return edges;
}

double winding_number(const TriangleMesh& mesh, const Vec3& point) {
  double solid_angle = 0.0;  // van Oosterom and Strackee 1983
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const Vec3 a = mesh.corner(t, 0) - point, b = mesh.corner(t, 1) - point, c = mesh.corner(t, 2) - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    const double numerator = a.dot(b.cross(c));
    const double denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    solid_angle += 2.0 * std::atan2(numerator, denominator);
  }
  return solid_angle / (4.0 * std::numbers::pi);
}

}  // namespace cupola
