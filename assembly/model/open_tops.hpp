#pragma once

#include <string>
#include <vector>

#include "assembly/model/loaded_faces.hpp"

namespace cupola {

/// What is open to the sky of the tops of free blocks: faces of kind top or free, as a cut makes them, and the
/// beds on which a narrower member stands, without what any masonry covers in plan. Of a member ("": all), or
/// of the members on which it stands (`of_bearers`).
std::vector<LoadedFace> open_tops(const Assembly& assembly, int from_ring, int to_ring,
                                  const std::string& member, bool of_bearers);

}  // namespace cupola
