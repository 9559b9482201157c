#include "generators/bond/courses.hpp"

#include <cmath>

#include <fmt/format.h>

#include "assembly/error.hpp"

namespace cupola {
namespace {

constexpr double kCornerPhase =
    0.25;  // block widths: joints of even and odd rings stay equally far from corners

BondPattern courses(int blocks_per_ring, int m, int odd_shift, std::optional<double> phase,
                    const BondGrid& grid) {
  if (phase && *phase != 0.0 && !grid.closed)
    throw InputError(fmt::format(
        "geometry.bond.phase = {}: only closed surfaces have one, a wall starts at its end", *phase));
  const int num_slices = blocks_per_ring * m;
  const double slices = m * phase.value_or(grid.corners.empty() ? 0.0 : kCornerPhase);
  const int whole = static_cast<int>(std::floor(slices));
  BondPattern pattern;
  pattern.num_rings = grid.num_rings;
  pattern.cuts = lattice_cuts(grid.extent, grid.extent * (slices - whole) / num_slices, num_slices);
  pattern.block_of.resize(static_cast<size_t>(grid.num_rings) * num_slices);

  for (int ring = 0; ring < grid.num_rings; ++ring) {
    const int shift = (ring % 2 == 0 ? 0 : odd_shift) + whole;
    const int first_block = static_cast<int>(pattern.blocks.size());
    const bool half_ends = !grid.closed && shift != 0;
    pattern.blocks.resize(pattern.blocks.size() + blocks_per_ring + (half_ends ? 1 : 0));
    for (int s = 0; s < num_slices; ++s) {
      const int slot = grid.closed ? ((s - shift) % num_slices + num_slices) % num_slices / m
                                   : (half_ends ? (s + m - shift) / m : s / m);
      pattern.at(ring, s) = first_block + slot;
    }
  }
  split_at_corners(grid, &pattern);
  return pattern;
}

}  // namespace

BondPattern running_bond(const RunningBond& bond, const BondGrid& grid) {
  const int m = bond.slices_per_block;
  if (m % 2 != 0)
    throw InputError(fmt::format(
        "geometry.bond.slices_per_block = {}: must be even, odd rings are shifted by half a block", m));
  return courses(bond.blocks_per_ring, m, m / 2, bond.phase, grid);
}

BondPattern stack_bond(const StackBond& bond, const BondGrid& grid) {
  return courses(bond.blocks_per_ring, bond.slices_per_block, 0, bond.phase, grid);
}

}  // namespace cupola
