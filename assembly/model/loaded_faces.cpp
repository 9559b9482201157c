#include "assembly/model/loaded_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <boost/math/quadrature/gauss.hpp>

#include "assembly/model/polygon_parts.hpp"

namespace cupola {
namespace {

/// The pieces of faces that no other part of their block hides.
std::vector<LoadedFace> on_surface(const Assembly& assembly, const std::vector<LoadedFace>& faces) {
  constexpr double kSamePlace = 1e-9;  // of the size of a block: above the rounding of coordinates
  std::vector<LoadedFace> pieces;
  std::vector<PlanePolygon> of_block;
  int block = -1;
  for (const LoadedFace& face : faces) {
    if (face.block != block) of_block = faces_of_block(assembly, face.block);
    block = face.block;
    const double tolerance = kSamePlace * std::cbrt(assembly.blocks[block].volume);
    for (std::vector<Vec3>& polygon : uncovered(PlanePolygon(face.polygon), of_block, tolerance)) {
      LoadedFace& piece = pieces.emplace_back(face);
      piece.centroid = polygon_centroid(polygon);
      piece.area = polygon_area(polygon);
      piece.polygon = std::move(polygon);
    }
  }
  return pieces;
}

}  // namespace

bool looks_up(const LoadedFace& face) {
  return face.normal.z() > kUpright;
}

LoadedFace loaded_face(const Assembly& assembly, int part, int f) {
  std::vector<Vec3> polygon = face_points(assembly, f);
  const Vec3 centroid = polygon_centroid(polygon), normal = polygon_plane(polygon).normal;
  const double area = polygon_area(polygon);
  return {assembly.parts[part].block, part, std::move(polygon), centroid, normal, area};
}

std::vector<Vec3> below_plane(const std::vector<Vec3>& polygon, const Vec3& n, double offset) {
  std::vector<Vec3> kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double of_a = n.dot(a) - offset, of_b = n.dot(b) - offset;
    if (of_a <= 0.0) kept.push_back(a);
    if ((of_a < 0.0 && of_b > 0.0) || (of_a > 0.0 && of_b < 0.0))
      kept.push_back(a + of_a / (of_a - of_b) * (b - a));
  }
  return kept;
}

bool means_member(const std::string& name, const Assembly& assembly, int member) {
  const auto is_at = [&](const std::vector<std::string>& names) {
    return member < static_cast<int>(names.size()) && names[member] == name;
  };
  return is_at(assembly.members) || is_at(assembly.member_originals);
}

bool is_of_member(const Assembly& assembly, const Block& block, const std::string& name) {
  return name.empty() || means_member(name, assembly, block.member);
}

std::vector<LoadedFace> faces_of_kind(const Assembly& assembly, std::span<const FaceKind> kinds,
                                      int from_ring, int to_ring, const std::string& member) {
  std::vector<LoadedFace> faces;
  for (int p = 0; p < static_cast<int>(assembly.parts.size()); ++p) {
    const Part& part = assembly.parts[p];
    const Block& block = assembly.blocks[part.block];
    if (part.ring < from_ring || part.ring > to_ring || block.fixed || !is_of_member(assembly, block, member))
      continue;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      if (std::ranges::find(kinds, assembly.face_kinds[f]) == kinds.end()) continue;
      faces.push_back(loaded_face(assembly, p, f));
    }
  }
  return on_surface(assembly, faces);
}

namespace {

/// The rays of a force that spreads down from a rectangle.
class Rays {
 public:
  Rays(const Spread& spread, const Vec3& point) : spread_(spread), point_(point) {}

  /// (u, v, z) of a point that a ray meets.
  Vec3 of(const Vec3& p) const {
    Vec3 ray = p;
    ray.head<2>() = (p - point_).head<2>().array() / width(p.z());
    return ray;
  }

  /// Where the ray (u, v) meets the plane of the face.
  Vec3 meet(double u, double v, const LoadedFace& face) const {
    const Vec3 down(-2.0 * spread_.slope * u, -2.0 * spread_.slope * v, 1.0);  // d(x, y, z) / dz
    const Vec3 from = point_ + Vec3(u * spread_.x, v * spread_.y, 0.0);
    return from + face.normal.dot(face.centroid - from) / face.normal.dot(down) * down;
  }

 private:
  Eigen::Array2d width(double z) const {
    const double growth = 2.0 * spread_.slope * (point_.z() - z);
    return Eigen::Array2d(spread_.x + growth, spread_.y + growth);
  }

  const Spread& spread_;
  const Vec3& point_;
};

/// Adds the area of a triangle of rays and the integral of the points at which they meet the face, which are
/// rational functions of (u, v): by a Gauss rule in its two sides.
void integrate(const Rays& rays, const LoadedFace& face, const std::array<Vec3, 3>& triangle, double* share,
               Vec3* moment) {
  const Vec3 a = triangle[1] - triangle[0], b = triangle[2] - triangle[0];
  const double twice_area = a.x() * b.y() - a.y() * b.x();
  using Rule = boost::math::quadrature::gauss<double, 10>;
  *share += 0.5 * twice_area;
  for (int k = 0; k < 3; ++k)
    (*moment)[k] += Rule::integrate(
        [&](double s) {
          return s * twice_area *
                 Rule::integrate(
                     [&](double t) {
                       const Vec3 ray = triangle[0] + s * (a + t * (b - a));
                       return rays.meet(ray.x(), ray.y(), face)[k];
                     },
                     0.0, 1.0);
        },
        0.0, 1.0);
}

}  // namespace

std::vector<SpreadShare> spread_shares(const Spread& spread, const Vec3& point,
                                       std::span<const LoadedFace> faces) {
  const Rays rays(spread, point);
  std::vector<SpreadShare> shares;
  double sum = 0.0;
  for (const LoadedFace& face : faces) {
    if (!looks_up(face)) continue;
    std::vector<Vec3> met = below_plane(face.polygon, Vec3::UnitZ(), point.z());
    for (Vec3& p : met) p = rays.of(p);
    for (const double side : {-1.0, 1.0}) {
      met = below_plane(met, side * Vec3::UnitX(), 0.5);
      met = below_plane(met, side * Vec3::UnitY(), 0.5);
    }
    double share = 0.0;
    Vec3 moment = Vec3::Zero();
    for (size_t i = 1; i + 1 < met.size(); ++i)
      integrate(rays, face, {met[0], met[i], met[i + 1]}, &share, &moment);
    if (share <= 0.0) continue;
    shares.push_back({face.block, moment / share, share});
    sum += share;
  }
  if (sum > 1.0)
    for (SpreadShare& share : shares) share.share /= sum;
  return shares;
}

}  // namespace cupola
