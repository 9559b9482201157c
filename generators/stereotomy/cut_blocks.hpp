#pragma once

#include <optional>

#include "assembly/case/geometry.hpp"
#include "assembly/model/assembly.hpp"
#include "generators/bond/bond_pattern.hpp"
#include "generators/surface/surface_map.hpp"

namespace cupola {

struct CutOptions {
  double density = 0.0;        ///< kg/m3
  double support_width = 1.0;  ///< m, by which the fixed base extends beyond the shell
  int stage_rings = 0;         ///< builds only the blocks that begin below this ring; 0 builds all
  std::optional<Imperfections> imperfections;
};

/// Cuts a surface along a bond into blocks with mass properties. Parts are cells, merged where the union is
/// exactly convex; all parts share one vertex table, and faces of neighbouring cells are the same four
/// vertices.
///
/// Block 0 is the fixed support; an arch has a second one, the last block. The others follow ring by ring in
/// slot order, so that the lower block of every bed joint has the lower number.
Assembly cut_blocks(const SurfaceMap& surface, const BondPattern& bond, const CutOptions& options);

/// The grid that a surface offers to a bond.
BondGrid bond_grid(const SurfaceMap& surface);

}  // namespace cupola
