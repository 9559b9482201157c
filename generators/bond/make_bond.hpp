#pragma once

#include "assembly/case/geometry.hpp"
#include "generators/bond/bond_pattern.hpp"

namespace cupola {

/// Lays the bond of a case on the grid of a surface. Throws InputError if it does not fit.
BondPattern make_bond(const Bond& bond, const BondGrid& grid);

/// Number of courses into which the bond divides each course of the case.
int refinement_of(const Bond& bond);

}  // namespace cupola
