#pragma once

#include <string>

#include "assembly/case/geometry.hpp"

namespace cupola {

/// The unrolled bond as an SVG drawing: courses upwards, abscissa to the right, one rectangle per block,
/// coloured by what it is (laid flat, upright, truncated upright, across a corner), corners dashed. Blocks
/// beyond the stage are left out. Throws InputError for imported blocks.
std::string bond_map_svg(const Geometry& geometry);

}  // namespace cupola
