#include "generators/importer/flatness.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace cupola {
namespace {

constexpr double kExact = 1e-6;        // rad, and times the block size: smaller deviations count as none
constexpr double kLargestTilt = 0.05;  // rad; of a curved surface, 126 chords per turn tilt by this
constexpr double kSafety = 3.0;        // two neighbouring faces tilt, and a facet has more than two
constexpr double kFacetWarp = 1.5;     // unevenness of a facet of several polygons over that of one

/// Largest distance between two corners of a facet, m.
double extent(const TriangleMesh& mesh, const Facet& facet) {
  double longest = 0.0;
  for (int s : facet.triangles)
    for (int t : facet.triangles)
      for (int i = 0; i < 3; ++i) longest = std::max(longest, (mesh.corner(s, 0) - mesh.corner(t, i)).norm());
  return longest;
}

/// Appends the angles (rad) between neighbouring polygons that are nearly in one plane.
void append_angles(const TriangleMesh& mesh, const std::vector<Facet>& polygons,
                   std::vector<double>* angles) {
  std::vector<int> polygon_of(mesh.triangles.size());
  for (size_t p = 0; p < polygons.size(); ++p)
    for (int t : polygons[p].triangles) polygon_of[t] = static_cast<int>(p);
  const auto neighbours = triangle_neighbours(mesh);
  for (size_t t = 0; t < neighbours.size(); ++t)
    for (int other : neighbours[t]) {
      if (other <= static_cast<int>(t) || polygon_of[other] == polygon_of[t]) continue;
      const Vec3 &a = polygons[polygon_of[t]].plane.normal, &b = polygons[polygon_of[other]].plane.normal;
      const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
      if (angle > kExact && angle < 2.0 * kLargestTilt) angles->push_back(angle);
    }
}

/// The least value >= `start` that no angle exceeds by less than a factor of two, if it is below
/// kLargestTilt; else `start`.
double below_a_gap(double start, std::vector<double> angles) {
  std::ranges::sort(angles);
  double value = start;
  for (const double angle : angles) {
    if (angle > 2.0 * value) break;
    value = std::max(value, 2.0 * angle);
  }
  return value < kLargestTilt ? value : start;
}

}  // namespace

Flatness measure_flatness(const std::vector<TriangleMesh>& meshes) {
  Flatness flatness;
  double tilt = 0.0;
  std::vector<double> angles;
  for (const TriangleMesh& mesh : meshes) {
    const double size = mesh_size(mesh);
    std::vector<Facet> polygons;
    for (std::vector<int>& triangles : triangles_of_polygons(mesh)) {
      const Facet& polygon = polygons.emplace_back(mean_facet(mesh, std::move(triangles)));
      if (polygon.triangles.size() == 1) continue;
      const double warp = unevenness(mesh, polygon);
      const double own_tilt = warp * extent(mesh, polygon) / polygon.area;
      if (own_tilt > kLargestTilt) {
        ++flatness.bent;
        continue;
      }
      tilt = std::max(tilt, own_tilt);
      flatness.warp = std::max(flatness.warp, warp);
      flatness.relative_warp = std::max(flatness.relative_warp, warp / size);
    }
    append_angles(mesh, polygons, &angles);
  }
  const double of_polygons = std::clamp(kSafety * tilt, kExact, kLargestTilt);
  flatness.facet_angle = below_a_gap(of_polygons, std::move(angles));
  flatness.flat = std::max(kExact, kFacetWarp * flatness.relative_warp);
  if (flatness.facet_angle == of_polygons) return flatness;
  flatness.flat = std::max(flatness.flat, flatness.facet_angle);
  for (const TriangleMesh& mesh : meshes) {
    std::vector<int> facet_of;
    const double size = mesh_size(mesh);
    const double warp =
        unevenness(mesh, find_facets(mesh, flatness.facet_angle, flatness.flat * size, &facet_of));
    flatness.warp = std::max(flatness.warp, warp);
    flatness.relative_warp = std::max(flatness.relative_warp, warp / size);
  }
  return flatness;
}

}  // namespace cupola
