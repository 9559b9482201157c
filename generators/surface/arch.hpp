#pragma once

#include "generators/surface/surface_map.hpp"

namespace cupola {

/// Barrel arch in the x-z plane with axis y. The beds run from the springing at x > 0 over the crown to the
/// springing at x < 0. `rings` is the number of voussoirs; each has `voussoir_segments` straight pieces.
///
/// On the right half, with t measured from the horizontal at the centre of the arc,
///     x = -e + r cos t,  z = r sin t;
/// the left half is its mirror image. All joints are radial, except that a pointed arch has one in the plane
/// x = 0; its number of voussoirs is even. Throws InputError if it is odd or the springing lies beyond the
/// crown.
SurfaceMap arch_surface(const ArchSurface& arch, int rings);

}  // namespace cupola
