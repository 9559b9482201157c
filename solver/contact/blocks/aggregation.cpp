#include "solver/contact/blocks/aggregation.hpp"

namespace cupola {

namespace {

/// Couplings between blocks: |A_ij|^2 over |A_ii| |A_jj|.
class Strength {
 public:
  Strength(const BlockRows& A, const RigidMotions& motions)
      : A_(A), motions_(motions), diagonal_(A.num_rows()) {
    for (int i = 0; i < A.num_rows(); ++i) {
      for (int k = A.start[i]; k < A.start[i + 1]; ++k)
        if (A.column[k] == i) diagonal_[i] = A.value[k].norm();
    }
  }
  double of(int i, int k) const {
    return A_.value[k].squaredNorm() / (diagonal_[i] * diagonal_[A_.column[k]]);
  }
  /// Entry k of row i joins i to a neighbour that moves with it.
  bool strong(int i, int k) const {
    constexpr double kStrong = 0.02;  // 0 to 0.1 make no difference of a tenth in the gradients
    return A_.column[k] != i && of(i, k) > kStrong * kStrong && within_reach(i, A_.column[k]);
  }

 private:
  bool within_reach(int i, int j) const {
    constexpr double kRounding = 1e-6;
    const double distance = (motions_.centre[i] - motions_.centre[j]).norm();
    return distance <= (1.0 + kRounding) * (motions_.reach[i] + motions_.reach[j]);
  }

  const BlockRows& A_;
  const RigidMotions& motions_;
  std::vector<double> diagonal_;
};

}  // namespace

Aggregates gather(const BlockRows& A, const RigidMotions& motions) {
  constexpr int kFree = -1;
  const int n = A.num_rows();
  const Strength strength(A, motions);
  Aggregates result;
  std::vector<int>& group = result.group;
  group.assign(n, kFree);
  const auto for_strong = [&](int i, const auto& action) {
    for (int k = A.start[i]; k < A.start[i + 1]; ++k)
      if (strength.strong(i, k)) action(A.column[k], k);
  };
  const auto found_group = [&](int i) {
    group[i] = result.num_groups();
    for_strong(i, [&](int j, int) {
      if (group[j] == kFree) group[j] = group[i];
    });
    result.centre.push_back(i);
  };

  for (int i = 0; i < n; ++i) {
    bool free = group[i] == kFree;
    for_strong(i, [&](int j, int) { free = free && group[j] == kFree; });
    if (free) found_group(i);
  }
  const std::vector<int> first = group;
  for (int i = 0; i < n; ++i) {
    if (group[i] != kFree) continue;
    double strongest = 0.0;
    for_strong(i, [&](int j, int k) {
      if (first[j] == kFree || strength.of(i, k) <= strongest) return;
      strongest = strength.of(i, k);
      group[i] = first[j];
    });
  }
  for (int i = 0; i < n; ++i)
    if (group[i] == kFree) found_group(i);
  return result;
}

}  // namespace cupola
