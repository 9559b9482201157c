#pragma once

#include <set>

#include "assembly/model/force_quantity.hpp"
#include "solver/analysis/admissible/joint_geometry.hpp"

namespace cupola {

/// All free blocks that have a joint with a support.
std::set<int> blocks_on_supports(const Assembly& assembly, const JointGeometry& joints);

/// Those of a group. Throws InputError if there are none, and for a listed block that rests on no support.
std::set<int> blocks_on_supports(const Assembly& assembly, const JointGeometry& joints,
                                 const BaseBlocks& group);

/// Throws InputError if the assembly has no such block.
void check_block(const Assembly& assembly, int block);

}  // namespace cupola
