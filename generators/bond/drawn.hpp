#pragma once

#include "assembly/case/geometry.hpp"
#include "generators/bond/bond_pattern.hpp"

namespace cupola {

/// Lays a drawing over a surface. A closed ring has a whole number of drawings, a wall a whole number of
/// letters, whose length differs from the one in the case by at most 5 %. Ends, corners and the last course
/// cut blocks; what is cut is marked as truncated, and a piece narrower than a quarter of its block joins its
/// neighbour in the course. A block taller than wide is an upright.
///
/// With letters of constant length, course k of a ring has a whole number of drawings too, the nearest to its
/// length L_k over that of a drawing: N_k = C max(1, round(L_k / (C letter_length))) letters.
///
/// Throws InputError where no such number exists, for a block that does not fit into a ring, for a phase that
/// is not a whole number of letters on an open surface, and for a block of two courses whose letters differ
/// in number.
BondPattern drawn_bond(const DrawnBond& bond, const BondGrid& grid);

/// The same with so many letters along a course, of which `phase`, whole on an open surface, lie before the
/// drawing.
BondPattern lay_drawing(const DrawnBond& bond, const BondGrid& grid, int num_letters, double phase);

}  // namespace cupola
