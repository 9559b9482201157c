#pragma once

#include "generators/surface/surface_map.hpp"

namespace cupola {

/// Octagonal vault laid in circular construction: the bed at angle t is the cone z = (e + rho) T, T = tan t,
/// about the axis, cut by sails that are cylinders.
///
/// At azimuth psi from mid-sail, with q = c / cos psi, the intrados in the radial half-plane is
/// rho = q (-e + R cos tau), z = R sin tau, and it meets the bed at
///     tau = atan(q T) + asin[ (e / R) T (1 - q) / sqrt(1 + q^2 T^2) ].
/// The extrados is the same curve for another arc (`corner`: R + th, `midsail`: R + th / c) or the sail's
/// parallel surface (`normal`), met by the bed at (z_E - e T) cos t = X_E / cos psi sin t. Its z is taken
/// from the bed, z = (e + rho) T, so that bed facets are plane to rounding; the skins' facets are not plane.
SurfaceMap circular_vault_surface(const OctagonalVault& vault, int rings);

}  // namespace cupola
