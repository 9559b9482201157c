#pragma once

#include <vector>

#include "assembly/base/named_enum.hpp"
#include "solver/dynamics/model.hpp"

namespace cupola {

enum class FallingMode { slides, tips };
constexpr auto enum_names(FallingMode) {
  return std::array{"slides", "tips"};
}

/// A block that leaves its place in a mechanism.
struct FallingBlock {
  int block = 0;
  FallingMode mode =
      FallingMode::slides;  ///< tips: it turns about an axis no farther than its farthest corner
  double speed = 0.0;       ///< of its centroid, over that of the fastest block
};

/// The blocks whose centroids move at a tenth of the largest speed or more. `v`: velocities of the free
/// blocks (6 nb), of any amplitude.
std::vector<FallingBlock> falling_blocks(const Model& model, const VecX& v);

}  // namespace cupola
