#include "generators/surface/sail_profile.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "generators/surface/surface_map.hpp"

namespace cupola {

using std::numbers::pi;

Eigen::Vector2d SailProfile::intrados(double tau) const {
  return {c * (-e + R * std::cos(tau)), R * std::sin(tau)};
}

Eigen::Vector2d SailProfile::parallel(double tau, double depth) const {
  const double m = std::hypot(std::cos(tau), c * std::sin(tau));
  return intrados(tau) + depth / m * Eigen::Vector2d(std::cos(tau), c * std::sin(tau));
}

SailProfile sail_profile(const OctagonalVault& vault) {
  return {vault.radius(), vault.center_offset(), std::cos(pi / vault.sails)};
}

double azimuth_from_midsail(double azimuth, int sails) {
  const double sail = 2.0 * pi / sails;
  return azimuth - (std::floor(azimuth / sail) + 0.5) * sail;
}

SurfaceMap vault_without_points(const OctagonalVault& vault, int rings) {
  const double last = std::acos(vault.center_offset() / vault.radius()) * 180.0 / pi;
  if (vault.crown_angle_deg >= last)
    throw InputError(fmt::format(
        "geometry.surface.crown_angle_deg = {}: the intrados meets the axis at {:.6g} deg; choose a "
        "smaller angle",
        vault.crown_angle_deg, last));
  SurfaceMap surface;
  surface.num_rows = rings;
  surface.extent = 2.0 * pi;
  surface.footing = Footing::ring;
  surface.sail_width = 2.0 * pi / vault.sails;
  for (int i = 0; i < vault.sails; ++i) surface.corners.push_back(2.0 * pi * i / vault.sails);
  return surface;
}

}  // namespace cupola
