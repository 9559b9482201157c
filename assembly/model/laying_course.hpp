#pragma once

#include "assembly/model/assembly.hpp"

namespace cupola {

/// When a course is laid, counted from 0; -1 for that of a support. The rings of an arch or barrel run from
/// one springing to the other; it rises from both, each ring with the one as far from the other springing.
int laying_course(const Assembly& assembly, int ring);

/// The same for a block, which is laid with the first ring that it occupies.
int laying_course(const Assembly& assembly, const Block& block);

/// The one laid last.
int last_course(const Assembly& assembly);

/// True if a construction up to ring `last_ring`, or -1: the last, lays all blocks.
bool completes(const Assembly& assembly, int last_ring);

/// True for a block that counts as a support where `course` is laid and only `hold_below` courses below it are
/// solved, of members beside each other those of each. Supports of the case are not meant; -1: none is held.
bool is_held(const Assembly& assembly, const Block& block, int course, int hold_below);

}  // namespace cupola
