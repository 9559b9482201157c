#pragma once

#include "assembly/case/geometry.hpp"
#include "generators/bond/bond_pattern.hpp"

namespace cupola {

/// Lays the bond that a case names on a grid. Throws InputError when it does not fit.
BondPattern make_bond(const Bond& bond, const BondGrid& grid);

/// Courses of the bond, refinement included.
int rings_of(const Bond& bond);
/// The bond's refinement: courses of it for each course that the case counts.
int refinement_of(const Bond& bond);

}  // namespace cupola
