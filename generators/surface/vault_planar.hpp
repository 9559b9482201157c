#pragma once

#include "generators/surface/surface_map.hpp"

namespace cupola {

/// Polygonal vault in planar construction. In each sail a bed is one plane that contains the horizontal
/// direction of the sail. The beds of two sails meet in the half-plane of the corner, where a block that
/// spans the corner is folded like an open book.
///
/// The abscissa divides a sail into equal widths along its horizontal, tan psi = u tan(pi / sails) with u
/// linear from -1 to 1, so that all blocks of a ring are equal. At azimuth psi from mid-sail
///     rho = X / cos psi,  (X, z) on the mid-sail section:
/// - planar_radial: beds at equal steps of t. The intrados is (c (-e + R cos t), R sin t). A layer lies at
///   its depth along the normal (cos t, c sin t) / m (`normal`), or on a second arc at the same t
///   (`corner`, `midsail`).
/// - planar_horizontal: beds at equal heights. The intrados is X_in = c (-e + sqrt(R^2 - z^2)). A layer is
///   the parallel curve of the sail at that height (`normal`), the second arc (`corner`, `midsail`), or
///   X_in + depth (`bed`).
/// Throws InputError for the extrados `bed` with radial beds.
SurfaceMap planar_vault_surface(const OctagonalVault& vault, int rings);

}  // namespace cupola
