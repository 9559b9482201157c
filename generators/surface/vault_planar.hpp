#pragma once

#include "generators/surface/surface_map.hpp"

namespace cupola {

/// Octagonal vault laid in planes: in each sail a bed is one plane that holds the sail's horizontal
/// direction, and beds of two sails meet in the corner's half-plane, where a block that spans it is folded
/// like an open book. At azimuth psi from mid-sail rho = X / cos psi, with (X, z) on the mid-sail section:
///
/// The abscissa divides a sail into equal widths along its horizontal, tan psi = u tan(pi / sails) with u
/// linear from -1 to 1, so that all blocks of a ring are equal.
///
/// radial: intrados (c (-e + R cos t), R sin t); the extrados lies at `thickness` along the normal
/// (cos t, c sin t) / m (`normal`), or on a second arc at the same t (`corner`, `midsail`).
/// horizontal: beds at equal heights; X_in = c (-e + sqrt(R^2 - z^2)); the extrados is the sail's parallel
/// curve at that height (`normal`), the second arc (`corner`, `midsail`), or X_in + thickness (`bed`).
SurfaceMap planar_vault_surface(const OctagonalVault& vault, int rings);

}  // namespace cupola
