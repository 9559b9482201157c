#pragma once

#include "generators/surface/surface_map.hpp"

namespace cupola {

/// Dome of revolution,
///     rho = -e + r cos t,  z = r sin t,
/// with r = R + depth, and beds at equal steps of t from 0 to the
/// crown angle.
///
/// Bed k lies on the cone with apex (0, 0, e tan t_k). Two radial half-planes cut that cone along two of its
/// generators, so every bed facet is exactly plane, and so are the other five faces of a cell.
///
/// `shell_volume` is the volume of the smooth shell up to the crown angle t,
///     2 pi [(r1^3 - r0^3)/3 sin t - e t/2 (r1^2 - r0^2)];
/// the faceted shell is smaller by O(1/slices^2).
SurfaceMap dome_surface(const DomeSurface& dome, int rings);

}  // namespace cupola
