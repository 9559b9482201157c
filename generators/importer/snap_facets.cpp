#include "generators/importer/snap_facets.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Dense>

#include "generators/stereotomy/separation.hpp"

namespace cupola {
namespace {

constexpr double kOpposedAngle = 1e-2;  // rad

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

/// Vertex nearest to p on the planes, in the least-squares sense (they may be fewer than three, or
/// dependent).
Vec3 on_planes(const Vec3& p, const std::vector<Plane>& planes) {
  Eigen::MatrixXd A(planes.size(), 3);
  Eigen::VectorXd b(planes.size());
  for (size_t i = 0; i < planes.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    A.row(row) = planes[i].normal.transpose();
    b[row] = planes[i].offset - planes[i].normal.dot(p);
  }
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(1e-3);  // planes within 1 mrad give no direction of their own
  return p + svd.solve(b);
}

}  // namespace

int snap_facets(std::vector<TriangleMesh>* blocks, double facet_angle, double distance) {
  std::vector<BlockFacet> facets = all_facets(*blocks, facet_angle);
  std::vector<int> group(facets.size());
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](int i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  for (size_t i = 0; i < facets.size(); ++i)
    for (size_t j = i + 1; j < facets.size(); ++j)
      if (face_each_other(*blocks, facets[i], facets[j], distance))
        group[root(static_cast<int>(j))] = root(static_cast<int>(i));

  // One plane per group, in the direction of its first facet.
  std::vector<Vec3> normal(facets.size(), Vec3::Zero());
  std::vector<double> offset(facets.size(), 0.0), area(facets.size(), 0.0);
  std::vector<int> members(facets.size(), 0);
  const auto sign = [&](size_t i) {
    return facets[i].facet.plane.normal.dot(facets[root(static_cast<int>(i))].facet.plane.normal) > 0.0
               ? 1.0
               : -1.0;
  };
  for (size_t i = 0; i < facets.size(); ++i) {
    const int g = root(static_cast<int>(i));
    const Facet& f = facets[i].facet;
    normal[g] += sign(i) * f.area * f.plane.normal;
    offset[g] += sign(i) * f.area * f.plane.offset;
    area[g] += f.area;
    ++members[g];
  }
  int moved = 0;
  for (size_t i = 0; i < facets.size(); ++i) {
    const int g = root(static_cast<int>(i));
    if (members[g] < 2) continue;
    const double length = normal[g].norm();
    facets[i].facet.plane = {sign(i) * normal[g] / length, sign(i) * offset[g] / length};
    facets[i].moved = true;
    ++moved;
  }

  std::vector<std::vector<std::vector<Plane>>> planes(blocks->size());
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
  return moved;
}

}  // namespace cupola
