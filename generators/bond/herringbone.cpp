#include "generators/bond/herringbone.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/error.hpp"

namespace cupola {
namespace {

constexpr double kCornerPhase =
    1.0 / 6.0;  // block widths: with three verticals per block no joint meets a corner

/// The bond in slices, `refine` of them to a vertical's width.
struct Layout {
  const HerringboneBond& bond;
  bool closed;
  int num_rings;
  int num_slices;         // around, or along
  int offset;             // slices from 0 to the first strip, on an open surface
  BondPattern pattern{};  // blocks and block_of

  int whole() const { return bond.verticals_per_block * bond.refine; }
  int strip_start(int strip) const {
    return offset + strip * (num_slices / bond.refine) / bond.spirals * bond.refine;
  }
  int column(int vertical) const {
    if (bond.path == HerringboneBond::Path::spiral) return vertical;
    const int n = bond.rings_per_vertical;
    return (vertical % n + n) % n;
  }
  int new_block(BlockKind kind, bool truncated, int strip) {
    pattern.blocks.push_back({kind, truncated, strip});
    return static_cast<int>(pattern.blocks.size()) - 1;
  }
  bool contains(int slice) const { return closed || (slice >= 0 && slice < num_slices); }
  int& at(int ring, int slice) {
    return pattern
        .block_of[static_cast<size_t>(ring) * num_slices + (slice % num_slices + num_slices) % num_slices];
  }
};

void lay_verticals(Layout* layout) {
  const int height = layout->bond.rings_per_vertical, width = layout->bond.refine;
  for (int strip = 0; strip < layout->bond.spirals; ++strip)
    for (int j = 1 - height; j < layout->num_rings; ++j) {
      const int left = layout->strip_start(strip) + layout->column(j) * width;
      if (!layout->contains(left)) continue;
      const int bottom = std::max(j, 0), top = std::min(j + height, layout->num_rings);
      const int block = layout->new_block(BlockKind::herringbone, top - bottom < height, strip);
      for (int ring = bottom; ring < top; ++ring)
        for (int slice = left; slice < left + width; ++slice) layout->at(ring, slice) = block;
    }
}

/// Slices of the first block of a run that goes from the edge `edge` towards `step`.
int first_width(const Layout& layout, int ring, int edge, int step) {
  const int whole = layout.whole();
  if (layout.bond.beside == HerringboneBond::Beside::stepped) return whole;
  const bool shifted = layout.bond.beside == HerringboneBond::Beside::half && ring % 2 != 0;
  const int joint = layout.offset + (shifted ? whole / 2 : 0);  // one of the lattice
  const int ahead = (step * (joint - edge) % whole + whole) % whole;
  return ahead == 0 ? whole : ahead;
}

/// Lays blocks from slice `from`, `count` slices towards `step` = +1 or -1: whole ones between a first and a
/// last that the strips cut. What is narrower than half of a whole one goes to its neighbour.
void lay_run(Layout* layout, int ring, int from, int count, int step) {
  if (count <= 0) return;
  const int whole = layout->whole();
  int end = first_width(*layout, ring, step > 0 ? from : from + 1, step);
  if (2 * end < whole) end += whole;
  for (int laid = 0; laid < count; end += whole) {
    if (2 * (count - end) < whole) end = count;
    const int block = layout->new_block(BlockKind::standard, false, -1);
    for (; laid < end; ++laid) layout->at(ring, from + step * laid) = block;
  }
}

void lay_whole_blocks(Layout* layout) {
  const HerringboneBond& bond = layout->bond;
  const bool spiral = bond.path == HerringboneBond::Path::spiral;
  for (int ring = 0; ring < layout->num_rings; ++ring) {
    const int climb = spiral ? (ring - bond.rings_per_vertical + 1) * bond.refine : 0;
    for (int strip = 0; strip < bond.spirals; ++strip) {
      const int left = layout->strip_start(strip) + climb;  // edges of the strip in this ring
      const int right = left + bond.rings_per_vertical * bond.refine;
      if (layout->closed) {
        const int next = strip + 1 < bond.spirals ? layout->strip_start(strip + 1)
                                                  : layout->strip_start(0) + layout->num_slices;
        lay_run(layout, ring, right, next + climb - right, +1);
      } else {
        const int from = std::clamp(right, 0, layout->num_slices),
                  to = std::clamp(left, 0, layout->num_slices);
        lay_run(layout, ring, from, layout->num_slices - from, +1);
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
  const int num_slices = num_units * bond.refine;
  Layout layout{bond, grid.closed, grid.num_rings, num_slices, whole * bond.refine, {}};
  layout.pattern.block_of.assign(static_cast<size_t>(grid.num_rings) * num_slices, -1);
  lay_verticals(&layout);
  lay_whole_blocks(&layout);

  BondPattern pattern = std::move(layout.pattern);
  pattern.num_rings = grid.num_rings;
  pattern.cuts = lattice_cuts(grid.extent, grid.extent * (phase - whole) / num_units, num_slices);
  if (bond.chirality == HerringboneBond::Chirality::left) mirror(grid.extent, &pattern);
  split_at_corners(grid, &pattern);
  return pattern;
}

}  // namespace cupola
