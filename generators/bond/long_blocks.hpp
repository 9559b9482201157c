#pragma once

#include <set>
#include <string>

#include "generators/bond/bond_pattern.hpp"

namespace cupola {

/// First slices of `count` blocks round a closed surface, equally long up to the width of a slice, the first
/// of which begins `phase` block lengths behind the first corner (abscissa 0 without corners). None begins on
/// a corner. Fewer than `count` where the slices are wider than the blocks.
std::set<int> equal_starts(const BondGrid& grid, const std::vector<double>& cuts, int count, double phase);

/// Replaces the blocks and the empty cells of rings first_ring .. last_ring of a closed surface by `count`
/// equal blocks that are as high as all of these rings. The first is centred on the first corner of the
/// surface. Throws InputError, which names `key`, if an upright stands in these rings or if the slices are
/// wider than the blocks.
void lay_long_blocks(const BondGrid& grid, int first_ring, int last_ring, int count, const std::string& key,
                     BondPattern* pattern);

}  // namespace cupola
