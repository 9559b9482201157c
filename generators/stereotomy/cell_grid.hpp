#pragma once

#include <vector>

#include "generators/bond/bond_pattern.hpp"
#include "generators/surface/surface_map.hpp"

namespace cupola {

/// A rectangle of cells that becomes one convex part: beds row_start .. row_end, cuts slice_start ..
/// slice_end. On a closed surface cuts may be negative or pass the seam.
struct CellRange {
  int row_start, row_end;
  int slice_start, slice_end;
};

/// The (rows x slices) grid of a surface under a bond: whose cell is whose, who the neighbours are, which
/// cells merge. A row is a course, or a part of one where the surface has several rows per course.
struct CellGrid {
  const SurfaceMap& surface;
  const BondPattern& bond;
  int num_rows = 0;
  int num_slices = 0;
  std::vector<std::vector<int>> cells;  ///< of each bond block, ascending: row * num_slices + slice
  std::vector<int> order;               ///< bond blocks that are built, ring by ring in slot order
  std::vector<char> built;              ///< per bond block
  std::vector<char> corner;             ///< per cut: two facets of the surface meet there

  int wrap(int slice) const { return surface.closed ? (slice + num_slices) % num_slices : slice; }
  int owner(int row, int slice) const { return bond.at(row / surface.rows_per_ring, wrap(slice)); }
  bool is_corner(int cut) const { return corner[wrap(cut)]; }
  int first_row(int block) const { return cells[block].front() / num_slices; }
  int last_row(int block) const { return cells[block].back() / num_slices; }
  double abscissa(int cut) const;  ///< continued past the seam
};

/// `stage_rings` > 0: only the blocks that begin below that ring are built.
CellGrid make_cell_grid(const SurfaceMap& surface, const BondPattern& bond, int stage_rings);

/// Slices of a block in one row, [start, end), whichever side of the seam they lie on.
std::pair<int, int> slices_in_row(const CellGrid& grid, int block, int row);

/// The convex parts of a block: single cells, merged along the row and across rows where that is exact.
std::vector<CellRange> convex_ranges(const CellGrid& grid, int block);

/// Kinds of a range's lower or upper bed and of its left or right head: `internal` towards its own block, a
/// joint when any built block (or the support) lies beyond, else free.
FaceKind bed_kind(const CellGrid& grid, const CellRange& range, bool upper);
FaceKind head_kind(const CellGrid& grid, const CellRange& range, bool right);

}  // namespace cupola
