#pragma once

#include "assembly/case/geometry.hpp"
#include "generators/bond/bond_pattern.hpp"

namespace cupola {

/// Herringbone bond: strips of narrow upright blocks ("verticals") that climb through courses of whole
/// blocks.
///
/// Let w be the width of a whole block, v = w / verticals_per_block, H = rings_per_vertical and K the number
/// of rings. On a spiral path, vertical j = 1 - H .. K - 1 of strip i covers
///     abscissae [a_i + j v, a_i + (j + 1) v),  a_i = i extent / strips + phase,
///     rings     [j, j + H), clipped to [0, K),
/// so that every ring crosses H verticals of each strip. On a meridian path j mod H replaces j in the
/// abscissae.
///
/// With an embedment m each strip has one vertical per ring: vertical j covers rings [r + j H, r + (j + 1)
/// H), where r is such that the last ring built is the m-th above the start of its verticals. With chirality
/// `both` the strips and their mirror images are laid; where they cross, those of left hand are cut.
///
/// The rest of each ring is laid in whole blocks. `beside` decides where their joints lie: `stepped` cuts
/// them from the strip onwards, so that joints move by v per ring; `half` and `aligned` put them in a half
/// bond or on meridians. A remainder narrower than w / 2 widens its neighbour, or in a window takes part of
/// its width.
///
/// With refine = n, verticals are n times narrower and lower, and each strip becomes a band of n strips side
/// by side that covers the same part of the shell.
///
/// An open surface has one strip, which starts at the lower left corner. Whole blocks are laid from the strip
/// towards both ends, and verticals beyond the ends are left out.
///
/// Throws InputError if the strips or the phase do not fit the surface.
BondPattern herringbone_bond(const HerringboneBond& bond, const BondGrid& grid);

}  // namespace cupola
