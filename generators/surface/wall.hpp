#pragma once

#include "generators/surface/surface_map.hpp"

namespace cupola {

/// Plane wall: x = abscissa in [0, length], z = height k / K, y = 0 on the front (extrados) and
/// thickness on the back (intrados), so that (outwards, along, up) is right-handed as on every surface.
SurfaceMap wall_surface(const WallSurface& wall, int rings);

}  // namespace cupola
