#pragma once

#include "generators/surface/surface_map.hpp"

namespace cupola {

/// Barrel arch in the x-z plane, axis y. Beds run from the springing at x > 0 over the crown to the one at
/// x < 0; `rings` counts voussoirs, each of `voussoir_segments` straight pieces. On the right half, with t
/// from the horizontal at the arc's centre, x = -e + r cos t, z = r sin t; the left half mirrors it. Joints
/// are radial; a pointed arch has one more, in the plane x = 0, and an even number of voussoirs.
SurfaceMap arch_surface(const ArchSurface& arch, int rings);

}  // namespace cupola
