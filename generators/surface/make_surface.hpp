#pragma once

#include <vector>

#include "generators/surface/surface_map.hpp"

namespace cupola {

/// The surface of a case with `rings` courses, rings >= 1. Without `wythes` it has one, of the thickness of
/// the surface; otherwise they replace that thickness. Throws InputError if its dimensions contradict each
/// other.
SurfaceMap make_surface(Surface surface, int rings, std::vector<Thickness> wythes = {});

/// Volume of the smooth shell, m3, with a relative error of 1e-8: the reference for shells without a closed
/// form. Richardson extrapolation of faceted shells with n, 2n and 4n cells in each direction removes the
/// errors O(1/n^2) and O(1/n^4).
double extrapolated_shell_volume(const SurfaceMap& surface);

/// A closed surface whose abscissa is the azimuth, made of plane facets between abscissae, of which the last
/// is the first plus the extent. Corners of the surface must be among them.
///
/// In each facet the points of a bed and a layer lie on the chord between its ends, at their azimuth. Beds
/// and head planes are then plane wherever a head joint lies, so that neighbouring courses may have joints in
/// different places. `shell_volume` is that of the smooth surface.
SurfaceMap faceted(SurfaceMap surface, const std::vector<double>& ends);

}  // namespace cupola
