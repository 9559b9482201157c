#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace cupola {

/// Disjoint sets of the numbers 0 .. n - 1 (union-find with path halving). The root of a set is its least
/// number.
class DisjointSets {
 public:
  explicit DisjointSets(size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int i, int j) {
    const auto [low, high] = std::minmax({root(i), root(j)});
    parent_[high] = low;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace cupola
