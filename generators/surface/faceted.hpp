#pragma once

#include <vector>

#include "generators/surface/surface_map.hpp"

namespace cupola {

/// A closed surface whose abscissa is the azimuth, made of plane facets between abscissae, of which the last
/// is the first plus the extent. Corners of the surface must be among them.
///
/// In each facet the points of a bed and a layer lie on the chord between its ends, at their azimuth. Beds
/// and head planes are then plane wherever a head joint lies, so that neighbouring courses may have joints in
/// different places. `shell_volume` is that of the smooth surface.
SurfaceMap faceted(SurfaceMap surface, const std::vector<double>& ends);

}  // namespace cupola
