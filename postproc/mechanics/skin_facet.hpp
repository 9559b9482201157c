#pragma once

#include <vector>

#include "postproc/mechanics/shell.hpp"

namespace cupola {

/// Adds face `f` of a part to a bed if it touches both skins, as it does in a shell of one wythe. Of a stone
/// bent round a corner, the first face of a bed adds the facets of the whole stone, from corner to corner,
/// however it is cut into parts: a cut may go on along one skin and end in the other or in a head joint.
void add_skin_facet(const Assembly& assembly, const Part& part, int f, std::vector<BedFacet>* bed);

}  // namespace cupola
