#include "generators/bond/herringbone.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"

namespace cupola {
namespace {

// Block widths. With three verticals per block no joint then lies on a corner.
constexpr double kHerringboneCornerPhase = 1.0 / 6.0;

/// The bond while it is being laid. All lengths are in slices; a vertical is `slices_per_vertical` slices
/// wide. A band is one spiral or meridian strip of the case: `refine` strips side by side, each with
/// `rings_per_vertical` verticals in every ring.
struct Layout {
  const HerringboneBond& bond;
  bool closed;
  int num_rings;
  int num_slices;         // per ring
  int offset;             // from abscissa 0 to the first band
  BondPattern pattern{};  // only its blocks and block_of

  int whole() const { return bond.verticals_per_block * bond.slices_per_vertical; }
  int strip_width() const { return bond.rings_per_vertical * bond.slices_per_vertical; }
  int band_width() const { return bond.refine * strip_width(); }
  /// First slice of a band in ring rings_per_vertical - 1 (in any ring on a meridian path). A refined band is
  /// moved back, so that it starts where the unrefined band does in the first course of each unrefined ring.
  int band_start(int band) const {
    const bool climbs = bond.path == HerringboneBond::Path::spiral;
    const int ahead = climbs ? (bond.rings_per_vertical - 1) * (bond.refine - 1) : 0;
    const int num_verticals = num_slices / bond.slices_per_vertical;  // side by side, per ring
    return offset + (band * num_verticals / bond.spirals - ahead) * bond.slices_per_vertical;
  }
  /// Widths of a vertical from the start of its strip.
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

/// Width of the first block of a run from `edge` in the direction `step`, i.e. the distance to the next
/// joint.
int first_width(const Layout& layout, int ring, int edge, int step) {
  const int whole = layout.whole();
  if (layout.bond.beside == HerringboneBond::Beside::stepped) return whole;
  const bool shifted = layout.bond.beside == HerringboneBond::Beside::half && ring % 2 != 0;
  const int joint = layout.offset + (shifted ? whole / 2 : 0);  // the others follow every `whole` slices
  const int ahead = (step * (joint - edge) % whole + whole) % whole;
  return ahead == 0 ? whole : ahead;
}

/// Lays blocks over `count` slices from slice `from` in the direction `step` = +1 or -1. The strips may cut
/// the first and the last block; a remainder narrower than half a block is added to its neighbour.
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
      const int left = layout->band_start(band) + climb;  // first slice of the band in this ring
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

void check_fit(const HerringboneBond& bond, const BondGrid& grid, double phase_in_verticals) {
  const int num_verticals = bond.blocks_per_ring * bond.verticals_per_block;
  if (grid.closed && num_verticals / bond.spirals < bond.rings_per_vertical)
    throw InputError(
        fmt::format("geometry.bond.spirals = {}: spirals of {} do not fit into a ring that is {} "
                    "verticals wide",
                    bond.spirals, counted(bond.rings_per_vertical, "vertical"), num_verticals));
  if (!grid.closed && bond.spirals != 1)
    throw InputError(fmt::format("geometry.bond.spirals = {}: must be 1 on an open surface", bond.spirals));
  if (!grid.closed && phase_in_verticals != std::round(phase_in_verticals))
    throw InputError(
        fmt::format("geometry.bond.phase = {}: must be a multiple of 1/{} on an open surface, a whole number "
                    "of verticals",
                    *bond.phase, bond.verticals_per_block));
}

/// Distance of the first band from the first corner, in widths of a vertical. By default joints lie half a
/// width off the corners.
double first_band_phase(const HerringboneBond& bond, const BondGrid& grid) {
  if (bond.phase) return *bond.phase * bond.verticals_per_block * bond.refine;
  if (grid.corners.empty()) return 0.0;
  const int half_refined = (bond.refine - 1) / 2;  // rounded down to whole verticals
  return bond.verticals_per_block * kHerringboneCornerPhase + half_refined;
}

}  // namespace

BondPattern herringbone_bond(const HerringboneBond& bond, const BondGrid& grid) {
  const int num_verticals = bond.blocks_per_ring * bond.verticals_per_block * bond.refine;
  const int num_slices = num_verticals * bond.slices_per_vertical;
  const double phase = first_band_phase(bond, grid);
  check_fit(bond, grid, phase);
  const int whole = static_cast<int>(std::floor(phase));
  Layout layout{bond, grid.closed, grid.num_rings, num_slices, whole * bond.slices_per_vertical, {}};
  layout.pattern.block_of.assign(static_cast<size_t>(grid.num_rings) * num_slices, -1);
  lay_verticals(&layout);
  lay_whole_blocks(&layout);

  BondPattern pattern = std::move(layout.pattern);
  pattern.num_rings = grid.num_rings;
  pattern.cuts = equal_cuts(grid.extent, grid.extent * (phase - whole) / num_verticals, num_slices);
  if (bond.chirality == HerringboneBond::Chirality::left) mirror(grid.extent, &pattern);
  split_at_corners(grid, &pattern);
  return pattern;
}

}  // namespace cupola
