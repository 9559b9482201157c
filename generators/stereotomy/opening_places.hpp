#pragma once

#include <string>
#include <vector>

#include "generators/bond/openings.hpp"
#include "generators/surface/surface_map.hpp"

namespace cupola {

/// Where the openings of a member lie on its closed surface. Their edges must be beds. Throws InputError that
/// begins with `key`, as geometry.openings, if an opening or its lintel does not fit.
std::vector<OpeningPlace> opening_places(const std::vector<Openings>& openings, const SurfaceMap& surface,
                                         const std::string& key);

}  // namespace cupola
