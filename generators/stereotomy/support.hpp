#pragma once

#include <vector>

#include "assembly/model/assembly.hpp"
#include "generators/surface/surface_map.hpp"

namespace cupola {

/// Appends the fixed block that carries the first bed.
///
/// Ring: one cell per slice between the same radial half-planes as the shell's slices, top face z = 0,
/// reaching `width` (m) beyond both skins (inside at most half-way to the axis) and as deep.
/// Otherwise one box under the whole first bed, top face in its plane, reaching `width` beyond it all around
/// and as deep; inside an arch at most a quarter of the clear span.
void add_base_support(const SurfaceMap& surface, const std::vector<double>& cuts, double width,
                      double density, Assembly* assembly);

/// Appends the fixed block behind the last bed of an arch, the mirror image of the first one.
void add_far_support(const SurfaceMap& surface, const std::vector<double>& cuts, double width, double density,
                     Assembly* assembly);

}  // namespace cupola
