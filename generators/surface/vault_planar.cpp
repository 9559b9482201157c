#include "generators/surface/vault_planar.hpp"

#include <cmath>
#include <numbers>

#include "assembly/base/error.hpp"
#include "generators/surface/sail_profile.hpp"
#include "generators/surface/secant.hpp"

namespace cupola {
namespace {

using Eigen::Vector2d;
using enum OctagonalVault::Extrados;

/// Radius of the second arc, on which a `corner` or `midsail` layer lies, m.
double outer_radius(const OctagonalVault& vault, const SailProfile& profile, double depth) {
  return profile.R + (vault.extrados == midsail ? depth / profile.c : depth);
}

/// (X, z) on the mid-sail section for the bed that is normal to the sail at arc parameter t.
Vector2d radial_point(const OctagonalVault& vault, const SailProfile& profile, double t, double depth) {
  if (depth == 0.0) return profile.intrados(t);
  if (vault.extrados == normal) return profile.parallel(t, depth);
  const double r = outer_radius(vault, profile, depth);
  return {profile.c * (-profile.e + r * std::cos(t)), r * std::sin(t)};
}

/// (X, z) on the mid-sail section for the level bed at height z.
Vector2d level_point(const OctagonalVault& vault, const SailProfile& profile, double z, double depth) {
  const auto arc = [&](double r) { return profile.c * (-profile.e + std::sqrt(r * r - z * z)); };
  if (depth == 0.0) return {arc(profile.R), z};
  if (vault.extrados == bed) return {arc(profile.R) + depth, z};
  if (vault.extrados != normal) return {arc(outer_radius(vault, profile, depth)), z};
  const auto residual = [&](double tau) { return profile.parallel(tau, depth).y() - z; };
  const double guess = std::asin(z / (profile.R + depth));
  const double tau = z == 0.0 ? 0.0 : secant_root(residual, guess, guess + 1e-3);
  return {profile.parallel(tau, depth).x(), z};
}

/// Azimuth at an abscissa in [0, 2 pi) that is proportional to the width along each sail.
double azimuth_of(double abscissa, int sails) {
  const double half = std::numbers::pi / sails;
  const double from_midsail = azimuth_from_midsail(abscissa, sails);
  return abscissa - from_midsail + std::atan(from_midsail / half * std::tan(half));
}

}  // namespace

SurfaceMap planar_vault_surface(const OctagonalVault& vault, int rings) {
  const bool level = vault.construction == OctagonalVault::Construction::planar_horizontal;
  if (vault.extrados == bed && !level)
    throw InputError("geometry.surface.extrados = bed: requires construction: planar_horizontal");
  SurfaceMap surface = vault_without_points(vault, rings);
  surface.flat_slices = true;
  const SailProfile profile = sail_profile(vault);
  const double crown = vault.crown_angle_deg * std::numbers::pi / 180.0;
  const double crown_height = profile.R * std::sin(crown);
  surface.at = [=](double bed_position, double abscissa, double depth) {
    const double azimuth = azimuth_of(abscissa, vault.sails);
    const Vector2d section = level ? level_point(vault, profile, crown_height * bed_position / rings, depth)
                                   : radial_point(vault, profile, crown * bed_position / rings, depth);
    const double rho = section.x() / std::cos(azimuth_from_midsail(azimuth, vault.sails));
    return Vec3(rho * std::cos(azimuth), rho * std::sin(azimuth), section.y());
  };
  return surface;
}

}  // namespace cupola
