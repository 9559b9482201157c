#include "generators/bond/herringbone.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"

namespace cupola {
namespace {

// Widths of a vertical. No joint beside a spiral then lies on a corner.
constexpr double kHerringboneCornerPhase = 0.5;

/// The bond while it is being laid. All lengths are in slices; a vertical is `slices_per_vertical` slices
/// wide. A band is one spiral or meridian strip of the case: `refine` strips side by side, each with
/// `rings_per_vertical` verticals in every ring.
struct Layout {
  const HerringboneBond& bond;
  bool closed;
  int num_rings;
  int num_slices;         // per ring
  int built;              // rings of the stage
  int offset;             // from abscissa 0 to the first band
  bool bricks = false;    // of a window
  int mirrored = -1;      // slice s and slice mirrored - s lie at opposite sides of abscissa 0
  BondPattern pattern{};  // only its blocks and block_of

  int whole() const { return bond.verticals_per_block * bond.slices_per_vertical; }
  /// Rings from the start of a vertical to that of the next one.
  int rise() const { return bond.embedment < 0 ? 1 : bond.rings_per_vertical; }
  int strip_width() const { return bond.rings_per_vertical / rise() * bond.slices_per_vertical; }
  /// First ring of vertical 0. With an embedment, that of a vertical lies so many rings below the last one
  /// built.
  int first_ring() const {
    return bond.embedment < 0 ? 0 : (built - 1 - bond.embedment) % bond.rings_per_vertical;
  }
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
    const int n = bond.rings_per_vertical / rise();
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

/// Lays a vertical over rings [bottom, top) from slice `left`, where no other lies. A vertical that crosses
/// one of the other hand is cut, into two if it reaches beyond it on both sides.
void lay_vertical(Layout* layout, int left, int bottom, int top, int band) {
  const int width = layout->bond.slices_per_vertical, height = layout->bond.rings_per_vertical;
  for (int ring = bottom; ring < top; ++ring) {
    if (layout->at(ring, left) >= 0) continue;
    int end = ring + 1;
    while (end < top && layout->at(end, left) < 0) ++end;
    const int block = layout->new_block(BlockKind::herringbone, end - ring < height, band);
    for (; ring < end; ++ring)
      for (int slice = left; slice < left + width; ++slice) layout->at(ring, slice) = block;
  }
}

void lay_verticals(Layout* layout, bool mirrored) {
  const HerringboneBond& bond = layout->bond;
  const int height = bond.rings_per_vertical, width = bond.slices_per_vertical;
  for (int strip = 0; strip < bond.spirals * bond.refine; ++strip) {
    const int band = strip / bond.refine;
    const int start = layout->band_start(band) + strip % bond.refine * layout->strip_width();
    for (int j = 1 - height;; ++j) {
      const int first = layout->first_ring() + j * layout->rise();
      if (first >= layout->num_rings) break;
      const int left = start + layout->column(j) * width;
      const int bottom = std::max(first, 0), top = std::min(first + height, layout->num_rings);
      if (top <= bottom || !layout->contains(left)) continue;
      if (mirrored)
        lay_vertical(layout, layout->mirrored - left - width + 1, bottom, top, bond.spirals + band);
      else
        lay_vertical(layout, left, bottom, top, band);
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
/// the first and the last block; a remainder narrower than half a block is added to its neighbour. Bricks, of
/// windows, are never wider than a whole one: there the two share their width.
void lay_run(Layout* layout, int ring, int from, int count, int step) {
  if (count <= 0) return;
  const int whole = layout->whole();
  int laid = 0;
  const auto lay = [&](int end) {
    const int block = layout->new_block(BlockKind::standard, end - laid != whole, -1);
    for (; laid < end; ++laid) layout->at(ring, from + step * laid) = block;
  };
  int end = first_width(*layout, ring, step > 0 ? from : from + 1, step);
  if (2 * end < whole) end += whole;
  while (laid < count) {
    if (2 * (count - end) < whole) end = count;
    if (layout->bricks && end - laid > whole) lay(laid + (end - laid + 1) / 2);
    lay(end);
    end += whole;
  }
}

/// Lays the slices between the verticals of each ring from left to right. On an open surface the run before
/// the first vertical is laid from there to the left, as is a ring that lies above the strip.
void lay_whole_blocks(Layout* layout) {
  const int num_slices = layout->num_slices;
  for (int ring = 0; ring < layout->num_rings; ++ring) {
    int first = 0;  // the runs of a closed ring start behind a vertical
    if (layout->closed)
      while (layout->at(ring, first - 1) < 0) ++first;
    for (int from = first; from < first + num_slices; ++from) {
      if (layout->at(ring, from) >= 0) continue;
      int end = from + 1;
      while (end < first + num_slices && layout->at(ring, end) < 0) ++end;
      if (!layout->closed && from == 0)
        lay_run(layout, ring, end - 1, end - from, -1);
      else
        lay_run(layout, ring, from, end - from, +1);
      from = end;
    }
  }
}

void check_fit(const HerringboneBond& bond, const BondGrid& grid, double phase_in_verticals) {
  const int num_verticals = bond.blocks_per_ring * bond.verticals_per_block;
  const bool both = bond.chirality == HerringboneBond::Chirality::both;
  const int width = (both ? 2 : 1) * (bond.embedment < 0 ? bond.rings_per_vertical : 1);
  if (grid.closed && num_verticals / bond.spirals < width)
    throw InputError(
        fmt::format("geometry.bond.spirals = {}: spirals of {} do not fit into a ring that is {} "
                    "verticals wide",
                    bond.spirals, counted(width, "vertical"), num_verticals));
  if (!grid.closed && both)
    throw InputError("geometry.bond.chirality = both: requires a closed surface or a window");
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
  return kHerringboneCornerPhase + half_refined;
}

}  // namespace

BondPattern herringbone_bond(const HerringboneBond& bond, const BondGrid& grid) {
  const int num_verticals = bond.blocks_per_ring * bond.verticals_per_block * bond.refine;
  const int num_slices = num_verticals * bond.slices_per_vertical;
  const double phase = first_band_phase(bond, grid);
  check_fit(bond, grid, phase);
  const int whole = static_cast<int>(std::floor(phase));
  Layout layout{bond,
                grid.closed,
                grid.num_rings,
                num_slices,
                grid.built > 0 ? grid.built : grid.num_rings,
                whole * bond.slices_per_vertical};
  layout.bricks = grid.window;
  layout.mirrored = -1 - bond.slices_per_vertical * static_cast<int>(std::lround(2.0 * (phase - whole)));
  layout.pattern.block_of.assign(static_cast<size_t>(grid.num_rings) * num_slices, -1);
  lay_verticals(&layout, false);
  if (bond.chirality == HerringboneBond::Chirality::both) lay_verticals(&layout, true);
  lay_whole_blocks(&layout);

  BondPattern pattern = std::move(layout.pattern);
  pattern.num_rings = grid.num_rings;
  pattern.cuts = equal_cuts(grid.extent, grid.extent * (phase - whole) / num_verticals, num_slices);
  if (bond.chirality == HerringboneBond::Chirality::left) mirror(grid.extent, &pattern);
  split_at_corners(grid, &pattern);
  return pattern;
}

}  // namespace cupola
