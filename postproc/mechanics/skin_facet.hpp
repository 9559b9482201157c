#pragma once

#include <vector>

#include "postproc/mechanics/shell.hpp"

namespace cupola {

/// Adds face `f` of a part to a bed if it touches both skins, as it does in a shell of one wythe. A part of a
/// bent stone may have two edges on one skin, of which one meets the edge on the other skin where a cut that
/// goes on along that skin comes out.
void add_skin_facet(const Assembly& assembly, const Part& part, int f, std::vector<BedFacet>* bed);

}  // namespace cupola
