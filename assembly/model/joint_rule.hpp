#pragma once

#include "assembly/model/assembly.hpp"

namespace cupola {

/// When two blocks make a joint. The generator's checks and contact detection share this rule.
struct JointRule {
  double margin = 0.0;      ///< m: faces up to this far apart touch; blocks must not overlap by more
  double min_width = 0.0;   ///< m: faces that overlap over a narrower strip do not bear on each other
  double max_angle = 0.35;  ///< rad, largest tilt between two faces that touch
};

/// Share of `min_width` below which an overlap of two faces is rounding, 1e-7 of a block, and not worth a
/// warning.
inline constexpr double kNoWidth = 1e-4;

/// Cube root of the smallest volume of a free block, m; 1 without free blocks.
double smallest_block_size(const Assembly& assembly);

/// `margin` of the case (m); 0: 1 % of the smallest block. The minimum width is 1e-3 of the smallest block: a
/// block that sinks into its bed joint by compliance overlaps the sides of its neighbours by less than that.
JointRule joint_rule(double smallest_block, double margin);

}  // namespace cupola
