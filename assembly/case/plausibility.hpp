#pragma once

#include <string>
#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// Tensions that joints never reach, because friction is exhausted before: of all joints, and of those groups
/// whose own law causes it. Other values that masonry hardly has, such as a span of 45000 m, are declared
/// beside their keys (Section::expect).
std::vector<std::string> unused_tensions(const Joints& joints);

/// Joints that crush, of so few contact points that the edge of a joint bears a sixth of its strength, unless
/// the case says how many.
std::vector<std::string> undivided_joints(const Case& scene);

/// Values that must fit the blocks, one sentence each: heights and planes outside the model, loads far
/// smaller than the blocks are heavy, supports that move further than the model is large, an import in
/// another unit.
std::vector<std::string> implausible_for_blocks(const Case& scene, const Assembly& assembly);

}  // namespace cupola
