#pragma once

#include "assembly/case/geometry.hpp"
#include "generators/bond/bond_pattern.hpp"
#include "generators/surface/surface_map.hpp"

namespace cupola {

/// A surface and the bond laid on it.
struct Storey {
  std::string name;  ///< of the member
  SurfaceMap surface;
  BondPattern bond;  ///< with the support of a window as blocks of its own, below and beside the courses
  std::vector<std::string> members;  ///< of the bond's labels: wythes and groups of bonders; none: one wythe
  int stage_rings = 0;               ///< of the stage; 0: the complete model
};

/// The shell of a case, without the drum on which it stands. Throws InputError if surface, bond and window do not fit each
/// other.
Storey make_shell(const Geometry& geometry);

/// The drum, if there is one, and the shell, from below.
std::vector<Storey> make_storeys(const Geometry& geometry);

std::vector<Thickness> thicknesses(const std::vector<Wythe>& wythes);
/// Lays the bond or the wythes of a surface.
BondPattern lay_masonry(const Masonry& masonry, const SurfaceMap& surface, const BondGrid& grid);

}  // namespace cupola
