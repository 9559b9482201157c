#include "assembly/model/fill_pressure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace cupola {
namespace {

constexpr double kStandardGravity = 9.81;  // m/s2, as of Material::density

/// Adds the integrals of the stress s and of s x over a convex polygon on which s is linear.
void integrate(const Fill& fill, const std::vector<Vec3>& polygon, double* sum, Vec3* moment) {
  for (size_t i = 1; i + 1 < polygon.size(); ++i) {
    const std::array<Vec3, 3> x{polygon[0], polygon[i], polygon[i + 1]};
    const double area = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm();
    double s = 0.0;
    Vec3 sx = Vec3::Zero(), middle = Vec3::Zero();
    for (const Vec3& corner : x) {
      s += fill.stress(corner.z());
      sx += fill.stress(corner.z()) * corner;
      middle += corner;
    }
    *sum += area / 3.0 * s;
    *moment += area / 12.0 * (s * middle + sx);
  }
}

using Polygon = std::vector<Vec3>;

/// The feet of a fill's columns, by their least x.
class Columns {
 public:
  Columns(const Fill& fill, std::span<const LoadedFace> under) {
    for (const LoadedFace& face : under) {
      Polygon foot = below_plane(face.polygon, Vec3::UnitZ(), fill.level);
      if (foot.size() < 3) continue;
      const auto [low, high] = range_of_x(foot);
      by_low_x_.emplace(low, Foot{std::move(foot), {face.normal, face.normal.dot(face.centroid)}});
      widest_ = std::max(widest_, high - low);
    }
  }

  /// The parts of a face that, moved by `ahead` in plan, lie in a column, above the plane of its foot.
  std::vector<Polygon> before(const LoadedFace& face, const Vec3& ahead) const {
    constexpr double kParallel = 1e-4;  // of the cosine: a bed, whose lower stone is wider, also if rounded
    const auto [low, high] = range_of_x(face.polygon);
    const auto end = by_low_x_.upper_bound(high + ahead.x());
    std::vector<Polygon> parts;
    for (auto i = by_low_x_.lower_bound(low + ahead.x() - widest_); i != end; ++i) {
      const auto& [foot, plane] = i->second;
      if (plane.normal.dot(face.normal) < kParallel - 1.0) continue;
      Polygon part = below_plane(face.polygon, -plane.normal, -plane.offset);
      for (size_t k = 0; k < foot.size() && part.size() > 2; ++k) {
        const Vec3 side = foot[(k + 1) % foot.size()] - foot[k], out(side.y(), -side.x(), 0.0);
        part = below_plane(part, out, out.dot(foot[k] - ahead));
      }
      if (part.size() > 2) parts.push_back(std::move(part));
    }
    return parts;
  }

 private:
  struct Foot {
    Polygon polygon;
    Plane plane;
  };

  static std::pair<double, double> range_of_x(const Polygon& polygon) {
    const auto [low, high] = std::ranges::minmax(polygon, {}, [](const Vec3& p) { return p.x(); });
    return {low.x(), high.x()};
  }

  std::multimap<double, Foot> by_low_x_;
  double widest_ = 0.0;  // m
};

}  // namespace

double Fill::stress(double z) const {
  const double bottom = from ? std::max(z, *from) : z;
  return unit_weight * std::max(level - bottom, 0.0);
}

Resultant fill_force(const Fill& fill, const LoadedFace& face, const Vec3& gravity) {
  double sum = 0.0;
  Vec3 moment = Vec3::Zero();
  const Vec3 up = Vec3::UnitZ();
  std::vector<Vec3> covered = below_plane(face.polygon, up, fill.level);
  if (fill.from) {
    integrate(fill, below_plane(covered, -up, -*fill.from), &sum, &moment);
    covered = below_plane(covered, up, *fill.from);
  }
  integrate(fill, covered, &sum, &moment);
  if (sum == 0.0) return {face.centroid, Vec3::Zero()};
  const Vec3 level_normal(face.normal.x(), face.normal.y(), 0.0);
  return {moment / sum,
          sum / kStandardGravity *
              (std::max(face.normal.z(), 0.0) * gravity + fill.horizontal * gravity.z() * level_normal)};
}

std::vector<LoadedFace> beside_fill(const Fill& fill, std::span<const LoadedFace> faces,
                                    std::span<const LoadedFace> under, double distance) {
  const Columns columns(fill, under);
  std::vector<LoadedFace> pressed;
  for (const LoadedFace& face : faces) {
    const Vec3 outwards(face.normal.x(), face.normal.y(), 0.0);
    if (looks_up(face) || outwards.norm() < kUpright) continue;
    const std::vector<Polygon> parts = columns.before(face, distance * outwards.normalized());
    double area = 0.0;
    for (const Polygon& part : parts) area += polygon_area(part);
    const double corner = std::min(4.0 * distance * distance, 0.5 * face.area);
    if (area < corner) continue;  // of a joint, which only the distance moved out of the masonry
    for (const Polygon& part : parts)
      pressed.push_back(
          {face.block, face.part, part, polygon_centroid(part), face.normal, polygon_area(part)});
  }
  return pressed;
}

}  // namespace cupola
