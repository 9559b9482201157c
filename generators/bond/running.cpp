#include "generators/bond/running.hpp"

#include <fmt/format.h>

#include "assembly/error.hpp"

namespace cupola {

BondPattern running_bond(const RunningBond& bond, const BondGrid& grid) {
  const int m = bond.slices_per_block;
  if (m % 2 != 0)
    throw InputError(fmt::format(
        "geometry.bond.slices_per_block = {}: must be even, odd rings are shifted by half a block", m));
  const int num_slices = bond.blocks_per_ring * m;

  BondPattern pattern;
  pattern.num_rings = grid.num_rings;
  for (int s = 0; s <= num_slices; ++s) pattern.cuts.push_back(grid.extent * s / num_slices);
  pattern.block_of.resize(static_cast<size_t>(grid.num_rings) * num_slices);

  for (int ring = 0; ring < grid.num_rings; ++ring) {
    const int shift = ring % 2 == 0 ? 0 : m / 2;
    const int first_block = static_cast<int>(pattern.blocks.size());
    const int num_blocks = grid.closed || shift == 0 ? bond.blocks_per_ring : bond.blocks_per_ring + 1;
    pattern.blocks.resize(pattern.blocks.size() + num_blocks);
    for (int s = 0; s < num_slices; ++s) {
      // Closed: the block that the shift pushes over the end of the ring begins in it, so it comes last.
      const int slot =
          grid.closed ? (s - shift + num_slices) % num_slices / m : (s + m - shift) / m - (shift == 0);
      pattern.at(ring, s) = first_block + slot;
    }
  }
  return pattern;
}

}  // namespace cupola
