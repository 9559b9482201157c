#pragma once

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Makes the faces that other parts of their block cover within `distance` (m) internal, from a part on: its
/// surface is closed, and nothing touches it from inside. Faces covered in part keep their kind.
void mark_internal_faces(size_t first_part, double distance, Assembly* assembly);

}  // namespace cupola
