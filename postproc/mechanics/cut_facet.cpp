#include "postproc/mechanics/cut_facet.hpp"

#include <algorithm>
#include <set>

#include <Eigen/Dense>
#include <Eigen/Geometry>

namespace cupola {
namespace {

void add_skin_normals(const Assembly& assembly, const Part& part, Vec3* sum) {
  for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
    const FaceKind kind = assembly.face_kinds[f];
    if (kind != FaceKind::intrados && kind != FaceKind::extrados) continue;
    const std::vector<Vec3> corners = face_points(assembly, f);
    *sum += (kind == FaceKind::extrados ? 1.0 : -1.0) * polygon_area(corners) * polygon_plane(corners).normal;
  }
}

/// From the intrados to the extrados: mean of the normals of these faces of a part, of its block if the part
/// has none; zero if this has none either.
Vec3 outwards_of(const Assembly& assembly, const Part& part) {
  Vec3 sum = Vec3::Zero();
  add_skin_normals(assembly, part, &sum);
  if (sum.norm() > 0.0) return sum;
  auto p = std::ranges::lower_bound(assembly.parts, part.block, {}, &Part::block);
  for (; p != assembly.parts.end() && p->block == part.block; ++p) add_skin_normals(assembly, *p, &sum);
  return sum;
}

}  // namespace

std::optional<BedFacet> facet_around(int block, std::span<const Vec3> corners, const Vec3& normal,
                                     const Vec3& outwards) {
  constexpr double kNormal = 1e-6;  // sine: rounding of the normals of small faces
  const Vec3 in_plane = outwards - normal.dot(outwards) * normal;
  if (in_plane.norm() <= kNormal * outwards.norm()) return std::nullopt;
  const Vec3 across = in_plane.normalized(), along = normal.cross(across);
  Eigen::AlignedBox2d box;
  for (const Vec3& x : corners)
    box.extend(Eigen::Vector2d(along.dot(x - corners[0]), across.dot(x - corners[0])));
  const auto corner = [&](double a, double c) -> Vec3 { return corners[0] + a * along + c * across; };
  const Eigen::Vector2d low = box.min(), high = box.max();
  BedFacet facet{block, corner(low.x(), low.y()), corner(high.x(), low.y()), corner(low.x(), high.y()),
                 corner(high.x(), high.y())};
  facet.around = true;
  return facet;
}

void add_cut_facets(const Assembly& assembly, std::span<const BedFace> faces, std::vector<BedFacet>* bed) {
  std::set<int> whole;
  for (const BedFacet& facet : *bed) whole.insert(facet.block);
  for (const auto& [part, f] : faces) {
    if (whole.contains(part->block)) continue;
    const std::vector<Vec3> corners = face_points(assembly, f);
    const Vec3 normal = polygon_plane(corners).normal;
    if (auto facet = facet_around(part->block, corners, normal, outwards_of(assembly, *part))) {
      facet->internal = assembly.face_kinds[f] == FaceKind::internal;
      bed->push_back(*facet);
    }
  }
}

Vec3 growth(std::span<const Vec3> corners, std::span<const double> values) {
  Vec3 centre = Vec3::Zero();
  double mean = 0.0;
  for (size_t i = 0; i < corners.size(); ++i) {
    centre += corners[i] / static_cast<double>(corners.size());
    mean += values[i] / static_cast<double>(corners.size());
  }
  Mat3 squares = Mat3::Zero();
  Vec3 products = Vec3::Zero();
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vec3 x = corners[i] - centre;
    squares += x * x.transpose();
    products += (values[i] - mean) * x;
  }
  // Corners lie in a plane: of the slopes that fit, the least.
  return squares.completeOrthogonalDecomposition().solve(products);
}

}  // namespace cupola
