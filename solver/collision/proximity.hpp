#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace cupola {

using Box = Eigen::AlignedBox3d;

/// Finds the pairs of overlapping boxes among many, in a dynamic tree of axis-aligned boxes (FCL).
class BroadPhase {
 public:
  /// Boxes of one group are never paired (the parts of one block, everything that is fixed).
  BroadPhase(std::span<const Box> boxes, std::span<const int> groups);
  ~BroadPhase();
  BroadPhase(BroadPhase&&) noexcept;
  BroadPhase& operator=(BroadPhase&&) noexcept;

  /// Replaces the boxes of the given indices.
  void move(std::span<const int> indices, std::span<const Box> boxes);

  /// All pairs (i < j) whose boxes overlap, sorted.
  std::vector<std::pair<int, int>> overlapping_pairs() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace cupola
