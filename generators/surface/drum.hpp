#pragma once

#include "generators/surface/surface_map.hpp"

namespace cupola {

/// The wall of a drum below the springing of `shell`: vertical, over the plan of its first bed, which must lie in the plane
/// z = 0. The abscissa is that of the shell, and depths are measured as there, so that the inner faces are flush and the head
/// planes of equal cuts coincide. Bed k of K lies at z = height (k / K - 1).
SurfaceMap drum_surface(const SurfaceMap& shell, double height, std::vector<Thickness> wythes, int rings);

}  // namespace cupola
