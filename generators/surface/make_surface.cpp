#include "generators/surface/make_surface.hpp"

#include <algorithm>
#include <array>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "generators/surface/drawings.hpp"

namespace cupola {
namespace {

/// Volume of the hexahedron between beds k, l and abscissae a, b, m3.
double cell_volume(const SurfaceMap& surface, double k, double l, double a, double b) {
  const auto corner = [&](double bed, double abscissa, int layer) {
    return surface.point(bed, abscissa, layer);
  };
  const auto [in, out] = std::pair(0, surface.num_wythes());
  const std::array<Vec3, 8> p{corner(k, a, in), corner(k, a, out), corner(k, b, out), corner(k, b, in),
                              corner(l, a, in), corner(l, a, out), corner(l, b, out), corner(l, b, in)};
  constexpr std::array<std::array<int, 4>, 6> quads{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 4, 7, 3}, {1, 2, 6, 5}}};
  double six_volumes = 0.0;
  for (const auto& q : quads) {
    const Vec3 x = p[q[0]] - p[0], y = p[q[1]] - p[0], z = p[q[2]] - p[0], w = p[q[3]] - p[0];
    // Mean over the two diagonals that split the quad, so that the volume is symmetric in its corners.
    six_volumes += 0.5 * (x.dot(y.cross(z)) + x.dot(z.cross(w)) + x.dot(y.cross(w)) + y.dot(z.cross(w)));
  }
  return six_volumes / 6.0;
}

/// Volume with n cells in every ring or over the height, and n in each facet.
double faceted_volume(const SurfaceMap& surface, int n) {
  std::vector<double> ends{0.0};  // of facets
  if (surface.corners.empty() && surface.closed)
    for (int i = 1; i < 8; ++i) ends.push_back(surface.extent * i / 8);
  for (double corner : surface.corners)
    if (corner > 0.0) ends.push_back(corner);
  ends.push_back(surface.extent);
  const double first_bed = -surface.first_ring(), step = (surface.num_rows - first_bed) / n;
  double volume = 0.0;
  for (int k = 0; k < n; ++k)
    for (size_t facet = 0; facet + 1 < ends.size(); ++facet)
      for (int i = 0; i < n; ++i) {
        const double width = (ends[facet + 1] - ends[facet]) / n, a = ends[facet] + i * width;
        volume += cell_volume(surface, first_bed + k * step, first_bed + (k + 1) * step, a, a + width);
      }
  return volume;
}

/// m, at a height above the springing (m).
double total_thickness(const std::vector<Thickness>& wythes, double height) {
  double sum = 0.0;
  for (const Thickness& wythe : wythes) sum += wythe.at(height);
  return sum;
}

/// Throws where the beds of a course meet inside the shell, so that a skin turns back, or both do.
void refuse_folds(const SurfaceMap& map) {
  std::vector<double> abscissae{0.0, 0.5 * map.extent};
  for (size_t i = 0; i < map.corners.size(); ++i) {
    const double end = i + 1 < map.corners.size() ? map.corners[i + 1] : map.extent;
    abscissae.insert(abscissae.end(), {map.corners[i], 0.5 * (map.corners[i] + end)});
  }
  for (int bed = 0; bed < map.num_rows; ++bed)
    for (const double abscissa : abscissae) {
      const Vec3 inner = map.intrados(bed + 1, abscissa) - map.intrados(bed, abscissa);
      const Vec3 outer = map.extrados(bed + 1, abscissa) - map.extrados(bed, abscissa);
      const Vec3 along = map.intrados(bed, abscissa + 1e-3 * map.extent) - map.intrados(bed, abscissa);
      const Vec3 through = map.extrados(bed, abscissa) - map.intrados(bed, abscissa);
      if (inner.dot(outer) > 0.0 && through.cross(along).dot(inner) > 0.0) continue;
      const Vec3 at = map.extrados(bed, abscissa);
      throw InputError(
          fmt::format("geometry.surface: course {} folds about ({:.4g}, {:.4g}, {:.4g}) m, where its two "
                      "beds meet inside the shell: choose a smaller thickness, a larger eye or other `beds`",
                      bed / map.rows_per_ring, at.x(), at.y(), at.z()));
    }
}

}  // namespace

SurfaceMap make_surface(Surface surface, int rings, std::vector<Thickness> wythes) {
  CUPOLA_ASSERT(rings >= 1);
  if (wythes.empty())
    wythes = {{{}, {std::visit([](const auto& s) { return s.thickness; }, surface)}}};
  else
    std::visit([&](auto& s) { s.thickness = total_thickness(wythes, 0.0); }, surface);
  SurfaceMap map =
      std::visit([&](const auto& kind) { return drawn_surface(drawing_of(kind), rings); }, surface);
  map.closed = traits_of(surface).closed;
  map.thrust_lines = traits_of(surface).thrust_lines;
  map.wythes = std::move(wythes);
  if (!std::ranges::all_of(map.wythes, &Thickness::constant)) {
    map.shell_volume.reset();
    map.flat_rings = false;
  }
  refuse_folds(map);
  CUPOLA_ASSERT(map.at && map.extent > 0.0 && map.num_rows == rings * map.rows_per_ring);
  CUPOLA_ASSERT(std::ranges::is_sorted(map.corners));
  return map;
}

double extrapolated_shell_volume(const SurfaceMap& surface) {
  constexpr int n = 16;
  const double coarse = faceted_volume(surface, n);
  const double middle = faceted_volume(surface, 2 * n);
  const double fine = faceted_volume(surface, 4 * n);
  const double first = middle + (middle - coarse) / 3.0;
  const double second = fine + (fine - middle) / 3.0;
  return second + (second - first) / 15.0;
}

}  // namespace cupola
