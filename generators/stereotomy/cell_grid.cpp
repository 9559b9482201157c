#include "generators/stereotomy/cell_grid.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// Marks the cuts at these places, on a closed surface also an extent before and behind them.
void mark_cuts(const SurfaceMap& surface, const std::vector<double>& places, char as,
               const std::vector<double>& cuts, std::vector<char>* corner) {
  const double rounding = 1e-9 * surface.extent;
  for (const double place : places)
    for (const double turn : {-surface.extent, 0.0, surface.extent}) {
      if (!surface.closed && turn != 0.0) continue;
      const double at = place + turn;
      for (auto cut = std::ranges::upper_bound(cuts, at - rounding);
           cut != cuts.end() && *cut < at + rounding; ++cut)
        (*corner)[static_cast<size_t>(cut - cuts.begin())] = as;
    }
}

void mark_corners(CellGrid* grid) {
  for (int ring = 0; ring < (grid->bond.by_course() ? grid->bond.num_rings : 1); ++ring) {
    const std::vector<double>& cuts = grid->bond.cuts_of(ring);
    grid->corner.emplace_back(cuts.size(), '\0');
    mark_cuts(grid->surface, grid->surface.facets, 1, cuts, &grid->corner.back());
    mark_cuts(grid->surface, grid->surface.corners, 2, cuts, &grid->corner.back());
  }
}

/// Wythes [start, end) that a block occupies.
std::pair<int, int> wythes_of(const CellGrid& grid, int block) {
  int start = grid.num_wythes, end = 0;
  for (const int cell : grid.cells[block]) {
    start = std::min(start, cell % grid.num_wythes);
    end = std::max(end, cell % grid.num_wythes + 1);
  }
  return {start, end};
}

/// True if a block occupies the same slices and wythes in all its rows.
bool is_box(const CellGrid& grid, int block) {
  const auto [from, to] = wythes_of(grid, block);
  const int first = grid.first_row(block), last = grid.last_row(block);
  const auto slices = slices_in_row(grid, block, first);
  for (int row = first; row <= last; ++row)
    if (slices_in_row(grid, block, row) != slices) return false;
  const size_t cells = static_cast<size_t>(last - first + 1) * (slices.second - slices.first) * (to - from);
  return grid.cells[block].size() == cells;
}

/// Appends the cells of one row of a box, merged up to the next corner if the surface allows it.
void append_row(const CellGrid& grid, int row, std::pair<int, int> slices, std::pair<int, int> wythes,
                std::vector<CellRange>* ranges) {
  for (int s = slices.first; s < slices.second; ++s) {
    if (grid.surface.flat_slices && s > slices.first && !grid.ends_facet(row, s))
      ranges->back().slice_end = s + 1;
    else
      ranges->push_back({row, row + 1, s, s + 1, wythes.first, wythes.second});
  }
}

/// True if any cell of the range satisfies `test`. The range may lie beyond the seam, not beyond the grid.
template <class Test>
bool any_cell(const CellRange& range, const Test& test) {
  for (int row = range.row_start; row < range.row_end; ++row)
    for (int slice = range.slice_start; slice < range.slice_end; ++slice)
      for (int wythe = range.wythe_start; wythe < range.wythe_end; ++wythe)
        if (test(row, slice, wythe)) return true;
  return false;
}

int owner_of(const CellGrid& grid, const CellRange& range) {
  return grid.owner(range.row_start, range.slice_start, range.wythe_start);
}

/// The cells of a course above or below that a range meets: those of the same cuts, or, where courses have
/// cuts of their own, those between the same abscissae.
CellRange in_row(const CellGrid& grid, const CellRange& range, int row) {
  CellRange out = range;
  out.row_start = row;
  out.row_end = row + 1;
  if (!grid.bond.by_course() || row < 0 || row >= grid.num_rows ||
      grid.ring_index(row) == grid.ring_index(range.row_start))
    return out;
  const double rounding = 1e-9 * grid.surface.extent;
  const double from = grid.abscissa(range.row_start, range.slice_start) + rounding,
               to = grid.abscissa(range.row_start, range.slice_end) - rounding;
  const std::vector<double>& cuts = grid.bond.cuts_of(grid.ring_index(row));
  const double turns = std::floor((from - cuts.front()) / grid.surface.extent);
  const auto above = std::ranges::upper_bound(cuts, from - turns * grid.surface.extent);
  out.slice_start =
      static_cast<int>(above - cuts.begin()) - 1 + static_cast<int>(turns) * grid.slices_of(row);
  out.slice_end = out.slice_start + 1;
  while (grid.abscissa(row, out.slice_end) < to) ++out.slice_end;
  return out;
}

/// Kind of the face between a range and the cells `beyond` it: `joint` if one of them is built.
FaceKind face_kind(const CellGrid& grid, const CellRange& range, const CellRange& beyond, FaceKind joint) {
  if (owner_of(grid, beyond) == owner_of(grid, range)) return FaceKind::internal;
  const auto is_built = [&](int row, int slice, int wythe) { return grid.is_built(row, slice, wythe); };
  return any_cell(beyond, is_built) ? joint : FaceKind::free;
}

}  // namespace

double CellGrid::abscissa(int row, int cut) const {
  const std::vector<double>& cuts = bond.cuts_of(ring_index(row));
  if (!surface.closed) return cuts[cut];
  return cuts[wrap(row, cut)] + (cut < 0 ? -surface.extent : cut >= slices_of(row) ? surface.extent : 0.0);
}

std::pair<int, int> slices_in_row(const CellGrid& grid, int block, int row) {
  const auto& cells = grid.cells[block];
  const auto begin = std::ranges::lower_bound(cells, grid.cell(row, 0, 0));
  const auto end = std::ranges::lower_bound(cells, grid.cell(row + 1, 0, 0));
  CUPOLA_ASSERT(begin < end);
  const auto slice_of = [&](int cell) { return cell / grid.num_wythes % grid.num_slices; };
  int start = slice_of(*begin), count = 1;
  int seam = -1;  // the slice behind a gap, where a block across the seam starts
  for (auto cell = begin + 1; cell < end; ++cell) {
    const int slice = slice_of(*cell), before = slice_of(*(cell - 1));
    if (slice == before) continue;
    ++count;
    if (slice != before + 1) seam = slice;
  }
  if (grid.surface.closed && seam >= 0) start = seam;
  return {start, start + count};
}

CellGrid make_cell_grid(const SurfaceMap& surface, const BondPattern& bond, int stage_rings) {
  CUPOLA_ASSERT(bond.num_rings * surface.rows_per_ring == surface.num_rows);
  CUPOLA_ASSERT(bond.num_wythes == surface.num_wythes());
  CellGrid grid{surface, bond, surface.num_rows, bond.num_slices(), bond.num_wythes, {}, {}, {}, {}};
  mark_corners(&grid);
  const int num_blocks = static_cast<int>(bond.blocks.size());
  grid.cells.resize(num_blocks);
  for (int row = 0; row < grid.num_rows; ++row)
    for (int slice = 0; slice < grid.slices_of(row); ++slice)
      for (int wythe = 0; wythe < grid.num_wythes; ++wythe)
        if (const int block = grid.owner(row, slice, wythe); block != kVoid)
          grid.cells[block].push_back(grid.cell(row, slice, wythe));

  // First row, slice and wythe, which give the order.
  std::vector<std::tuple<int, int, int>> start(num_blocks);
  grid.built.assign(num_blocks, 0);
  for (int b = 0; b < num_blocks; ++b) {
    CUPOLA_ASSERT(!grid.cells[b].empty());
    const int row = grid.first_row(b);
    start[b] = {row, slices_in_row(grid, b, row).first, wythes_of(grid, b).first};
    const int from_first = grid.ring_of(row) - surface.rings_below,
              from_last = surface.num_rings() - 1 - grid.ring_of(grid.last_row(b)) + surface.rings_below;
    const int above = surface.last_bed_held ? std::min(from_first, from_last) : from_first;
    if (stage_rings > 0 && above >= stage_rings) continue;
    grid.built[b] = 1;
    grid.order.push_back(b);
  }
  std::ranges::sort(grid.order, {}, [&](int b) { return start[b]; });
  return grid;
}

std::vector<CellRange> convex_ranges(const CellGrid& grid, int block) {
  std::vector<CellRange> ranges;
  if (!is_box(grid, block)) {
    for (const int cell : grid.cells[block]) {
      const int wythe = cell % grid.num_wythes, slice = cell / grid.num_wythes % grid.num_slices;
      const int row = cell / (grid.num_wythes * grid.num_slices);
      ranges.push_back({row, row + 1, slice, slice + 1, wythe, wythe + 1});
    }
    return ranges;
  }
  const auto slices = slices_in_row(grid, block, grid.first_row(block));
  const auto wythes = wythes_of(grid, block);
  for (int row = grid.first_row(block); row <= grid.last_row(block); ++row) {
    const size_t below = ranges.size();
    append_row(grid, row, slices, wythes, &ranges);
    const bool stacks = grid.surface.flat_rings && below > 0 && ranges.size() == below + 1 &&
                        ranges[below - 1].row_end == row &&
                        ranges[below - 1].slice_start == ranges[below].slice_start &&
                        ranges[below - 1].slice_end == ranges[below].slice_end;
    if (!stacks) continue;
    ranges[below - 1].row_end = row + 1;
    ranges.pop_back();
  }
  return ranges;
}

FaceKind bed_kind(const CellGrid& grid, const CellRange& range, bool upper) {
  const CellRange beyond = in_row(grid, range, upper ? range.row_end : range.row_start - 1);
  const bool below = beyond.row_start < 0, above = beyond.row_start == grid.num_rows;
  if (grid.is_support(owner_of(grid, range)) && (below || above)) return FaceKind::free;
  if (below) return FaceKind::bed;
  if (above) return grid.surface.carries ? FaceKind::bed : FaceKind::top;
  const FaceKind kind = face_kind(grid, range, beyond, FaceKind::bed);
  const bool rises = upper || (grid.surface.last_bed_held && 2 * range.row_start > grid.num_rows);
  if (kind != FaceKind::free || !rises) return kind;
  const auto is_to_be_built = [&](int row, int slice, int wythe) {
    return grid.owner(row, slice, wythe) != kVoid;
  };
  return any_cell(beyond, is_to_be_built) ? FaceKind::top : FaceKind::free;
}

FaceKind head_kind(const CellGrid& grid, const CellRange& range, bool right) {
  CellRange beyond = range;
  beyond.slice_start = right ? range.slice_end : range.slice_start - 1;
  beyond.slice_end = beyond.slice_start + 1;
  if (!grid.surface.closed && (beyond.slice_start < 0 || beyond.slice_start == grid.num_slices))
    return FaceKind::free;
  return face_kind(grid, range, beyond, FaceKind::head);
}

FaceKind layer_kind(const CellGrid& grid, const CellRange& range, bool outer) {
  CellRange beyond = range;  // all wythes, then the next
  beyond.wythe_start = outer ? range.wythe_end : 0;
  beyond.wythe_end = outer ? grid.num_wythes : range.wythe_start;
  const auto is_laid = [&](int row, int slice, int wythe) { return grid.owner(row, slice, wythe) != kVoid; };
  if (!any_cell(beyond, is_laid)) return outer ? FaceKind::extrados : FaceKind::intrados;
  beyond.wythe_start = outer ? range.wythe_end : range.wythe_start - 1;
  beyond.wythe_end = beyond.wythe_start + 1;
  return face_kind(grid, range, beyond, FaceKind::wythe);
}

}  // namespace cupola
