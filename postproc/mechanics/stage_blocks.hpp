#pragma once

#include <vector>

#include "assembly/model/assembly.hpp"
#include "assembly/model/results.hpp"

namespace cupola {

/// Per block, true if it is laid in a stage of a construction. Of an open course those blocks are that have
/// joints or ties; all supports are.
std::vector<bool> laid_blocks(const Assembly& assembly, const Frame& stage);

/// Per block, true if a stage leaves it out: it is not laid, or the courses above `hold_below` others hold it
/// as a support. Empty for a frame of anything else.
std::vector<bool> blocks_left_out(const Assembly& assembly, const Frame& frame, int hold_below);

/// True for a block that is no support and not left out; none is if `left_out` is empty.
bool takes_part(const Assembly& assembly, int block, const std::vector<bool>& left_out);

}  // namespace cupola
