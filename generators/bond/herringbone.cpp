#include "generators/bond/herringbone.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

constexpr double kHerringboneCornerPhase =
    1.0 / 6.0;  // block widths: with three verticals per block no joint meets a corner

/// The bond in slices, `slices_per_vertical` of them to a vertical's width. A band is what the case calls a
/// spiral or strip: `refine` strips side by side, each with `rings_per_vertical` verticals in every ring.
struct Layout {
  const HerringboneBond& bond;
  bool closed;
  int num_rings;
  int num_slices;         // around, or along
  int offset;             // slices from 0 to the first band
  BondPattern pattern{};  // blocks and block_of

  int whole() const { return bond.verticals_per_block * bond.slices_per_vertical; }
  int strip_width() const { return bond.rings_per_vertical * bond.slices_per_vertical; }
  int band_width() const { return bond.refine * strip_width(); }
  /// First slice of a band. A refined one is moved back, so that in the first course of each unrefined ring
  /// it begins where the unrefined band does.
  int band_start(int band) const {
    const bool climbs = bond.path == HerringboneBond::Path::spiral;
    const int ahead = climbs ? (bond.rings_per_vertical - 1) * (bond.refine - 1) : 0;
    const int num_verticals = num_slices / bond.slices_per_vertical;  // widths of one, all round
    return offset + (band * num_verticals / bond.spirals - ahead) * bond.slices_per_vertical;
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
  const HerringboneBond& bond = layout->bond;
  const int height = bond.rings_per_vertical, width = bond.slices_per_vertical;
  for (int strip = 0; strip < bond.spirals * bond.refine; ++strip) {
    const int band = strip / bond.refine;
    const int start = layout->band_start(band) + strip % bond.refine * layout->strip_width();
    for (int j = 1 - height; j < layout->num_rings; ++j) {
      const int left = start + layout->column(j) * width;
      if (!layout->contains(left)) continue;
      const int bottom = std::max(j, 0), top = std::min(j + height, layout->num_rings);
      const int block = layout->new_block(BlockKind::herringbone, top - bottom < height, band);
      for (int ring = bottom; ring < top; ++ring)
        for (int slice = left; slice < left + width; ++slice) layout->at(ring, slice) = block;
    }
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
    const int climb = spiral ? (ring - bond.rings_per_vertical + 1) * bond.slices_per_vertical : 0;
    for (int band = 0; band < bond.spirals; ++band) {
      const int left = layout->band_start(band) + climb;  // edges of the band in this ring
      const int right = left + layout->band_width();
      if (layout->closed) {
        const int next = band + 1 < bond.spirals ? layout->band_start(band + 1)
                                                 : layout->band_start(0) + layout->num_slices;
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

void check(const HerringboneBond& bond, const BondGrid& grid, double phase_units) {
  const int num_verticals = bond.blocks_per_ring * bond.verticals_per_block;
  if (grid.closed && num_verticals / bond.spirals < bond.rings_per_vertical)
    throw InputError(fmt::format(
        "geometry.bond.spirals = {}: with {} verticals each they do not fit into the {} that a ring holds",
        bond.spirals, bond.rings_per_vertical, num_verticals));
  if (!grid.closed && bond.spirals != 1)
    throw InputError(fmt::format("geometry.bond.spirals = {}: a wall has one strip, say 1", bond.spirals));
  if (!grid.closed && phase_units != std::round(phase_units))
    throw InputError(fmt::format(
        "geometry.bond.phase = {}: on a wall it must be a whole number of verticals, i.e. a multiple of 1/{}",
        *bond.phase, bond.verticals_per_block));
}

/// Widths of a vertical from the first corner to the first band. By default joints lie half a width off the
/// corners.
double phase_in_verticals(const HerringboneBond& bond, const BondGrid& grid) {
  if (bond.phase) return *bond.phase * bond.verticals_per_block * bond.refine;
  if (grid.corners.empty()) return 0.0;
  const int half_refined = (bond.refine - 1) / 2;  // whole verticals
  return bond.verticals_per_block * kHerringboneCornerPhase + half_refined;
}

}  // namespace

BondPattern herringbone_bond(const HerringboneBond& bond, const BondGrid& grid) {
  const int num_verticals = bond.blocks_per_ring * bond.verticals_per_block * bond.refine;
  const int num_slices = num_verticals * bond.slices_per_vertical;
  const double phase = phase_in_verticals(bond, grid);
  check(bond, grid, phase);
  const int whole = static_cast<int>(std::floor(phase));
  Layout layout{bond, grid.closed, grid.num_rings, num_slices, whole * bond.slices_per_vertical, {}};
  layout.pattern.block_of.assign(static_cast<size_t>(grid.num_rings) * num_slices, -1);
  lay_verticals(&layout);
  lay_whole_blocks(&layout);

  BondPattern pattern = std::move(layout.pattern);
  pattern.num_rings = grid.num_rings;
  pattern.cuts = lattice_cuts(grid.extent, grid.extent * (phase - whole) / num_verticals, num_slices);
  if (bond.chirality == HerringboneBond::Chirality::left) mirror(grid.extent, &pattern);
  split_at_corners(grid, &pattern);
  return pattern;
}

}  // namespace cupola
