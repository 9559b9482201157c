#pragma once

#include "assembly/case/geometry.hpp"
#include "generators/bond/bond_pattern.hpp"

namespace cupola {

/// Running bond: `blocks_per_ring` equal blocks of `slices_per_block` slices, odd rings shifted by half a
/// block. On a closed surface every ring has the same count; on an open one odd rings begin and end with
/// half blocks.
BondPattern running_bond(const RunningBond& bond, const BondGrid& grid);

}  // namespace cupola
