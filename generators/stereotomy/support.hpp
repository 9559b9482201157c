#pragma once

#include <array>
#include <vector>

#include "assembly/model/assembly.hpp"
#include "generators/surface/surface_map.hpp"

namespace cupola {

/// Appends the fixed block under the first bed. Its depth is `width` (m).
/// - Ring: one cell per slice, between the head planes of the shell. Its top faces continue those of the
///   first bed. It extends `width` beyond both skins, on the inside at most half-way to where two neighbouring
///   head planes meet, as at the axis. It is divided into `num_blocks` blocks of equal ranges of the abscissa,
///   the first of which is centred on the first corner.
/// - Otherwise: one box under the whole first bed, with the top face in its plane. It extends `width` beyond
///   the bed on all sides, towards the inside of an arch at most a quarter of the clear span.
void add_base_support(const SurfaceMap& surface, const std::vector<double>& cuts, double width,
                      int num_blocks, double density, Assembly* assembly);

/// Appends the fixed block behind the last bed of an arch, the mirror image of the first.
void add_far_support(const SurfaceMap& surface, const std::vector<double>& cuts, double width, double density,
                     Assembly* assembly);

/// Appends a fixed box. `top` is counter-clockwise seen from outside; the box extends from it by `depth` (m).
void add_box_support(const std::array<Vec3, 4>& top, const Vec3& depth, double density, Assembly* assembly);

}  // namespace cupola
