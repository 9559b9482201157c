#pragma once

#include <limits>
#include <set>
#include <span>
#include <vector>

#include "assembly/model/assembly.hpp"
#include "generators/stereotomy/model_checks.hpp"

namespace cupola {

/// The graph of joints: neighbours of each block, and the faces by which it meets them.
struct JointGraph {
  static constexpr int kFar = std::numeric_limits<int>::max();  ///< distance of a block that is not reached
  struct Face {
    int face = 0, other = 0;  ///< of the block; the block behind it
  };
  std::vector<std::set<int>> neighbours;
  std::vector<std::vector<Face>> faces;

  JointGraph(const Assembly& assembly, std::span<const FacePair> joints);

  /// Least number of joints from any of the blocks to each block, not through fixed blocks.
  std::vector<int> distances(const Assembly& assembly, const std::vector<int>& from) const;

  /// Fixed blocks that touch each other, by their least number.
  std::vector<std::vector<int>> groups_of_supports(const Assembly& assembly) const;
};

}  // namespace cupola
