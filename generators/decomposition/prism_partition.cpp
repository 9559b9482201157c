#include "generators/decomposition/prism_partition.hpp"

#include <algorithm>
#include <cmath>
#include <list>
#include <map>
#include <optional>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Partition_traits_2.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/partition_2.h>
#include <CGAL/property_map.h>
#include <Eigen/Geometry>

namespace cupola {
namespace {

using InexactKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = InexactKernel::Point_2;
using Traits = CGAL::Partition_traits_2<InexactKernel, CGAL::Pointer_property_map<Point2>::const_type>;

constexpr size_t kMostForOptimum =
    150;  // corners; the time of the optimal partition grows with their fourth power

/// Two opposite facets to which all others are perpendicular.
struct Caps {
  int lower, upper;
};

std::optional<Caps> find_caps(const std::vector<Facet>& facets, double angle) {
  const int n = static_cast<int>(facets.size());
  for (int i = 0; i < n; ++i) {
    const Vec3& axis = facets[i].plane.normal;
    int opposite = -1, others = 0;
    for (int j = 0; j < n; ++j) {
      const double cosine = facets[j].plane.normal.dot(axis);
      if (j != i && std::abs(cosine) <= angle)
        ++others;
      else if (j != i && cosine < 0.0 && facets[j].plane.normal.cross(axis).norm() <= angle)
        opposite = opposite < 0 ? j : n;
    }
    if (opposite >= 0 && opposite < n && others == n - 2) return Caps{i, opposite};
  }
  return std::nullopt;
}

/// Points of a cap's boundary where the side facet changes, counter-clockwise seen from outside.
std::vector<Vec3> cap_corners(const TriangleMesh& mesh, const std::vector<Facet>& facets,
                              const std::vector<int>& facet_of, int cap) {
  std::map<std::pair<int, int>, int> side;  // directed edge outside the cap -> its facet
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i)
      if (facet_of[t] != cap) side[{mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]}] = facet_of[t];
  const std::vector<int> loop = facet_loop(mesh, facets[cap]);
  std::vector<Vec3> corners;
  for (size_t i = 0; i < loop.size(); ++i) {
    const int before = loop[(i + loop.size() - 1) % loop.size()], after = loop[(i + 1) % loop.size()];
    if (side.at({loop[i], before}) != side.at({after, loop[i]})) corners.push_back(mesh.vertices[loop[i]]);
  }
  return corners;
}

/// Corners of the lower cap and, in the same order, those of the upper one nearest to being above them.
struct CrossSection {
  std::vector<Vec3> lower, upper;
};

std::optional<CrossSection> cross_section(const TriangleMesh& mesh, const std::vector<Facet>& facets,
                                          const std::vector<int>& facet_of, const Caps& caps) {
  std::vector<Vec3> lower = cap_corners(mesh, facets, facet_of, caps.lower);
  std::vector<Vec3> upper = cap_corners(mesh, facets, facet_of, caps.upper);
  if (lower.size() < 3 || lower.size() != upper.size()) return std::nullopt;
  std::ranges::reverse(lower);  // counter-clockwise seen from above, like `upper`
  const Vec3& axis = facets[caps.upper].plane.normal;
  const auto aside = [&](const Vec3& p) { return Vec3(p - axis.dot(p) * axis); };
  const auto nearest =
      std::ranges::min_element(upper, {}, [&](const Vec3& p) { return (aside(p) - aside(lower[0])).norm(); });
  std::rotate(upper.begin(), nearest, upper.end());
  const double low = -facets[caps.lower].plane.offset, high = facets[caps.upper].plane.offset;
  CrossSection section;
  for (size_t i = 0; i < lower.size(); ++i) {
    const Vec3 mean = aside(0.5 * (lower[i] + upper[i]));
    section.lower.push_back(mean + low * axis);
    section.upper.push_back(mean + high * axis);
  }
  return section;
}

/// Convex pieces of a counter-clockwise polygon as indices of its corners; none if the polygon intersects
/// itself.
std::vector<std::vector<int>> convex_pieces(const std::vector<Point2>& corners) {
  if (!CGAL::is_simple_2(corners.begin(), corners.end(), InexactKernel())) return {};
  if (CGAL::orientation_2(corners.begin(), corners.end(), InexactKernel()) != CGAL::COUNTERCLOCKWISE)
    return {};
  std::list<std::size_t> numbers;
  for (size_t i = 0; i < corners.size(); ++i) numbers.push_back(i);
  const Traits traits(CGAL::make_property_map(corners));
  std::list<Traits::Polygon_2> pieces;
  if (corners.size() <= kMostForOptimum)
    CGAL::optimal_convex_partition_2(numbers.begin(), numbers.end(), std::back_inserter(pieces), traits);
  else
    CGAL::approx_convex_partition_2(numbers.begin(), numbers.end(), std::back_inserter(pieces), traits);
  std::vector<std::vector<int>> result;
  for (const auto& piece : pieces) result.emplace_back(piece.vertices_begin(), piece.vertices_end());
  return result;
}

ConvexPolyhedron prism_over(const std::vector<int>& piece, const CrossSection& section) {
  ConvexPolyhedron prism;
  const int n = static_cast<int>(piece.size());
  for (const auto* corners : {&section.lower, &section.upper})
    for (int c : piece) prism.vertices.push_back((*corners)[c]);
  prism.faces.resize(2);
  for (int i = 0; i < n; ++i) {
    prism.faces[0].push_back(n - 1 - i);
    prism.faces[1].push_back(n + i);
    prism.faces.push_back({i, (i + 1) % n, (i + 1) % n + n, i + n});
  }
  for (const auto& face : prism.faces) {
    std::vector<Vec3> points;
    for (int v : face) points.push_back(prism.vertices[v]);
    prism.planes.push_back(polygon_plane(points));
  }
  return prism;
}

}  // namespace

std::vector<ConvexPolyhedron> partition_prism(const TriangleMesh& mesh, const std::vector<Facet>& facets,
                                              const std::vector<int>& facet_of, double angle) {
  const std::optional<Caps> caps = find_caps(facets, angle);
  if (!caps) return {};
  const std::optional<CrossSection> section = cross_section(mesh, facets, facet_of, *caps);
  if (!section) return {};
  const Vec3 axis = facets[caps->upper].plane.normal;
  const Vec3 x = axis.unitOrthogonal(), y = axis.cross(x);
  std::vector<Point2> corners;
  for (const Vec3& p : section->lower) corners.emplace_back(x.dot(p), y.dot(p));
  std::vector<ConvexPolyhedron> parts;
  for (const auto& piece : convex_pieces(corners)) parts.push_back(prism_over(piece, *section));
  return parts;
}

}  // namespace cupola
