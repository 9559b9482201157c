#pragma once

#include "assembly/case/geometry.hpp"
#include "generators/bond/bond_pattern.hpp"

namespace cupola {

/// Fills every ring with blocks of `narrowest` to `widest` times the mean width w. Joints lie at multiples of
/// w / slices_per_block and no nearer than w / 4 to a corner of the surface.
///
/// Dynamic programming minimises the cost of one ring after another, from the base upwards:
///     sum over blocks of (width / w - 1)^2
///   + sum over joints of max(0, 1 - 4 d / w),  d = distance to the nearest joint of the ring below.
///
/// Throws InputError if a ring cannot be filled.
BondPattern fill_bond(const FillBond& bond, const BondGrid& grid);

}  // namespace cupola
