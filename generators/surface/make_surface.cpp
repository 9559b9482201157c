#include "generators/surface/make_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "generators/surface/drawings.hpp"

namespace cupola {
namespace {

/// Volume of a hexahedron, m3: the corners of its lower face, then those above them.
double cell_volume(const std::array<Vec3, 8>& p) {
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

/// Points of both skins on a grid over the whole shell, whose lines include the corners of the surface.
struct SkinGrid {
  size_t num_beds, num_abscissae;
  std::vector<Vec3> inner, outer;  // [bed * num_abscissae + abscissa]
};

/// Grid of n cells over the height and n in each facet, or n/4 where eight facets or more are narrow.
SkinGrid sample_skins(const SurfaceMap& surface, int n) {
  std::vector<double> ends{0.0};  // of facets
  if (surface.corners.empty() && surface.closed)
    for (int i = 1; i < 8; ++i) ends.push_back(surface.extent * i / 8);
  for (double corner : surface.corners)
    if (corner > 0.0) ends.push_back(corner);
  ends.push_back(surface.extent);
  const int cells = ends.size() > 8 ? n / 4 : n;
  std::vector<double> abscissae;
  for (size_t facet = 0; facet + 1 < ends.size(); ++facet)
    for (int i = 0; i < cells; ++i)
      abscissae.push_back(ends[facet] + i * (ends[facet + 1] - ends[facet]) / cells);
  abscissae.push_back(surface.extent);
  SkinGrid grid{static_cast<size_t>(n) + 1, abscissae.size(), {}, {}};
  const double first_bed = -surface.first_ring(), step = (surface.num_rows - first_bed) / n;
  for (int k = 0; k <= n; ++k)
    for (const double abscissa : abscissae) {
      grid.inner.push_back(surface.intrados(first_bed + k * step, abscissa));
      grid.outer.push_back(surface.extrados(first_bed + k * step, abscissa));
    }
  return grid;
}

/// Volume of the cells between every `stride`-th line of the grid, m3.
double faceted_volume(const SkinGrid& grid, size_t stride) {
  double volume = 0.0;
  for (size_t k = 0; k + stride < grid.num_beds; k += stride)
    for (size_t i = 0; i + stride < grid.num_abscissae; i += stride) {
      const size_t a = k * grid.num_abscissae + i, b = a + stride;  // corners of the cell in the lower bed
      const size_t up = stride * grid.num_abscissae;
      volume += cell_volume({grid.inner[a], grid.outer[a], grid.outer[b], grid.inner[b], grid.inner[a + up],
                             grid.outer[a + up], grid.outer[b + up], grid.inner[b + up]});
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
  map.springing = map.intrados(0, map.first_corner);
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
  const SkinGrid grid = sample_skins(surface, 4 * n);
  const double coarse = faceted_volume(grid, 4);
  const double middle = faceted_volume(grid, 2);
  const double fine = faceted_volume(grid, 1);
  const double first = middle + (middle - coarse) / 3.0;
  const double second = fine + (fine - middle) / 3.0;
  return second + (second - first) / 15.0;
}

SurfaceMap faceted(SurfaceMap surface, const std::vector<double>& ends) {
  CUPOLA_ASSERT(surface.closed && ends.size() > 3);
  if (!surface.shell_volume) surface.shell_volume = extrapolated_shell_volume(surface);
  surface.at = [ends, extent = surface.extent, at = surface.at](double bed, double abscissa,
                                                                double depth) -> Vec3 {
    const double azimuth = abscissa - extent * std::floor((abscissa - ends.front()) / extent);
    const auto above = std::upper_bound(ends.begin() + 1, ends.end() - 1, azimuth);
    const Vec3 left = at(bed, *(above - 1), depth), right = at(bed, *above, depth);
    const double c = std::cos(azimuth), s = std::sin(azimuth);
    const double from_left = c * left.y() - s * left.x(), from_right = c * right.y() - s * right.x();
    return left + from_left / (from_left - from_right) * (right - left);
  };
  surface.flat_slices = surface.flat_skins;
  surface.facets = ends;
  return surface;
}

}  // namespace cupola
