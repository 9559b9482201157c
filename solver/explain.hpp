#pragma once

#include <string>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"
#include "solver/cost_estimate.hpp"

namespace cupola {

/// Size of the model that a run solves.
struct ModelCounts {
  int free_blocks = 0, fixed_blocks = 0, parts = 0;
  int unknowns = 0;  ///< velocity components
  int contacts = 0, joints = 0, ties = 0;
  int force_rows = 0;  ///< unknown force components: 1 per frictionless contact, otherwise 3 (plane: 2)
  int islands = 0;     ///< groups of free blocks without contact with each other
};

struct ModelExplanation {
  ModelCounts counts;
  CostEstimate cost;
  std::string text;  ///< printed by `--explain`: the model, the active features with their values, the cost
};

/// Builds the first contact problem from the same options as the run and counts its unknowns. For the
/// estimate it times one factorisation and, for a dynamic analysis, the static start and the first steps.
/// What has not ended after `time_limit`, s, is left out and named, so that a hard static start does not
/// delay the answer. Throws InputError for the same cases as the run.
ModelExplanation explain_model(const Case& scene, const Assembly& assembly, double time_limit = 30.0);

}  // namespace cupola
