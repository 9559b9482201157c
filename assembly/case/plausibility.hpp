#pragma once

#include <string>
#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// Values that the case file admits but that masonry hardly has, such as a span of 45000 m: one sentence each with key,
/// value, unit, the range expected and the likely cause, usually another unit. Of a file that the case names, the
/// accelerogram of base_motion is read. Throws InputError if it cannot be read.
std::vector<std::string> implausible_values(const Case& scene);

/// The same for values that must fit the blocks: heights and planes outside the model, loads far smaller than the blocks
/// are heavy, supports that move further than the model is large, an import in another unit.
std::vector<std::string> implausible_for_blocks(const Case& scene, const Assembly& assembly);

}  // namespace cupola
