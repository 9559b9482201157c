#pragma once

#include <Eigen/Core>

#include "assembly/case/geometry.hpp"

namespace cupola {

/// Mid-sail section of a cluster vault: an ellipse, because the sail is a cylinder whose corner section is
/// the circle rho = -e + R cos tau, z = R sin tau and c = cos(pi / sails) scales rho.
struct SailProfile {
  double R = 0.0;          ///< m, radius of the corner arc
  double e = 0.0;          ///< m, its centre lies this far beyond the axis
  double c = 0.0;          ///< cos(pi / sails)
  double thickness = 0.0;  ///< m

  /// (X, z) of the intrados at arc parameter tau.
  Eigen::Vector2d intrados(double tau) const;
  /// The parallel curve at distance `thickness`:
  /// X_E = c (-e + R cos tau) + th cos tau / m, z_E = R sin tau + th c sin tau / m, m = hypot(cos tau, c sin
  /// tau).
  Eigen::Vector2d extrados(double tau) const;
};

SailProfile sail_profile(const OctagonalVault& vault);

/// Azimuth measured from the middle of the sail it falls in, in [-pi / sails, pi / sails].
double azimuth_from_midsail(double azimuth, int sails);

/// Corners at azimuths i 2 pi / sails, checked dimensions, closed ring footing: what both constructions
/// share.
struct SurfaceMap;
SurfaceMap empty_vault(const OctagonalVault& vault, int rings);

}  // namespace cupola
