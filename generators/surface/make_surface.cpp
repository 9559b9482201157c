#include "generators/surface/make_surface.hpp"

#include <algorithm>
#include <array>

#include <Eigen/Geometry>

#include "assembly/base/error.hpp"
#include "assembly/base/variant.hpp"
#include "generators/surface/arch.hpp"
#include "generators/surface/dome.hpp"
#include "generators/surface/vault_circular.hpp"
#include "generators/surface/vault_planar.hpp"
#include "generators/surface/wall.hpp"

namespace cupola {
namespace {

/// Volume of the hexahedron between beds k, k + 1 and abscissae a, b, m3.
double cell_volume(const SurfaceMap& surface, int k, double a, double b) {
  const auto corner = [&](int bed, double abscissa, Skin skin) { return surface.point(bed, abscissa, skin); };
  const auto [in, out] = std::pair(Skin::intrados, Skin::extrados);
  const std::array<Vec3, 8> p{corner(k, a, in),      corner(k, a, out),    corner(k, b, out),
                              corner(k, b, in),      corner(k + 1, a, in), corner(k + 1, a, out),
                              corner(k + 1, b, out), corner(k + 1, b, in)};
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

double faceted_volume(const Surface& shape, int n) {
  const SurfaceMap surface = make_surface(shape, n);
  const int facets = surface.corners.empty() ? 8 : static_cast<int>(surface.corners.size());
  const int num_slices = surface.closed ? facets * n : 1;
  double volume = 0.0;
  for (int k = 0; k < surface.num_rows; ++k)
    for (int s = 0; s < num_slices; ++s)
      volume +=
          cell_volume(surface, k, surface.extent * s / num_slices, surface.extent * (s + 1) / num_slices);
  return volume;
}

}  // namespace

SurfaceMap make_surface(const Surface& surface, int rings) {
  CUPOLA_ASSERT(rings >= 1);
  SurfaceMap map = std::visit(Overloaded{[&](const DomeSurface& dome) { return dome_surface(dome, rings); },
                                         [&](const OctagonalVault& vault) {
                                           return vault.construction == OctagonalVault::Construction::circular
                                                      ? circular_vault_surface(vault, rings)
                                                      : planar_vault_surface(vault, rings);
                                         },
                                         [&](const ArchSurface& arch) { return arch_surface(arch, rings); },
                                         [&](const WallSurface& wall) { return wall_surface(wall, rings); }},
                              surface);
  map.closed = traits_of(surface).closed;
  CUPOLA_ASSERT(map.point && map.extent > 0.0 && map.num_rows == rings * map.rows_per_ring);
  CUPOLA_ASSERT(std::ranges::is_sorted(map.corners));
  return map;
}

double extrapolated_shell_volume(const Surface& surface) {
  constexpr int n = 16;
  const double coarse = faceted_volume(surface, n);
  const double middle = faceted_volume(surface, 2 * n);
  const double fine = faceted_volume(surface, 4 * n);
  const double first = middle + (middle - coarse) / 3.0;
  const double second = fine + (fine - middle) / 3.0;
  return second + (second - first) / 15.0;
}

}  // namespace cupola
