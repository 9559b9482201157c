#pragma once

#include "assembly/case/geometry.hpp"
#include "generators/bond/bond_pattern.hpp"

namespace cupola {

/// Names of the wythes and, behind them, of the groups of bonders, each once: the members of the assembly.
std::vector<std::string> member_names(const Masonry& masonry);

/// Lays the bond of every wythe, and then the bonders in the order of the case. A bonder replaces the cells
/// that it occupies; separate_rests() says what becomes of the blocks that it cuts. All wythes get the cuts
/// of all bonds, and a course of a wythe with fewer courses consists of several courses of `grid`.
///
/// `heights` of the middles of the courses of the grid, m above the springing. (num_rings)
///
/// Throws InputError for a wythe or a group of bonders without any block.
BondPattern make_wythe_bond(const Masonry& masonry, const BondGrid& grid, const std::vector<double>& heights);

}  // namespace cupola
