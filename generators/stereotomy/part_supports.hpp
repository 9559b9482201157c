#pragma once

#include <span>

#include "assembly/model/assembly.hpp"
#include "generators/stereotomy/cut_bodies.hpp"

namespace cupola {

/// Cuts supports back where they overlap those of another storey: they end midway between their own stones and
/// the others, so that no stone stands on both. Those between whose stones no plane along a side of either
/// lies, as rings about others, stay as they are. `starts`: of the blocks and parts of each storey, and
/// the end of the last. `gap`: m, of the joints.
void part_supports(std::span<const MemberStart> starts, double gap, Assembly* assembly);

}  // namespace cupola
