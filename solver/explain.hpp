#pragma once

#include <string>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// What a run will have to do, counted on the model itself.
struct ModelCounts {
  int free_blocks = 0, fixed_blocks = 0, parts = 0;
  int unknowns = 0;  ///< velocities
  int contacts = 0, joints = 0, ties = 0;
  int force_rows = 0;  ///< unknown force components: one per frictionless contact, else three (plane: two)
  int islands = 0;     ///< groups of free blocks that no contact joins
  long long factor_entries = 0;  ///< of the Cholesky factor, 0 for methods without one
};

/// What it will take.
struct CostEstimate {
  double seconds = 0.0;  ///< processor time of one thread, reading and writing left out
  double bytes = 0.0;    ///< peak memory
  std::string basis;     ///< what was timed
};

struct ModelExplanation {
  ModelCounts counts;
  CostEstimate cost;
  std::string text;  ///< for `--explain`: the model, the features that are active and why, the cost
};

/// Builds the model without solving it. For the estimate one factorisation of a static problem is timed, of a
/// motion its first steps.
ModelExplanation explain_model(const Case& scene, const Assembly& assembly);

}  // namespace cupola
