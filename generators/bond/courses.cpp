#include "generators/bond/courses.hpp"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

// Block widths. The joints of even and odd rings are then equally far from the corners.
constexpr double kRunningCornerPhase = 0.25;

/// Phase in widths of the refined blocks. An odd refinement keeps the joints of the unrefined bond; an even
/// one would put joints on the corners and starts from the default phase.
double phase_of(std::optional<double> phase, int refine, const BondGrid& grid) {
  if (phase) return std::fmod(*phase * refine, 1.0);
  if (grid.corners.empty()) return 0.0;
  return refine % 2 == 1 ? std::fmod(kRunningCornerPhase * refine, 1.0) : kRunningCornerPhase;
}

template <class Courses>
BondPattern courses(const Courses& bond, int odd_shift, const BondGrid& grid) {
  if (bond.phase && *bond.phase != 0.0 && !grid.closed)
    throw InputError(
        fmt::format("geometry.bond.phase = {}: must be 0 on an open surface, where courses start at the end",
                    *bond.phase));
  const int m = bond.slices_per_block;
  const int blocks_per_ring = bond.blocks_per_ring * bond.refine;
  const int num_slices = blocks_per_ring * m;
  const double slices = m * phase_of(bond.phase, bond.refine, grid);
  const int whole = static_cast<int>(std::floor(slices));
  BondPattern pattern;
  pattern.num_rings = grid.num_rings;
  pattern.cuts = equal_cuts(grid.extent, grid.extent * (slices - whole) / num_slices, num_slices);
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
        "geometry.bond.slices_per_block = {}: must be even, because odd rings are shifted by half a block",
        m));
  return courses(bond, m / 2, grid);
}

BondPattern stack_bond(const StackBond& bond, const BondGrid& grid) {
  return courses(bond, 0, grid);
}

}  // namespace cupola
