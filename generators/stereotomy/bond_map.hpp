#pragma once

#include <string>

#include "assembly/case/geometry.hpp"

namespace cupola {

/// SVG drawing of the unrolled bond: courses upwards, abscissa to the right, corners as dashed lines; one
/// drawing per wythe, the inner one at the bottom, and below these those of a drum. Colours show the kind of
/// block: flat, upright, cut, across a corner, bonder, support. Blocks above the stage are left out. Throws
/// InputError for imported blocks.
std::string bond_map_svg(const Geometry& geometry);

}  // namespace cupola
