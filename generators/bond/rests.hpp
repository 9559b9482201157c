#pragma once

#include <vector>

#include "generators/bond/bond_pattern.hpp"

namespace cupola {

/// Number of cells of each block. (num_blocks)
std::vector<int> cells_per_block(const BondPattern& pattern);

/// Makes every connected rest of a block that lost cells a block of its own, marked as truncated. A rest that
/// is no box is cut along its beds. Blocks that lost all cells disappear. `laid`: cells of each block before
/// it lost some.
void separate_rests(bool closed, const std::vector<int>& laid, BondPattern* pattern);

}  // namespace cupola
