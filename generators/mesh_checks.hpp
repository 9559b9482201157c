#pragma once

#include <utility>
#include <vector>

#include "assembly/assembly.hpp"

namespace cupola {

/// What CGAL finds wrong with the boundary surfaces of the blocks, with exact predicates.
struct BoundaryDefect {
  enum class Kind { none, open, inside_out, self_intersecting };
  int block = 0;
  Kind kind = Kind::none;
  int boundary_edges = 0;  ///< of an open surface
};

/// Boundary of every block (all its faces but the internal ones): closed, outward, free of
/// self-intersections. Faces are split into triangles by a fan from their first vertex. `part_by_part`
/// checks every convex part on its own instead, with all its faces: imported parts share no vertices.
std::vector<BoundaryDefect> find_boundary_defects(const Assembly& assembly, bool part_by_part = false);

/// Pairs of parts whose bounding boxes, grown by `margin` (m), touch; first < second, in ascending order.
std::vector<std::pair<int, int>> touching_boxes(const Assembly& assembly, double margin);

}  // namespace cupola
