#pragma once

#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// What of an assembly stands when its rings 0 to `ring` are laid: blocks that begin there, and supports.
struct ConstructionStage {
  int ring = 0;  ///< last ring laid
  Assembly assembly;
  std::vector<int> complete_block;  ///< block of this stage -> block of the complete assembly
};
ConstructionStage build_stage(const Assembly& complete, int ring);

/// The case for that stage: the bed of the last ring has friction `fresh_friction`. Stages carry their own
/// weight; lantern, top load and the other loads come onto the complete model, and so do ties to blocks that
/// are not there yet.
Case case_of_stage(const Case& scene, const ConstructionStage& stage, double fresh_friction, bool complete);

}  // namespace cupola
