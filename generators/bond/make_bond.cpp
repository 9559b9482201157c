#include "generators/bond/make_bond.hpp"

#include <algorithm>

#include "assembly/base/error.hpp"
#include "assembly/base/variant.hpp"
#include "generators/bond/courses.hpp"
#include "generators/bond/drawn.hpp"
#include "generators/bond/fill.hpp"
#include "generators/bond/herringbone.hpp"

namespace cupola {
namespace {

/// Every cell of the grid has a block or is empty, and the cuts are ascending.
[[maybe_unused]] bool is_complete(const BondPattern& pattern, const BondGrid& grid) {
  const int num_blocks = static_cast<int>(pattern.blocks.size());
  return pattern.num_rings == grid.num_rings && std::ranges::is_sorted(pattern.cuts) &&
         pattern.block_of.size() == static_cast<size_t>(pattern.num_rings) * pattern.num_slices() &&
         std::ranges::all_of(pattern.block_of,
                             [&](int block) { return block >= kVoid && block < num_blocks; });
}

BondPattern lay(const Bond& bond, const BondGrid& grid) {
  return std::visit(Overloaded{[&](const RunningBond& b) { return running_bond(b, grid); },
                               [&](const StackBond& b) { return stack_bond(b, grid); },
                               [&](const HerringboneBond& b) { return herringbone_bond(b, grid); },
                               [&](const FillBond& b) { return fill_bond(b, grid); },
                               [&](const DrawnBond& b) { return drawn_bond(b, grid); }},
                    bond);
}

/// Phases count from the first corner of the window.
BondPattern lay_window(const Bond& bond, const BondGrid& grid) {
  BondGrid ring = grid;
  ring.closed = true;
  const double shift = grid.corners.empty() ? 0.0 : grid.corners.front();
  for (double& corner : ring.corners) corner -= shift;
  BondPattern pattern = lay(bond, ring);
  open_ring(grid.extent, shift, &pattern);
  return pattern;
}

}  // namespace

BondPattern make_bond(const Bond& bond, const BondGrid& grid) {
  BondPattern pattern = grid.window ? lay_window(bond, grid) : lay(bond, grid);
  CUPOLA_ASSERT(is_complete(pattern, grid));
  return pattern;
}

int refinement_of(const Bond& bond) {
  return std::visit([](const auto& b) { return b.refine; }, bond);
}

}  // namespace cupola
