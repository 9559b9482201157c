#include "assembly/model/joint_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cupola {

double smallest_block_size(const Assembly& assembly) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Block& block : assembly.blocks)
    if (!block.fixed) smallest = std::min(smallest, block.volume);
  return std::isfinite(smallest) ? std::cbrt(smallest) : 1.0;
}

JointRule joint_rule(double smallest_block, double margin) {
  JointRule rule;
  rule.margin = margin > 0.0 ? margin : 0.01 * smallest_block;
  rule.min_width = 1e-3 * smallest_block;
  return rule;
}

}  // namespace cupola
