#pragma once

#include <limits>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// True if a bed may run through a block between two of its parts.
bool is_divided(const Assembly& assembly, int block);

/// Course of the piece of a block at a point, both as built. On an edge of two pieces: the higher one up to
/// course `at_most`. A block of several courses that is one convex part is in the last of them: a bed that
/// runs through it has it above.
int ring_of_piece(const Assembly& assembly, int block, const Vec3& point,
                  int at_most = std::numeric_limits<int>::max());

}  // namespace cupola
