#pragma once

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Makes the faces that two parts of one block share within `distance` (m) internal, from a part on: its
/// surface is closed, and nothing touches it from inside.
void mark_internal_faces(size_t first_part, double distance, Assembly* assembly);

}  // namespace cupola
