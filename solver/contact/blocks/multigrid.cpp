#include "solver/contact/blocks/multigrid.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Cholesky>

#include "assembly/base/error.hpp"
#include "solver/contact/blocks/aggregation.hpp"
#include "solver/contact/blocks/sweeps.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {

namespace {

constexpr int kCoarsest = 1500;  // blocks; a factorisation takes a few hundredths of a second
constexpr double kOperationsPerInverse = 1000.0;
/// Below this mean of the diagonal, where 1 is inertia, a level has no coarser one. In the collapse of 11,568
/// bricks (means of 60 to 250) a step then takes 13 % less time, as sweeps need few CG iterations by
/// themselves.
constexpr double kSoft = 300.0;

/// Inverses of the diagonal blocks; empty if one of them is not positive definite.
std::vector<Mat6> inverse_diagonal(const BlockRows& A) {
  std::vector<Mat6> inverse(A.num_rows());
  std::atomic<bool> sound = true;
  share_range(kOperationsPerInverse * A.num_rows(), A.num_rows(), [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      int k = A.start[i];
      while (A.column[k] != i) ++k;
      const Eigen::LLT<Mat6> factor(A.value[k]);
      if (factor.info() == Eigen::Success) inverse[i] = factor.solve(Mat6::Identity());
      if (factor.info() != Eigen::Success || !inverse[i].allFinite()) sound = false;
    }
  });
  if (!sound) inverse.clear();
  return inverse;
}

/// Whether inertia is so large a share of the whitened matrix that sweeps suffice.
bool is_soft(const BlockRows& A) {
  double trace = 0.0;
  for (int i = 0; i < A.num_rows(); ++i) {
    for (int k = A.start[i]; k < A.start[i + 1]; ++k)
      if (A.column[k] == i) trace += A.value[k].trace();
  }
  return trace < kSoft * 6.0 * A.num_rows();
}

/// Upper estimate of the largest eigenvalue of D^-1 A: power iteration, plus 10 %.
double largest_eigenvalue(const BlockRows& A, const std::vector<Mat6>& inverse) {
  constexpr int kIterations = 10;
  constexpr double kMargin = 1.1;
  VecX x(6 * A.num_rows());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    x[i] = 1.5 + std::sin(static_cast<double>(i));  // not a single mode
  double eigenvalue = 1.0;
  for (int k = 0; k < kIterations; ++k) {
    const VecX y = multiply(A, x / x.norm());
    for (int i = 0; i < A.num_rows(); ++i) x.segment<6>(6 * i).noalias() = inverse[i] * y.segment<6>(6 * i);
    eigenvalue = x.norm();
  }
  return kMargin * eigenvalue;
}

/// T: orthonormal motions of the members of each aggregate. `coarse`: the motions of the aggregates in these
/// terms. By Cholesky QR.
struct AggregateMotions {
  BlockRows T;
  RigidMotions coarse;
};

std::optional<AggregateMotions> aggregate_motions(const RigidMotions& motions, const Aggregates& aggregates) {
  constexpr int kRepetitions = 2;  // the second restores the orthogonality lost to rounding
  const int n = static_cast<int>(aggregates.aggregate.size()), num_aggregates = aggregates.size();
  AggregateMotions result;
  RigidMotions& coarse = result.coarse;
  coarse.motion.assign(num_aggregates, Mat6::Identity());
  coarse.reach.assign(num_aggregates, 0.0);
  for (const int centre : aggregates.centre) coarse.centre.push_back(motions.centre[centre]);
  std::vector<Mat6> Q(n);
  for (int i = 0; i < n; ++i) {
    const int aggregate = aggregates.aggregate[i];
    Q[i] = motions.motion[i] * moved_centre(coarse.centre[aggregate], motions.centre[i]);
    const double distance = (motions.centre[i] - coarse.centre[aggregate]).norm();
    coarse.reach[aggregate] = std::max(coarse.reach[aggregate], distance + motions.reach[i]);
  }
  for (int pass = 0; pass < kRepetitions; ++pass) {
    std::vector<Mat6> R(num_aggregates, Mat6::Zero());
    for (int i = 0; i < n; ++i) R[aggregates.aggregate[i]] += Q[i].transpose() * Q[i];
    for (int k = 0; k < num_aggregates; ++k) {
      const Eigen::LLT<Mat6> factor(R[k]);
      if (factor.info() != Eigen::Success) return std::nullopt;
      R[k] = factor.matrixU();
      coarse.motion[k] = (R[k] * coarse.motion[k]).eval();
    }
    for (int i = 0; i < n; ++i)
      R[aggregates.aggregate[i]].triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(Q[i]);
  }
  result.T.num_columns = num_aggregates;
  result.T.column = aggregates.aggregate;
  result.T.value = std::move(Q);
  for (int i = 0; i < n; ++i) result.T.start.push_back(i + 1);
  return result;
}

/// P = (1 - 4/3 / lambda D^-1 A) T: smoothes the motions across the boundaries of the aggregates.
BlockRows smoothed(const BlockRows& A, const std::vector<Mat6>& inverse, const BlockRows& T, double lambda) {
  BlockRows P = multiply(A, T);
  share_range(kOperationsPerInverse * A.num_rows(), A.num_rows(), [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      for (int k = P.start[i]; k < P.start[i + 1]; ++k) {
        P.value[k] = (-4.0 / 3.0 / lambda * inverse[i] * P.value[k]).eval();
        if (P.column[k] == T.column[i]) P.value[k] += T.value[i];
      }
    }
  });
  return P;
}

}  // namespace

bool Multigrid::build(const BlockPattern& pattern, const BlockMatrix& matrix,
                      const RigidMotions& motions_of_blocks) {
  constexpr double kFinestEigenvalue = 2.0;  // bound of lambda, as a contact joins two blocks
  constexpr double kLeastCoarsening = 0.7;   // aggregates per block; with more, a level is not worth its cost
  CUPOLA_ASSERT(std::ssize(motions_of_blocks.motion) == pattern.num_blocks());
  levels_.clear();
  BlockRows A = both_triangles(pattern, matrix);
  RigidMotions motions = motions_of_blocks;
  while (true) {
    ends_in_sweeps_ = is_soft(A);
    if (!ends_in_sweeps_ && A.num_rows() <= kCoarsest) break;
    Level level;
    level.inverse = inverse_diagonal(A);
    if (level.inverse.empty()) return false;
    if (ends_in_sweeps_) {
      level.A = in_order_of_sweeps(A);
      levels_.push_back(std::move(level));
      return true;
    }
    const Aggregates aggregates = aggregate_blocks(A, motions);
    if (aggregates.size() > kLeastCoarsening * A.num_rows()) return false;
    std::optional<AggregateMotions> aggregated = aggregate_motions(motions, aggregates);
    if (!aggregated) return false;
    const double lambda = levels_.empty() ? kFinestEigenvalue : largest_eigenvalue(A, level.inverse);
    level.P = in_single_precision(smoothed(A, level.inverse, aggregated->T, lambda));
    aggregated->T = {};
    level.P_transposed = transpose(level.P);
    level.A = in_order_of_sweeps(A);
    A = galerkin_product(A, level.P, level.P_transposed);
    levels_.push_back(std::move(level));
    motions = std::move(aggregated->coarse);
  }
  return !levels_.empty() && factorize_coarsest(A);
}

bool Multigrid::rebuild(const BlockPattern& pattern, const BlockMatrix& matrix) {
  CUPOLA_ASSERT(!levels_.empty());
  BlockRows A = both_triangles(pattern, matrix);
  for (Level& level : levels_) {
    level.inverse = inverse_diagonal(A);
    if (level.inverse.empty()) return false;
    level.A = in_order_of_sweeps(A);
    if (ends_in_sweeps_ && &level == &levels_.back()) return true;
    A = galerkin_product(A, level.P, level.P_transposed);
  }
  return factorize_coarsest(A);
}

bool Multigrid::factorize_coarsest(const BlockRows& A) {
  BlockPattern pattern;
  BlockMatrix matrix;
  pattern.column_start = {0};
  for (int column = 0; column < A.num_rows(); ++column) {
    for (int k = A.start[column]; k < A.start[column + 1]; ++k) {
      if (A.column[k] == column) matrix.diagonal.push_back(A.value[k]);
      if (A.column[k] <= column) continue;
      pattern.row.push_back(A.column[k]);
      matrix.lower.push_back(A.value[k].transpose());
    }
    pattern.column_start.push_back(pattern.num_pairs());
  }
  return coarsest_.factorize(pattern, matrix);
}

VecX Multigrid::cycle(std::size_t index, const VecX& r) const {
  CUPOLA_ASSERT(!levels_.empty());
  if (index == levels_.size()) return coarsest_.solve(r);
  const Level& level = levels_[index];
  VecX x = sweep_forward(level.A, level.inverse, r);
  if (ends_in_sweeps_ && index + 1 == levels_.size()) {
    complete_sweep(level.A, level.inverse, &x);
    return x;
  }
  const VecX coarse = multiply(level.P_transposed, residual_after_sweep(level.A, x));
  x += multiply(level.P, cycle(index + 1, coarse));
  sweep_backward(level.A, level.inverse, r, &x);
  return x;
}

}  // namespace cupola
