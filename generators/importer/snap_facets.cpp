#include "generators/importer/snap_facets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <CGAL/box_intersection_d.h>
#include <Eigen/Dense>

#include "generators/stereotomy/separation.hpp"

namespace cupola {
namespace {

constexpr double kOpposedAngle = 1e-2;  // rad, least bound on the angle between facets that face each other

struct BlockFacet {
  int block = 0;
  Facet facet;
  std::vector<int> vertices;  // of the block
};

std::vector<BlockFacet> all_facets(const std::vector<TriangleMesh>& blocks,
                                   const DecompositionOptions& options) {
  std::vector<BlockFacet> facets;
  for (size_t b = 0; b < blocks.size(); ++b) {
    std::vector<int> facet_of;
    const double distance = options.flat * mesh_size(blocks[b]);
    for (Facet& facet : find_facets(blocks[b], options.facet_angle, distance, &facet_of)) {
      std::vector<int> vertices;
      for (int t : facet.triangles)
        for (int v : blocks[b].triangles[t]) vertices.push_back(v);
      std::ranges::sort(vertices);
      vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
      facets.push_back({static_cast<int>(b), std::move(facet), std::move(vertices)});
    }
  }
  return facets;
}

/// m, of the mean corner of facet a outside the plane of facet b; negative inside.
double gap_between(const std::vector<TriangleMesh>& blocks, const BlockFacet& a, const BlockFacet& b) {
  Vec3 mean = Vec3::Zero();
  for (const int v : a.vertices) mean += blocks[a.block].vertices[v] / static_cast<double>(a.vertices.size());
  return b.facet.plane.normal.dot(mean) - b.facet.plane.offset;
}

/// m, the least distance within which two facets of different blocks with opposite normals face each other, if
/// they overlap within the limits; infinity elsewhere. Of facets of a curved joint, one lies beyond the plane
/// of the other; an opening lies between both.
double facing_distance(const std::vector<TriangleMesh>& blocks, const BlockFacet& a, const BlockFacet& b,
                       double angle, const SnapLimits& limits) {
  double least = std::numeric_limits<double>::infinity();
  if (a.block == b.block || a.facet.plane.normal.dot(b.facet.plane.normal) > -std::cos(angle)) return least;
  if (std::min(gap_between(blocks, a, b), gap_between(blocks, b, a)) > limits.gap) return least;
  for (int s : a.facet.triangles)
    for (int t : b.facet.triangles) {
      std::vector<Vec3> p, q;
      double furthest = 0.0;
      for (int i = 0; i < 3; ++i) {
        p.push_back(blocks[a.block].corner(s, i));
        q.push_back(blocks[b.block].corner(t, i));
        furthest = std::max(furthest, std::abs(a.facet.plane.normal.dot(q.back()) - a.facet.plane.offset));
      }
      if (furthest <= limits.distance && furthest < least &&
          overlap_width(p, q, a.facet.plane.normal) > limits.distance)
        least = furthest;
    }
  return least;
}

struct FacingPair {
  int i = 0, j = 0;
  double distance = 0.0;  // m, see facing_distance
};

/// Pairs of facets that face each other, in increasing order.
std::vector<FacingPair> facing_pairs(const std::vector<TriangleMesh>& blocks,
                                     const std::vector<BlockFacet>& facets, double angle,
                                     const SnapLimits& limits) {
  using FacetBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;
  std::vector<FacetBox> boxes;
  for (size_t i = 0; i < facets.size(); ++i) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (int v : facets[i].vertices) {
      low = low.cwiseMin(blocks[facets[i].block].vertices[v]);
      high = high.cwiseMax(blocks[facets[i].block].vertices[v]);
    }
    low.array() -= 0.5 * limits.distance;
    high.array() += 0.5 * limits.distance;
    boxes.emplace_back(CGAL::Bbox_3(low.x(), low.y(), low.z(), high.x(), high.y(), high.z()),
                       static_cast<int>(i));
  }
  std::vector<FacingPair> pairs;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const FacetBox& a, const FacetBox& b) {
    const int i = std::min(a.info(), b.info()), j = std::max(a.info(), b.info());
    const double distance = facing_distance(blocks, facets[i], facets[j], angle, limits);
    if (std::isfinite(distance)) pairs.push_back({i, j, distance});
  });
  std::ranges::sort(pairs, {}, [](const FacingPair& pair) { return std::pair(pair.i, pair.j); });
  return pairs;
}

double opposed_angle(const DecompositionOptions& options) {
  return std::max(kOpposedAngle, options.facet_angle);
}

/// Facets in one plane: sums over its facets of area times normal and offset, in the direction of the first.
struct Group {
  std::vector<int> facets;
  std::vector<double> signs;
  Vec3 normal = Vec3::Zero();
  double offset = 0.0;

  Plane plane() const { return {normal / normal.norm(), offset / normal.norm()}; }
};

Group joined(const Group& a, const Group& b) {
  Group both = a;
  const double sign = a.normal.dot(b.normal) > 0.0 ? 1.0 : -1.0;
  both.facets.insert(both.facets.end(), b.facets.begin(), b.facets.end());
  for (const double s : b.signs) both.signs.push_back(sign * s);
  both.normal += sign * b.normal;
  both.offset += sign * b.offset;
  return both;
}

Group alone(const std::vector<BlockFacet>& facets, int i) {
  const Facet& f = facets[i].facet;
  return {{i}, {1.0}, f.area * f.plane.normal, f.area * f.plane.offset};
}

double furthest_corner(const std::vector<TriangleMesh>& blocks, const std::vector<BlockFacet>& facets,
                       const Group& group) {
  const Plane plane = group.plane();
  double furthest = 0.0;
  for (int i : group.facets)
    for (int v : facets[i].vertices)
      furthest =
          std::max(furthest, std::abs(plane.normal.dot(blocks[facets[i].block].vertices[v]) - plane.offset));
  return furthest;
}

/// Joins the groups of facing facets as long as one plane fits all their corners, and gives each group its
/// plane. Returns the number of facets in groups.
int set_common_planes(const std::vector<TriangleMesh>& blocks, const std::vector<FacingPair>& pairs,
                      double distance, std::vector<BlockFacet>* facets) {
  std::vector<Group> groups(facets->size());
  std::vector<int> group_of(facets->size());
  std::iota(group_of.begin(), group_of.end(), 0);
  for (size_t i = 0; i < facets->size(); ++i) groups[i] = alone(*facets, static_cast<int>(i));
  for (const FacingPair& pair : pairs) {
    const int g = group_of[pair.i], h = group_of[pair.j];
    if (g == h) continue;
    Group both = joined(groups[g], groups[h]);
    if (furthest_corner(blocks, *facets, both) > distance) continue;
    for (int f : groups[h].facets) group_of[f] = g;
    groups[g] = std::move(both);
    groups[h] = {};
  }
  int moved = 0;
  for (const Group& group : groups) {
    if (group.facets.size() < 2) continue;
    const Plane plane = group.plane();
    for (size_t k = 0; k < group.facets.size(); ++k)
      (*facets)[group.facets[k]].facet.plane = {group.signs[k] * plane.normal, group.signs[k] * plane.offset};
    moved += static_cast<int>(group.facets.size());
  }
  return moved;
}

/// The point nearest to p on the planes, in the least-squares sense. There may be fewer than three planes,
/// and they may be dependent: planes count as parallel if p would otherwise move by more than `furthest` (m).
Vec3 on_planes(const Vec3& p, const std::vector<Plane>& planes, double furthest) {
  Eigen::MatrixXd A(planes.size(), 3);
  Eigen::VectorXd b(planes.size());
  for (size_t i = 0; i < planes.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    A.row(row) = planes[i].normal.transpose();
    b[row] = planes[i].offset - planes[i].normal.dot(p);
  }
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  for (const double parallel : {1e-3, 0.03, 0.3}) {  // sine of the angle
    svd.setThreshold(parallel);
    const Vec3 step = svd.solve(b);
    if (step.norm() <= furthest) return p + step;
  }
  return p;
}

/// Moves every vertex to the nearest point on the planes of its facets.
void move_vertices(const std::vector<BlockFacet>& facets, double furthest,
                   std::vector<TriangleMesh>* blocks) {
  std::vector<std::vector<std::vector<Plane>>> planes(blocks->size());  // per block and vertex
  for (size_t b = 0; b < blocks->size(); ++b) planes[b].resize((*blocks)[b].vertices.size());
  for (const BlockFacet& f : facets)
    for (int v : f.vertices) planes[f.block][v].push_back(f.facet.plane);
  for (size_t b = 0; b < blocks->size(); ++b)
    for (size_t v = 0; v < planes[b].size(); ++v)
      (*blocks)[b].vertices[v] = on_planes((*blocks)[b].vertices[v], planes[b][v], furthest);
}

}  // namespace

int snap_facets(std::vector<TriangleMesh>* blocks, const DecompositionOptions& options,
                const SnapLimits& limits) {
  std::vector<BlockFacet> facets = all_facets(*blocks, options);
  const int moved = set_common_planes(*blocks, facing_pairs(*blocks, facets, opposed_angle(options), limits),
                                      limits.distance, &facets);
  move_vertices(facets, 2.0 * limits.distance, blocks);
  return moved;
}

std::optional<double> snap_from_gaps(const std::vector<TriangleMesh>& blocks,
                                     const DecompositionOptions& options, double largest) {
  constexpr double kNoError = 1e-7;  // of `largest`: rounding of doubles
  constexpr double kJump = 2.0;
  constexpr double kBalance = 0.25;   // least overlap over gap of errors
  constexpr double kCovered = 1.001;  // over the distance at which the corners lie on the limit
  struct Error {
    double size = 0.0, distance = 0.0;  // m, from the common plane, and at which snap_facets finds the pair
    bool overlaps = false;
  };
  const std::vector<BlockFacet> facets = all_facets(blocks, options);
  std::vector<Error> errors;
  for (const auto& [i, j, distance] :
       facing_pairs(blocks, facets, opposed_angle(options), {largest, largest})) {
    const double size = furthest_corner(blocks, facets, joined(alone(facets, i), alone(facets, j)));
    if (size > kNoError * largest)
      errors.push_back({size, distance, gap_between(blocks, facets[i], facets[j]) < 0.0});
  }
  std::ranges::sort(errors, {}, &Error::size);
  double gap = 0.0, overlap = 0.0, distance = 0.0;
  std::optional<double> snap;
  for (size_t i = 0; i < errors.size(); ++i) {
    const double size = errors[i].size;
    (errors[i].overlaps ? overlap : gap) = size;
    distance = std::max({distance, errors[i].distance, size});
    const double next = i + 1 < errors.size() ? errors[i + 1].size : largest;
    if (kJump * size <= std::min(next, largest) && overlap >= kBalance * gap) snap = kCovered * distance;
  }
  return snap;
}

}  // namespace cupola
