#pragma once

#include "generators/surface/surface_map.hpp"

namespace cupola {

/// Dome of revolution: rho = -e + r cos t, z = r sin t with r = R (intrados) and R + thickness (extrados),
/// beds at equal steps of t from 0 to the crown angle.
///
/// Bed k is the cone with apex (0, 0, e tan t_k): between two radial half-planes it holds two of its own
/// generators, so every bed facet is exactly plane, and so are the other five faces of a cell.
/// `shell_volume` is that of the smooth shell,
/// 2 pi [(r1^3 - r0^3)/3 sin t - e t/2 (r1^2 - r0^2)]; the faceted one is smaller by O(1/slices^2).
SurfaceMap dome_surface(const DomeSurface& dome, int rings);

}  // namespace cupola
