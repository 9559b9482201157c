#include "generators/stereotomy/cell_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

void mark_corners(CellGrid* grid) {
  grid->corner.assign(grid->num_slices + 1, 0);
  const double extent = grid->surface.extent;
  for (int cut = 0; cut <= grid->num_slices; ++cut)
    for (double corner : grid->surface.corners)
      if (std::abs(grid->surface.closed ? std::remainder(grid->bond.cuts[cut] - corner, extent)
                                        : grid->bond.cuts[cut] - corner) < 1e-9 * extent)
        grid->corner[cut] = 1;
}

/// Appends the cells of one row of a block, merged up to the next corner if the surface allows it.
void append_row(const CellGrid& grid, int block, int row, std::vector<CellRange>* ranges) {
  const auto [start, end] = slices_in_row(grid, block, row);
  for (int s = start; s < end; ++s) {
    if (grid.surface.flat_slices && s > start && !grid.is_corner(s))
      ranges->back().slice_end = s + 1;
    else
      ranges->push_back({row, row + 1, s, s + 1});
  }
}

}  // namespace

double CellGrid::abscissa(int cut) const {
  if (!surface.closed) return bond.cuts[cut];
  return bond.cuts[wrap(cut)] + (cut < 0 ? -surface.extent : cut >= num_slices ? surface.extent : 0.0);
}

std::pair<int, int> slices_in_row(const CellGrid& grid, int block, int row) {
  const auto& cells = grid.cells[block];
  const auto begin = std::ranges::lower_bound(cells, row * grid.num_slices);
  const auto end = std::ranges::lower_bound(cells, (row + 1) * grid.num_slices);
  const int count = static_cast<int>(end - begin);
  CUPOLA_ASSERT(count > 0);
  int start = *begin % grid.num_slices;
  if (grid.surface.closed && count < grid.num_slices)
    for (auto cell = begin + 1; cell < end; ++cell)
      if (*cell != *(cell - 1) + 1)
        start = *cell % grid.num_slices;  // the block crosses the seam and starts here
  return {start, start + count};
}

CellGrid make_cell_grid(const SurfaceMap& surface, const BondPattern& bond, int stage_rings) {
  CUPOLA_ASSERT(bond.num_rings * surface.rows_per_ring == surface.num_rows);
  CellGrid grid{surface, bond, surface.num_rows, bond.num_slices(), {}, {}, {}, {}};
  mark_corners(&grid);
  const int num_blocks = static_cast<int>(bond.blocks.size());
  grid.cells.resize(num_blocks);
  for (int row = 0; row < grid.num_rows; ++row)
    for (int slice = 0; slice < grid.num_slices; ++slice)
      grid.cells[grid.owner(row, slice)].push_back(row * grid.num_slices + slice);

  std::vector<std::pair<int, int>> start(num_blocks);  // first row and slice, which give the order
  grid.built.assign(num_blocks, 0);
  for (int b = 0; b < num_blocks; ++b) {
    CUPOLA_ASSERT(!grid.cells[b].empty());
    start[b] = {grid.first_row(b), slices_in_row(grid, b, grid.first_row(b)).first};
    if (stage_rings > 0 && grid.ring_of(start[b].first) >= stage_rings) continue;
    grid.built[b] = 1;
    grid.order.push_back(b);
  }
  std::ranges::sort(grid.order, {}, [&](int b) { return start[b]; });
  return grid;
}

std::vector<CellRange> convex_ranges(const CellGrid& grid, int block) {
  std::vector<CellRange> ranges;
  for (int row = grid.first_row(block); row <= grid.last_row(block); ++row) {
    const size_t below = ranges.size();
    append_row(grid, block, row, &ranges);
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
  const int beyond = upper ? range.row_end : range.row_start - 1;
  const int self = grid.owner(range.row_start, range.slice_start);
  if (grid.is_support(self) && (beyond < 0 || beyond == grid.num_rows)) return FaceKind::free;
  if (beyond < 0) return FaceKind::bed;
  if (beyond == grid.num_rows)
    return grid.surface.footing == Footing::both_springings ? FaceKind::bed : FaceKind::top;
  if (grid.owner(beyond, range.slice_start) == self) return FaceKind::internal;
  for (int s = range.slice_start; s < range.slice_end; ++s)
    if (grid.built[grid.owner(beyond, s)]) return FaceKind::bed;
  return upper ? FaceKind::top : FaceKind::free;
}

FaceKind head_kind(const CellGrid& grid, const CellRange& range, bool right) {
  const int beyond = right ? range.slice_end : range.slice_start - 1;
  if (!grid.surface.closed && (beyond < 0 || beyond == grid.num_slices)) return FaceKind::free;
  const int self = grid.owner(range.row_start, range.slice_start);
  if (grid.owner(range.row_start, beyond) == self) return FaceKind::internal;
  for (int row = range.row_start; row < range.row_end; ++row)
    if (grid.built[grid.owner(row, beyond)]) return FaceKind::head;
  return FaceKind::free;
}

}  // namespace cupola
