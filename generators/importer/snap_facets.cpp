#include "generators/importer/snap_facets.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Dense>

#include "generators/stereotomy/separation.hpp"

namespace cupola {
namespace {

constexpr double kOpposedAngle = 1e-2;  // rad, largest angle between facets that face each other

struct BlockFacet {
  int block = 0;
  Facet facet;
  bool moved = false;
};

std::vector<BlockFacet> all_facets(const std::vector<TriangleMesh>& blocks, double angle) {
  std::vector<BlockFacet> facets;
  for (size_t b = 0; b < blocks.size(); ++b) {
    std::vector<int> facet_of;
    for (Facet& facet : find_facets(blocks[b], angle, 1e-6 * mesh_size(blocks[b]), &facet_of))
      facets.push_back({static_cast<int>(b), std::move(facet), false});
  }
  return facets;
}

/// True if two facets of different blocks have opposite normals and overlap within `distance` (m).
bool face_each_other(const std::vector<TriangleMesh>& blocks, const BlockFacet& a, const BlockFacet& b,
                     double distance) {
  if (a.block == b.block || a.facet.plane.normal.dot(b.facet.plane.normal) > -std::cos(kOpposedAngle))
    return false;
  for (int s : a.facet.triangles)
    for (int t : b.facet.triangles) {
      std::vector<Vec3> p, q;
      double furthest = 0.0;
      for (int i = 0; i < 3; ++i) {
        p.push_back(blocks[a.block].corner(s, i));
        q.push_back(blocks[b.block].corner(t, i));
        furthest = std::max(furthest, std::abs(a.facet.plane.normal.dot(q.back()) - a.facet.plane.offset));
      }
      if (furthest <= distance && polygons_overlap(p, q, a.facet.plane.normal, distance)) return true;
    }
  return false;
}

/// The point nearest to p on the planes, in the least-squares sense. There may be fewer than three planes,
/// and they may be dependent.
Vec3 on_planes(const Vec3& p, const std::vector<Plane>& planes) {
  Eigen::MatrixXd A(planes.size(), 3);
  Eigen::VectorXd b(planes.size());
  for (size_t i = 0; i < planes.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    A.row(row) = planes[i].normal.transpose();
    b[row] = planes[i].offset - planes[i].normal.dot(p);
  }
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(1e-3);  // planes within 1 mrad count as parallel
  return p + svd.solve(b);
}

/// Group of each facet: the facets that face each other, directly or through others. A group is named by one
/// of its facets.
std::vector<int> group_facets(const std::vector<TriangleMesh>& blocks, const std::vector<BlockFacet>& facets,
                              double distance) {
  std::vector<int> parent(facets.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (size_t i = 0; i < facets.size(); ++i)
    for (size_t j = i + 1; j < facets.size(); ++j)
      if (face_each_other(blocks, facets[i], facets[j], distance))
        parent[root(static_cast<int>(j))] = root(static_cast<int>(i));
  std::vector<int> group(facets.size());
  for (size_t i = 0; i < facets.size(); ++i) group[i] = root(static_cast<int>(i));
  return group;
}

/// Gives the facets of each group one plane, the mean of theirs weighted by area. Returns the number of
/// facets moved.
int set_common_planes(const std::vector<int>& group, std::vector<BlockFacet>* facets) {
  const size_t n = facets->size();
  std::vector<Vec3> normal(n, Vec3::Zero());  // per group, in the direction of the facet that names it
  std::vector<double> offset(n, 0.0);
  std::vector<int> members(n, 0);
  std::vector<double> sign(n);
  for (size_t i = 0; i < n; ++i) {
    const Facet& f = (*facets)[i].facet;
    const int g = group[i];
    sign[i] = f.plane.normal.dot((*facets)[g].facet.plane.normal) > 0.0 ? 1.0 : -1.0;
    normal[g] += sign[i] * f.area * f.plane.normal;
    offset[g] += sign[i] * f.area * f.plane.offset;
    ++members[g];
  }
  int moved = 0;
  for (size_t i = 0; i < n; ++i) {
    const int g = group[i];
    if (members[g] < 2) continue;
    const double length = normal[g].norm();
    (*facets)[i].facet.plane = {sign[i] * normal[g] / length, sign[i] * offset[g] / length};
    (*facets)[i].moved = true;
    ++moved;
  }
  return moved;
}

/// Moves every vertex of a moved facet to the nearest point on the planes of its facets.
void move_vertices(const std::vector<BlockFacet>& facets, std::vector<TriangleMesh>* blocks) {
  std::vector<std::vector<std::vector<Plane>>> planes(blocks->size());  // per block and vertex
  std::vector<std::vector<char>> touched(blocks->size());
  for (size_t b = 0; b < blocks->size(); ++b) {
    planes[b].resize((*blocks)[b].vertices.size());
    touched[b].assign((*blocks)[b].vertices.size(), 0);
  }
  for (const BlockFacet& f : facets) {
    std::vector<int> vertices;
    for (int t : f.facet.triangles)
      for (int v : (*blocks)[f.block].triangles[t]) vertices.push_back(v);
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (int v : vertices) {
      planes[f.block][v].push_back(f.facet.plane);
      if (f.moved) touched[f.block][v] = 1;
    }
  }
  for (size_t b = 0; b < blocks->size(); ++b)
    for (size_t v = 0; v < planes[b].size(); ++v)
      if (touched[b][v]) (*blocks)[b].vertices[v] = on_planes((*blocks)[b].vertices[v], planes[b][v]);
}

}  // namespace

int snap_facets(std::vector<TriangleMesh>* blocks, double facet_angle, double distance) {
  std::vector<BlockFacet> facets = all_facets(*blocks, facet_angle);
  const int moved = set_common_planes(group_facets(*blocks, facets, distance), &facets);
  move_vertices(facets, blocks);
  return moved;
}

}  // namespace cupola
