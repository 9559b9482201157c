#pragma once

#include "generators/surface/surface_map.hpp"

namespace cupola {

/// Polygonal vault in circular construction: the bed at angle t is the cone z = (e + rho) T about the z axis,
/// T = tan t, and the sails are cylinders.
///
/// At azimuth psi from mid-sail, with q = c / cos psi, the intrados in the radial half-plane is
///     rho = q (-e + R cos tau),  z = R sin tau,
/// and it meets the bed at
///     tau = atan(q T) + asin[ (e / R) T (1 - q) / sqrt(1 + q^2 T^2) ].
/// A layer at depth th is the same curve with a larger radius (`corner`: R + th, `midsail`: R + th / c), or the
/// parallel surface of the sail (`normal`), which the bed meets where
///     (z_E - e T) cos t = (X_E / cos psi) sin t.
/// z is always computed from the bed, z = (e + rho) T, so that bed facets are plane to rounding. The facets
/// of the skins are not plane. Throws InputError for the extrados `bed`.
SurfaceMap circular_vault_surface(const OctagonalVault& vault, int rings);

}  // namespace cupola
