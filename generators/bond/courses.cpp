#include "generators/bond/courses.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "generators/bond/drawn.hpp"

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

/// Two courses of whole blocks, the upper one moved along by `shift` letters. On a ring the drawing goes
/// round once, so that any number of blocks closes it.
DrawnBond two_courses(int blocks, int letters, int shift) {
  DrawnBond drawing;
  const int columns = blocks * letters;
  for (const int upper : {1, 0}) {
    std::string row;
    for (int c = 0; c < columns; ++c) {
      const int block = (c + columns - upper * shift) % columns / letters;
      const bool closes = block + 1 == blocks && blocks % 2 == 1;  // between two blocks of the first letter
      row += "abcdef"[3 * upper + (closes ? 2 : block % 2)];
    }
    drawing.rows.push_back(row);
  }
  return drawing;
}

template <class Courses>
BondPattern courses(const Courses& bond, int odd_shift, const BondGrid& grid) {
  if (bond.phase && *bond.phase != 0.0 && !grid.closed)
    throw InputError(
        fmt::format("geometry.bond.phase = {}: must be 0 on an open surface, where courses start at the end",
                    *bond.phase));
  const int m = bond.slices_per_block, blocks_per_ring = bond.blocks_per_ring * bond.refine;
  const DrawnBond drawing = two_courses(grid.closed ? std::max(blocks_per_ring, 2) : 2, m, odd_shift);
  BondPattern pattern =
      lay_drawing(drawing, grid, blocks_per_ring * m, m * phase_of(bond.phase, bond.refine, grid));
  std::ranges::fill(pattern.blocks, BondBlock{});  // halves at the ends are as regular as whole blocks
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
