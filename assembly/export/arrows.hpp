#pragma once

#include "assembly/export/export_model.hpp"

namespace cupola {

/// Thickness of arrows as a share of the longest one.
inline constexpr double kArrowThickness = 0.02;

/// Adds an arrow, a square shaft and a pyramid, to a surface; nothing if `span` is zero. The head is five
/// thicknesses long, or 40 % of a short arrow.
void add_arrow(const Vec3& from, const Vec3& span, double thickness, BlockSurface* surface);

}  // namespace cupola
