#pragma once

#include <vector>

#include "assembly/case/analysis.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// Blocks that are laid at the same time.
struct LaidBlocks {
  int ring = 0;             ///< being laid; of an arch or barrel the lower of two
  int course = 0;           ///< of that ring, laying_course()
  double share = 1.0;       ///< of the stages of that course, this one included
  std::vector<int> blocks;  ///< of the assembly, free
};

/// laying_course() of each block.
std::vector<int> laying_courses(const Assembly& assembly);

/// The stages from first_ring to last_ring: whole courses, or one block of every team. Each team lays one of
/// equal runs of the course, in the order of the case. Empty if no course is laid from the one to the other.
std::vector<LaidBlocks> laying_order(const Assembly& assembly, const StagedConstruction& staged);

}  // namespace cupola
