#pragma once

#include <map>
#include <span>

#include "postproc/mechanics/thrust_line.hpp"

namespace cupola {

/// Wrenches on what each block has above a bed from what lies below it, about its centroid, by block, whatever
/// the kind of the joints: below are the courses of the stack under the bed and, of blocks that stand on the
/// bed, the supports and blocks of other stacks that carry them. `section`: all beds of a section, which
/// decide what of other stacks lies below, as where a web rests on its ribs. On a bed that closes a stack:
/// from each block of its last course on what it carries.
std::map<int, Wrench> wrenches_across(const ThrustInput& input, int bed, std::span<const int> section = {});

}  // namespace cupola
