#pragma once

#include <string>
#include <vector>

#include "assembly/model/loaded_faces.hpp"

namespace cupola {

/// What no masonry that lies below `level` (m) covers in plan, of the faces that look up.
std::vector<LoadedFace> open_parts(const Assembly& assembly, const std::vector<LoadedFace>& faces,
                                   double level);

/// The open parts of the tops of free blocks: faces of kind top or free, as a cut makes them, and joints that
/// it lays open or on which a narrower member stands. Of a member ("": all), or of the members on which it
/// stands (`of_bearers`).
std::vector<LoadedFace> open_tops(const Assembly& assembly, int from_ring, int to_ring,
                                  const std::string& member, bool of_bearers, double level);

}  // namespace cupola
