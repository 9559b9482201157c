#pragma once

#include "assembly/model/assembly.hpp"
#include "generators/stereotomy/shell.hpp"

namespace cupola {

/// Adds the ties of the chains of a case to an assembly that was cut from `storeys`. The ends of a tie lie on
/// the surface that divides the thickness at Chain::place, in the middle of a course or at one height of
/// their storey; each belongs to the block that it lies in. A chain above the courses of a stage is left out.
///
///     k = E A / L,    natural length = L + slack - prestress / k,    L: distance of the ends
///
/// Throws InputError for a level outside the masonry, for anchors in a cavity, for clamps longer than blocks,
/// and for two ends of a tie in one block.
void add_chains(const std::vector<Chain>& chains, const std::vector<Storey>& storeys, Assembly* assembly);

}  // namespace cupola
