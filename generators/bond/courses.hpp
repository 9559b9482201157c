#pragma once

#include "assembly/case/geometry.hpp"
#include "generators/bond/bond_pattern.hpp"

namespace cupola {

/// Courses of `blocks_per_ring` equal blocks of `slices_per_block` slices.
///
/// Running bond shifts odd rings by half a block; on an open surface they begin and end with half blocks.
/// With the default phase of 1/4 block every corner of a vault lies 1/4 or 3/4 into a block, in turn: no
/// joint on a corner, and all blocks equal.
BondPattern running_bond(const RunningBond& bond, const BondGrid& grid);

/// Stack bond aligns all head joints.
BondPattern stack_bond(const StackBond& bond, const BondGrid& grid);

}  // namespace cupola
