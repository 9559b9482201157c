#pragma once

#include <vector>

#include "generators/bond/bond_pattern.hpp"
#include "generators/surface/surface_map.hpp"

namespace cupola {

/// A box of cells that becomes one convex part, between beds row_start and row_end, cuts slice_start and
/// slice_end and layers wythe_start and wythe_end. On a closed surface cuts may be negative or lie beyond the
/// seam.
struct CellRange {
  int row_start, row_end;
  int slice_start, slice_end;
  int wythe_start, wythe_end;
};

/// The (rows x slices x wythes) grid of cells of a surface and its bond: which block owns a cell, what its
/// neighbours are, and which cells merge. A row is a course, or part of one on surfaces with several rows per
/// course. Holds references to the surface and the bond.
struct CellGrid {
  const SurfaceMap& surface;
  const BondPattern& bond;
  int num_rows = 0;
  int num_slices = 0;
  int num_wythes = 0;
  std::vector<std::vector<int>> cells;  ///< per bond block, ascending: see cell()
  std::vector<int> order;               ///< the bond blocks that are built, ring by ring in slot order
  std::vector<char> built;              ///< per bond block: 1 if it is built in this stage
  /// Per course with cuts of its own, else of all, and per cut: 1 if two facets of the surface meet there, 2
  /// if they meet at one of its corners.
  std::vector<std::vector<char>> corner;

  int ring_index(int row) const { return row / surface.rows_per_ring; }
  int slices_of(int row) const { return bond.slices_of(ring_index(row)); }
  int wrap(int row, int slice) const {
    return surface.closed ? (slice + slices_of(row)) % slices_of(row) : slice;
  }
  int cell(int row, int slice, int wythe) const { return (row * num_slices + slice) * num_wythes + wythe; }
  /// Bond block of a cell, or kVoid.
  int owner(int row, int slice, int wythe) const { return bond.at(ring_index(row), wrap(row, slice), wythe); }
  bool is_built(int row, int slice, int wythe) const {
    const int block = owner(row, slice, wythe);
    return block != kVoid && built[block];
  }
  bool is_corner(int row, int cut) const { return corner_at(row, cut) == 2; }
  bool ends_facet(int row, int cut) const { return corner_at(row, cut) > 0; }
  int ring_of(int row) const { return ring_index(row) + surface.first_ring() + surface.rings_below; }
  bool is_support(int block) const { return bond.blocks[block].kind == BlockKind::support; }
  int first_row(int block) const { return cells[block].front() / (num_slices * num_wythes); }
  int last_row(int block) const { return cells[block].back() / (num_slices * num_wythes); }
  double abscissa(int row, int cut) const;  ///< continues beyond the seam

 private:
  char corner_at(int row, int cut) const {
    return corner[bond.by_course() ? ring_index(row) : 0][wrap(row, cut)];
  }
};

/// With `stage_rings` > 0 only the blocks that begin in so many rings above a springing are built.
CellGrid make_cell_grid(const SurfaceMap& surface, const BondPattern& bond, int stage_rings);

/// Slices [start, end) of a block in one of its rows; end exceeds num_slices if the block crosses the seam.
std::pair<int, int> slices_in_row(const CellGrid& grid, int block, int row);

/// The convex parts of a block: its cells, merged within rows, across rows and across wythes where the union
/// is exactly convex. Cells of a block that is no box of cells stay as they are, so that internal faces mate.
std::vector<CellRange> convex_ranges(const CellGrid& grid, int block);

/// Kind of the lower or upper bed of a range, of its left or right head, and of its inner or outer layer:
/// `internal` towards its own block, a joint if a built block or a support lies beyond, `top` for the upper
/// bed of the last course, `intrados` or `extrados` where the shell ends, else `free`.
FaceKind bed_kind(const CellGrid& grid, const CellRange& range, bool upper);
FaceKind head_kind(const CellGrid& grid, const CellRange& range, bool right);
FaceKind layer_kind(const CellGrid& grid, const CellRange& range, bool outer);

}  // namespace cupola
