#pragma once

#include <functional>
#include <vector>

#include "assembly/model/assembly.hpp"

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

/// Calls `visit` for pairs of parts that may touch: their ranges of x, y, z and azimuth about the z axis,
/// grown by `margin` (m), overlap. The azimuth tells thin blocks of a dome apart, whose upright boxes overlap
/// far around. Always in the same order, part_a < part_b; pairs that straddle the azimuth of 180 deg may come
/// twice.
void visit_near_pairs(const Assembly& assembly, double margin,
                      const std::function<void(int part_a, int part_b)>& visit);

}  // namespace cupola
