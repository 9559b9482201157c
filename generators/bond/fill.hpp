#pragma once

#include "assembly/case/geometry.hpp"
#include "generators/bond/bond_pattern.hpp"

namespace cupola {

/// General fill: every ring is cut into blocks of `narrowest` to `widest` times the mean width w, at
/// multiples of w / slices_per_block, by dynamic programming from the first ring up. A ring's cost is the sum
/// over its blocks of (width / w - 1)^2 plus, for every joint at a distance d < w / 4 from a joint of the
/// ring below, 1 - 4 d / w. No joint comes nearer than w / 4 to a corner of the surface.
BondPattern fill_bond(const FillBond& bond, const BondGrid& grid);

}  // namespace cupola
