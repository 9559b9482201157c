#pragma once

#include "generators/surface/surface_map.hpp"

namespace cupola {

/// Plane wall: x is the abscissa in [0, length], z = height k / K for bed k of K, y = thickness - depth: y = 0 on the
/// front (extrados) and y = thickness on the back (intrados), so that (outwards, along, up) is right-handed as on
/// every surface.
SurfaceMap wall_surface(const WallSurface& wall, int rings);

}  // namespace cupola
