#pragma once

#include <functional>
#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// A defect of a block's boundary surface, found by CGAL with exact predicates.
struct BoundaryDefect {
  enum class Kind { none, open, inside_out };
  int block = 0;
  Kind kind = Kind::none;
  int boundary_edges = 0;  ///< number of them, for an open surface
};

/// Blocks whose boundary (all faces except internal ones) is open or inside out. Faces are split into
/// triangles by a fan from their first vertex. With `part_by_part` each convex part must be closed by itself
/// instead; imported blocks need that, because their parts share no vertices. Their surfaces were checked as
/// read. check_model() measures that parts are convex with plane faces and do not overlap: closed surfaces of
/// such parts do not intersect themselves.
std::vector<BoundaryDefect> find_boundary_defects(const Assembly& assembly, bool part_by_part = false);

/// Calls `visit` for pairs of parts that may touch, i.e. whose ranges of x, y, z and azimuth about the z axis
/// overlap when grown by `margin` (m). The azimuth separates the blocks of a dome, whose axis-aligned boxes
/// overlap those of many neighbours. The order is always the same and part_a < part_b; pairs at the azimuth
/// of 180 deg may occur twice.
void visit_near_pairs(const Assembly& assembly, double margin,
                      const std::function<void(int part_a, int part_b)>& visit);

}  // namespace cupola
