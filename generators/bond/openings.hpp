#pragma once

#include <vector>

#include "generators/bond/bond_pattern.hpp"

namespace cupola {

/// One opening of a closed surface, in the coordinates of the bond.
struct OpeningPlace {
  double middle = 0.0;        ///< abscissa
  double half_opening = 0.0;  ///< range of the abscissa from the middle to a jamb
  double half_lintel = 0.0;   ///< and to an end of the lintel
  int first_ring = 0;         ///< courses first_ring .. first_lintel - 1 are open
  int first_lintel = 0;       ///< courses first_lintel .. end_lintel - 1 are the lintel
  int end_lintel = 0;
};

/// Lays the lintels, each one block through all wythes with the label `member`, and then empties the cells of
/// the openings. An opening cuts the lintel of another one below it, so that a stack of openings has stepped
/// jambs. The jambs and the ends of the lintels become cuts, and separate_rests() says what becomes of the
/// blocks that they cut.
void lay_openings(const BondGrid& grid, const std::vector<OpeningPlace>& openings, int member,
                  BondPattern* pattern);

}  // namespace cupola
