#pragma once

#include "generators/surface/surface_map.hpp"

namespace cupola {

/// The surface that a case names, with `rings` courses. Throws InputError for dimensions that do not fit
/// together.
SurfaceMap make_surface(const Surface& surface, int rings);

/// Volume of the smooth shell, m3, by Richardson extrapolation of faceted shells with n, 2n, 4n cells each
/// way (errors O(1/n^2) and O(1/n^4) removed), within 1e-8: the reference for shells without a closed form.
double extrapolated_shell_volume(const Surface& surface);

}  // namespace cupola
