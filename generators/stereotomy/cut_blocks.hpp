#pragma once

#include <optional>

#include "assembly/case/geometry.hpp"
#include "assembly/model/assembly.hpp"
#include "generators/bond/bond_pattern.hpp"
#include "generators/surface/surface_map.hpp"

namespace cupola {

struct CutOptions {
  double density = 0.0;        ///< kg/m3
  double support_width = 1.0;  ///< m, how far the fixed base reaches beyond the shell
  int stage_rings = 0;         ///< only blocks that begin below this ring; 0 means all
  std::optional<Imperfections> imperfections;
};

/// Cuts a surface along a bond: one shared vertex table, one convex part per cell, cells merged where that
/// is exact, mass properties from the parts.
///
/// Block 0 (one more at the far end of an arch: the last) is the fixed support; the others follow ring by
/// ring in slot order, so that in every bed joint the lower block has the lower number. Faces of
/// neighbouring cells are the same four vertices. A free upper bed is `top`, a free head is `free`.
Assembly cut_blocks(const SurfaceMap& surface, const BondPattern& bond, const CutOptions& options);

/// What a bond is told about a surface.
BondGrid bond_grid(const SurfaceMap& surface);

}  // namespace cupola
