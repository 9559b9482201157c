#pragma once

#include <vector>

#include "assembly/case/analysis.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// Blocks that are laid at the same time.
struct LaidBlocks {
  int ring = 0;             ///< course being laid
  double share = 1.0;       ///< of the stages of that course, this one included
  std::vector<int> blocks;  ///< of the assembly, free
};

/// The course with which each block is laid: the first ring that it occupies. The rings of an arch or barrel
/// run from one springing to the other; it rises from both, each ring with the one as far from the other
/// springing, and the number is the smaller of the two. -1 for a support.
std::vector<int> laying_courses(const Assembly& assembly);

/// The stages of the courses `first` to `last`: whole courses, or one block of every team. Each team lays one
/// of equal runs of the course, in the order of the case.
std::vector<LaidBlocks> laying_order(const Assembly& assembly, const StagedConstruction& staged, int first,
                                     int last);

}  // namespace cupola
