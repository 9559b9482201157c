#include "generators/bond/herringbone.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/error.hpp"

namespace cupola {
namespace {

constexpr double kCornerPhase =
    1.0 / 6.0;  // block widths: with three verticals per block no joint meets a corner

/// The bond in units of one vertical's width.
struct Layout {
  const HerringboneBond& bond;
  bool closed;
  int num_rings;
  int num_units;          // around, or along
  int offset;             // units from 0 to the first strip, on an open surface
  BondPattern pattern{};  // block_of in units

  int strip_start(int strip) const { return offset + strip * num_units / bond.spirals; }
  int column(int vertical) const {
    if (bond.path == HerringboneBond::Path::spiral) return vertical;
    const int n = bond.rings_per_vertical;
    return (vertical % n + n) % n;
  }
  int new_block(BlockKind kind, bool truncated, int strip) {
    pattern.blocks.push_back({kind, truncated, strip});
    return static_cast<int>(pattern.blocks.size()) - 1;
  }
  bool contains(int unit) const { return closed || (unit >= 0 && unit < num_units); }
  int& at(int ring, int unit) {
    return pattern
        .block_of[static_cast<size_t>(ring) * num_units + (unit % num_units + num_units) % num_units];
  }
};

void lay_verticals(Layout* layout) {
  const int height = layout->bond.rings_per_vertical;
  for (int strip = 0; strip < layout->bond.spirals; ++strip)
    for (int j = 1 - height; j < layout->num_rings; ++j) {
      const int unit = layout->strip_start(strip) + layout->column(j);
      if (!layout->contains(unit)) continue;
      const int bottom = std::max(j, 0), top = std::min(j + height, layout->num_rings);
      const int block = layout->new_block(BlockKind::herringbone, top - bottom < height, strip);
      for (int ring = bottom; ring < top; ++ring) layout->at(ring, unit) = block;
    }
}

/// Lays whole blocks from unit `from`, `count` units towards `step` = +1 or -1. The last block takes the
/// rest: 2/3 to 4/3 of a whole one when the run allows.
void lay_run(Layout* layout, int ring, int from, int count, int step) {
  if (count <= 0) return;
  const int whole = layout->bond.verticals_per_block;
  const int num_blocks = std::max(1, (2 * count + whole) / (2 * whole));
  for (int n = 0; n < num_blocks; ++n) {
    const int block = layout->new_block(BlockKind::standard, false, -1);
    const int end = n + 1 < num_blocks ? (n + 1) * whole : count;
    for (int i = n * whole; i < end; ++i) layout->at(ring, from + step * i) = block;
  }
}

void lay_whole_blocks(Layout* layout) {
  const HerringboneBond& bond = layout->bond;
  const bool spiral = bond.path == HerringboneBond::Path::spiral;
  for (int ring = 0; ring < layout->num_rings; ++ring) {
    const int climb = spiral ? ring - bond.rings_per_vertical + 1 : 0;
    for (int strip = 0; strip < bond.spirals; ++strip) {
      const int left = layout->strip_start(strip) + climb;  // edges of the strip in this ring
      const int right = left + bond.rings_per_vertical;
      if (layout->closed) {
        const int next = strip + 1 < bond.spirals ? layout->strip_start(strip + 1)
                                                  : layout->strip_start(0) + layout->num_units;
        lay_run(layout, ring, right, next + climb - right, +1);
      } else {
        const int from = std::clamp(right, 0, layout->num_units), to = std::clamp(left, 0, layout->num_units);
        lay_run(layout, ring, from, layout->num_units - from, +1);
        lay_run(layout, ring, to - 1, to, -1);
      }
    }
  }
}

void check(const HerringboneBond& bond, const BondGrid& grid, int num_units, double phase_units) {
  if (grid.closed && num_units / bond.spirals < bond.rings_per_vertical)
    throw InputError(fmt::format(
        "geometry.bond.spirals = {}: with {} verticals each they do not fit into the {} that a ring holds",
        bond.spirals, bond.rings_per_vertical, num_units));
  if (!grid.closed && bond.spirals != 1)
    throw InputError(fmt::format("geometry.bond.spirals = {}: a wall has one strip, say 1", bond.spirals));
  if (!grid.closed && phase_units != std::round(phase_units))
    throw InputError(fmt::format(
        "geometry.bond.phase = {}: on a wall it must be a whole number of verticals, i.e. a multiple of 1/{}",
        *bond.phase, bond.verticals_per_block));
}

}  // namespace

BondPattern herringbone_bond(const HerringboneBond& bond, const BondGrid& grid) {
  const int num_units = bond.blocks_per_ring * bond.verticals_per_block;
  const double phase =
      bond.verticals_per_block * bond.phase.value_or(grid.corners.empty() ? 0.0 : kCornerPhase);
  check(bond, grid, num_units, phase);
  const int whole = static_cast<int>(std::floor(phase));
  Layout layout{bond, grid.closed, grid.num_rings, num_units, whole, {}};
  layout.pattern.block_of.assign(static_cast<size_t>(grid.num_rings) * num_units, -1);
  lay_verticals(&layout);
  lay_whole_blocks(&layout);

  BondPattern pattern;
  pattern.num_rings = grid.num_rings;
  pattern.blocks = std::move(layout.pattern.blocks);
  pattern.cuts =
      lattice_cuts(grid.extent, grid.extent * (phase - whole) / num_units, num_units * bond.refine);
  for (int ring = 0; ring < grid.num_rings; ++ring)
    for (int slice = 0; slice < num_units * bond.refine; ++slice)
      pattern.block_of.push_back(layout.at(ring, slice / bond.refine));
  if (bond.chirality == HerringboneBond::Chirality::left) mirror(grid.extent, &pattern);
  split_at_corners(grid, &pattern);
  return pattern;
}

}  // namespace cupola
