#pragma once

#include <cstddef>
#include <vector>

#include "solver/analysis/statics/static_solve.hpp"

namespace cupola {

/// After a step of a path that found an equilibrium. Sliding under pressure opens a joint by dilatancy; its
/// gap is measured from there in the steps that follow, so that the forces do not depend on their number.
void keep_dilatancy(const StaticSolution& solution, const FlowRule& law, ContactMemories* memories);

/// m, most by which a joint that bears is open (num_blocks): travel for the detector, within whose margin
/// such joints then stay. Empty if none is open.
std::vector<double> opened_by_sliding(const ContactMemories& memories, size_t num_blocks);

}  // namespace cupola
