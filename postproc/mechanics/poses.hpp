#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "postproc/mechanics/wrench.hpp"

namespace cupola {

/// Where the blocks of a frame stand. The skins and beds of a shell are those of the blocks as built, which
/// they move with.
struct Poses {
  std::vector<Eigen::Isometry3d> of_block;  ///< maps the block as built; empty: all stand as built

  Vec3 placed(int block, const Vec3& built) const {
    return of_block.empty() ? built : of_block[block] * built;
  }
  Vec3 as_built(int block, const Vec3& placed) const {
    return of_block.empty() ? placed : of_block[block].inverse() * placed;
  }
  /// The forces turn back with the block.
  Wrench as_built(int block, const Wrench& placed) const {
    if (of_block.empty()) return placed;
    const Eigen::Isometry3d back = of_block[block].inverse();
    return {back * placed.point, back.linear() * placed.force, back.linear() * placed.moment};
  }
};

}  // namespace cupola
