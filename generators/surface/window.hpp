#pragma once

#include "generators/surface/surface_map.hpp"

namespace cupola {

/// The part of a dome or vault that a window shows: `courses` courses, of which the lowest `built` are built,
/// over the sector between azimuths from_deg and to_deg.
///
/// The upper bed of course built - 2, on which the last course built lies, meets the intrados at a corner at
/// z = window.height; the beds next to it lie window.course apart along the intrados there. The abscissa is
/// that of the whole surface less its value at from_deg. One row of cells of the depth `support_depth` (m)
/// below the first course is a support, and with held ends so are cells of the same width beyond both ends.
/// Throws InputError if the courses reach below the springing or above the crown.
SurfaceMap window_surface(const Surface& surface, std::vector<Thickness> wythes, const Window& window,
                          int courses, int built, double support_depth);

}  // namespace cupola
