#include "solver/contact/blocks/aggregation.hpp"

#include "assembly/base/error.hpp"

namespace cupola {

namespace {

/// Strength of the coupling between blocks: |A_ij|^2 / (|A_ii| |A_jj|).
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
  /// Whether entry k of row i couples block i strongly to a block within reach.
  bool strong(int i, int k) const {
    constexpr double kStrong =
        0.02;  // between 0 and 0.1 the number of CG iterations varies by less than 10 %
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

Aggregates aggregate_blocks(const BlockRows& A, const RigidMotions& motions) {
  constexpr int kFree = -1;
  const int n = A.num_rows();
  CUPOLA_ASSERT(std::ssize(motions.centre) == n && std::ssize(motions.reach) == n);
  const Strength strength(A, motions);
  Aggregates result;
  std::vector<int>& aggregate = result.aggregate;
  aggregate.assign(n, kFree);
  const auto for_strong = [&](int i, const auto& action) {
    for (int k = A.start[i]; k < A.start[i + 1]; ++k)
      if (strength.strong(i, k)) action(A.column[k], k);
  };
  const auto form_aggregate = [&](int i) {
    aggregate[i] = result.size();
    for_strong(i, [&](int j, int) {
      if (aggregate[j] == kFree) aggregate[j] = aggregate[i];
    });
    result.centre.push_back(i);
  };

  for (int i = 0; i < n; ++i) {
    bool free = aggregate[i] == kFree;
    for_strong(i, [&](int j, int) { free = free && aggregate[j] == kFree; });
    if (free) form_aggregate(i);
  }
  const std::vector<int> first = aggregate;
  for (int i = 0; i < n; ++i) {
    if (aggregate[i] != kFree) continue;
    double strongest = 0.0;
    for_strong(i, [&](int j, int k) {
      if (first[j] == kFree || strength.of(i, k) <= strongest) return;
      strongest = strength.of(i, k);
      aggregate[i] = first[j];
    });
  }
  for (int i = 0; i < n; ++i)
    if (aggregate[i] == kFree) form_aggregate(i);
  return result;
}

}  // namespace cupola
