#pragma once

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// Throws InputError for the first key of the case that selects joints, courses or blocks that the model does
/// not have, and therefore would change nothing.
void refuse_keys_without_effect(const Case& scene, const Assembly& assembly);

}  // namespace cupola
