#pragma once

#include <string>

#include "generators/bond/bond_pattern.hpp"

namespace cupola {

/// Replaces the blocks of rings first_ring .. last_ring of a closed surface by `count` blocks that are as high as all of these
/// rings and equally long up to the width of a slice. The first is centred on the first corner of the surface, and no joint
/// lies on a corner. Throws InputError, which names `key`, if an upright stands in these rings or if the slices are
/// wider than the blocks.
void lay_long_blocks(const BondGrid& grid, int first_ring, int last_ring, int count, const std::string& key,
                     BondPattern* pattern);

}  // namespace cupola
