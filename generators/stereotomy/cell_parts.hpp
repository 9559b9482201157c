#pragma once

#include <string>

#include "assembly/model/assembly.hpp"
#include "generators/stereotomy/cell_grid.hpp"
#include "generators/stereotomy/grid_points.hpp"

namespace cupola {

/// Appends a range of cells to the last block of the assembly: one convex part, or three where its inner
/// layer is a warped joint.
///
/// A warped layer between two wythes is cut along the diagonal that bulges outwards, on both sides. That
/// makes the cell inside convex and the cell outside concave, with a valley p0 - p2 on its inner face. The
/// cell outside is cut through p0, p2 and the corners q0, q2 across the thickness, which need not be
/// coplanar, into a prism that is convex, and a prism that is cut again, into a tetrahedron and a pyramid. No
/// part has corners other than those of the cell, so that faces of neighbours mate.
void add_parts(const CellGrid& grid, const CellRange& cells, GridPoints* points, Assembly* assembly);

/// Throws InputError that begins with `key` for a part from `first` on whose faces point inwards. Cuts would
/// take it for a sliver and drop it.
void refuse_inverted_parts(const Assembly& assembly, size_t first, const std::string& key);

}  // namespace cupola
