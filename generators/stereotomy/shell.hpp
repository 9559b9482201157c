#pragma once

#include "assembly/case/geometry.hpp"
#include "generators/bond/bond_pattern.hpp"
#include "generators/surface/surface_map.hpp"

namespace cupola {

/// The surface of a case and the bond laid on it.
struct Shell {
  SurfaceMap surface;
  BondPattern bond;  ///< with the support of a window as blocks of its own, below and beside the courses
  std::vector<std::string> members;  ///< wythes and groups of bonders; none: one wythe
  int stage_rings = 0;               ///< of the stage; 0: the complete model
};

/// Throws InputError if surface, bond and window do not fit each other.
Shell make_shell(const Geometry& geometry);

}  // namespace cupola
