#include "generators/surface/vault_circular.hpp"

#include <cmath>
#include <numbers>

#include "assembly/base/error.hpp"
#include "generators/surface/sail_profile.hpp"
#include "generators/surface/secant.hpp"

namespace cupola {
namespace {

/// rho where the bed z = (e + rho) T meets the sail with corner radius R at q = c / cos psi.
double sail_rho(double R, double e, double q, double T) {
  const double tau = std::atan(q * T) + std::asin(e / R * T * (1.0 - q) / std::sqrt(1.0 + q * q * T * T));
  return q * (-e + R * std::cos(tau));
}

/// rho where the bed at angle t meets the parallel surface of the sail.
double parallel_rho(const SailProfile& profile, double depth, double cos_psi, double t) {
  const double T = std::tan(t);
  const auto residual = [&](double tau) {
    const Eigen::Vector2d p = profile.parallel(tau, depth);
    return (p.y() - profile.e * T) * std::cos(t) - p.x() / cos_psi * std::sin(t);
  };
  const double guess = std::atan(profile.c / cos_psi * T);
  const double tau = t == 0.0 ? 0.0 : secant_root(residual, guess, guess + 1e-3);
  return profile.parallel(tau, depth).x() / cos_psi;
}

/// rho of the layer at a depth, where the bed at angle t meets it.
double layer_rho(const OctagonalVault& vault, const SailProfile& profile, double depth, double cos_psi,
                 double t) {
  const double q = profile.c / cos_psi;
  using enum OctagonalVault::Extrados;
  if (depth == 0.0) return sail_rho(profile.R, profile.e, q, std::tan(t));
  if (vault.extrados == normal) return parallel_rho(profile, depth, cos_psi, t);
  const double th = vault.extrados == corner ? depth : depth / profile.c;
  return sail_rho(profile.R + th, profile.e, q, std::tan(t));
}

}  // namespace

SurfaceMap circular_vault_surface(const OctagonalVault& vault, int rings) {
  if (vault.extrados == OctagonalVault::Extrados::bed)
    throw InputError("geometry.surface.extrados = bed: requires construction: planar_horizontal");
  SurfaceMap surface = vault_without_points(vault, rings);
  surface.flat_skins = false;
  const SailProfile profile = sail_profile(vault);
  const double crown = vault.crown_angle_deg * std::numbers::pi / 180.0;
  surface.at = [=](double bed, double azimuth, double depth) {
    const double t = crown * bed / rings;
    const double cos_psi = std::cos(azimuth_from_midsail(azimuth, vault.sails));
    const double rho = layer_rho(vault, profile, depth, cos_psi, t);
    return Vec3(rho * std::cos(azimuth), rho * std::sin(azimuth), (profile.e + rho) * std::tan(t));
  };
  return surface;
}

}  // namespace cupola
