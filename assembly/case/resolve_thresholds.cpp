#include "assembly/case/resolve_thresholds.hpp"

#include <algorithm>
#include <cmath>

namespace cupola {

void resolve_thresholds(const Assembly& assembly, Analysis::Thresholds* thresholds) {
  if (thresholds->displacement) return;
  double sizes = 0.0;  // m
  int free_blocks = 0;
  for (const Block& block : assembly.blocks) {
    if (block.fixed) continue;
    sizes += std::cbrt(block.volume);
    ++free_blocks;
  }
  if (free_blocks > 0)
    thresholds->displacement = std::min(Analysis::Thresholds::kDisplacement, 0.5 * sizes / free_blocks);
}

}  // namespace cupola
