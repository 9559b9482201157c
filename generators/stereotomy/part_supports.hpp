#pragma once

#include <span>

#include "assembly/model/assembly.hpp"
#include "generators/stereotomy/cut_bodies.hpp"

namespace cupola {

/// Cuts supports of one convex part, as springings of open storeys have them, back where they overlap those of
/// another storey: they end midway between their own stones and the others, so that no stone stands on both.
/// Supports of several parts, as rings and those that cuts left, stay as they are, and so do those between
/// whose stones no plane along a side of either lies. `starts`: of the blocks and parts of each storey, and
/// the end of the last. `gap`: m, of the joints.
void part_supports(std::span<const MemberStart> starts, double gap, Assembly* assembly);

}  // namespace cupola
