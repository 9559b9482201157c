#pragma once

#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// A stage of construction with rings 0 to `ring` laid: their blocks and the supports.
struct ConstructionStage {
  int ring = 0;  ///< last ring laid
  Assembly assembly;
  std::vector<int> complete_block;  ///< block of this stage -> block of the complete assembly
};
ConstructionStage build_stage(const Assembly& complete, int ring);

/// Adds the laws of fresh and curing mortar while course `ring` is being laid. Joints of the courses up to
/// `top` are as young as its own.
void add_fresh_joints(const StagedConstruction& staged, int ring, int top, Joints* joints);

/// The case of that stage, with the friction `fresh_friction` in its fresh joints. An incomplete stage
/// carries only its own weight: loads other than gravity, and ties to blocks that are not laid yet, apply
/// only if the model is `complete`.
Case case_of_stage(const Case& scene, const ConstructionStage& stage, double fresh_friction, bool complete);

}  // namespace cupola
