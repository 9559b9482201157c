#pragma once

#include <Eigen/Core>

#include "assembly/case/geometry.hpp"

namespace cupola {

/// Mid-sail section of a polygonal vault. The sail is a cylinder whose corner section is the circular arc
///     rho = -e + R cos tau,  z = R sin tau.
/// Its mid-sail section is therefore an ellipse: c = cos(pi / sails) scales rho.
struct SailProfile {
  double R = 0.0;  ///< m, radius of the corner arc
  double e = 0.0;  ///< m, distance of the arc's centre beyond the axis
  double c = 0.0;  ///< cos(pi / sails)

  /// (X, z) of the intrados at arc parameter tau.
  Eigen::Vector2d intrados(double tau) const;
  /// (X_E, z_E) of the parallel curve at distance th = `depth` (m):
  ///     X_E = c (-e + R cos tau) + th cos tau / m
  ///     z_E = R sin tau + th c sin tau / m,          m = hypot(cos tau, c sin tau).
  Eigen::Vector2d parallel(double tau, double depth) const;
};

SailProfile sail_profile(const OctagonalVault& vault);

/// Azimuth relative to the middle of its sail, in [-pi / sails, pi / sails].
double azimuth_from_midsail(double azimuth, int sails);

struct SurfaceMap;
/// The part of the map that both constructions share: corners at azimuths i 2 pi / sails and a ring footing;
/// `at` is left empty. Throws InputError if the crown lies beyond the axis.
SurfaceMap vault_without_points(const OctagonalVault& vault, int rings);

}  // namespace cupola
