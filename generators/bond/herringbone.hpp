#pragma once

#include "assembly/case/geometry.hpp"
#include "generators/bond/bond_pattern.hpp"

namespace cupola {

/// Herringbone. With w the width of a whole block and v = w / verticals_per_block, vertical j of strip i
/// stands at the azimuth [a_i + j v, a_i + (j + 1) v) and spans the rings [j, j + rings_per_vertical), cut
/// off by base and crown, j = 1 - rings_per_vertical .. K - 1, a_i = i extent / strips + phase. Every ring
/// crosses rings_per_vertical verticals of each strip; the rest of the ring is laid in whole blocks cut from
/// the strip on, so that their joints step by v per ring (`beside`: or lie where a half bond or meridians put
/// them); a rest narrower than w/2 widens its neighbour.
///
/// Refined n times, verticals are n times narrower and lower, and each strip becomes a band of n strips side
/// by side that covers the same part of the shell.
///
/// On a meridian path the verticals stand side by side instead: j at a_i + (j mod rings_per_vertical) v.
/// On an open surface there is one strip, from the lower left corner, laid from it towards both ends; what
/// lies beyond the ends is left out.
BondPattern herringbone_bond(const HerringboneBond& bond, const BondGrid& grid);

}  // namespace cupola
