#pragma once

#include <vector>

#include "generators/bond/bond_pattern.hpp"
#include "generators/surface/surface_map.hpp"

namespace cupola {

/// A rectangle of cells that becomes one convex part, between beds row_start and row_end and cuts slice_start
/// and slice_end. On a closed surface cuts may be negative or lie beyond the seam.
struct CellRange {
  int row_start, row_end;
  int slice_start, slice_end;
};

/// The (rows x slices) grid of cells of a surface and its bond: which block owns a cell, what its neighbours
/// are, and which cells merge. A row is a course, or part of one on surfaces with several rows per course.
/// Holds references to the surface and the bond.
struct CellGrid {
  const SurfaceMap& surface;
  const BondPattern& bond;
  int num_rows = 0;
  int num_slices = 0;
  std::vector<std::vector<int>> cells;  ///< per bond block, ascending: row * num_slices + slice
  std::vector<int> order;               ///< the bond blocks that are built, ring by ring in slot order
  std::vector<char> built;              ///< per bond block: 1 if it is built in this stage
  std::vector<char> corner;  ///< per cut: 1 if two facets of the surface meet there; (num_slices + 1)

  int wrap(int slice) const { return surface.closed ? (slice + num_slices) % num_slices : slice; }
  int owner(int row, int slice) const { return bond.at(row / surface.rows_per_ring, wrap(slice)); }
  bool is_corner(int cut) const { return corner[wrap(cut)]; }
  int ring_of(int row) const { return row / surface.rows_per_ring + surface.first_ring(); }
  bool is_support(int block) const { return bond.blocks[block].kind == BlockKind::support; }
  int first_row(int block) const { return cells[block].front() / num_slices; }
  int last_row(int block) const { return cells[block].back() / num_slices; }
  double abscissa(int cut) const;  ///< continues beyond the seam
};

/// With `stage_rings` > 0 only the blocks that begin below that ring are built.
CellGrid make_cell_grid(const SurfaceMap& surface, const BondPattern& bond, int stage_rings);

/// Slices [start, end) of a block in one of its rows; end exceeds num_slices if the block crosses the seam.
std::pair<int, int> slices_in_row(const CellGrid& grid, int block, int row);

/// The convex parts of a block: its cells, merged within rows and across rows where the union is exactly
/// convex.
std::vector<CellRange> convex_ranges(const CellGrid& grid, int block);

/// Kind of the lower or upper bed of a range, and of its left or right head: `internal` towards its own
/// block, a joint if a built block or a support lies beyond, `top` for an upper bed with nothing above, else
/// `free`.
FaceKind bed_kind(const CellGrid& grid, const CellRange& range, bool upper);
FaceKind head_kind(const CellGrid& grid, const CellRange& range, bool right);

}  // namespace cupola
