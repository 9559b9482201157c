#pragma once

#include "assembly/case/geometry.hpp"
#include "generators/bond/bond_pattern.hpp"

namespace cupola {

/// Courses of `blocks_per_ring` equal blocks, each of `slices_per_block` slices.
///
/// Odd rings are shifted by half a block; on an open surface they begin and end with half blocks. With the
/// default phase of 1/4 block the corners of a vault lie alternately 1/4 and 3/4 into a block, so that no
/// joint lies on a corner and all blocks are equal.
///
/// Throws InputError for an odd number of slices per block, and for a phase on an open surface.
BondPattern running_bond(const RunningBond& bond, const BondGrid& grid);

/// The same courses with all head joints aligned.
BondPattern stack_bond(const StackBond& bond, const BondGrid& grid);

}  // namespace cupola
