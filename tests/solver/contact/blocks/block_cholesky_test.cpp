// The sparse factor against a dense one, and the same bits for any number of threads.

#include "solver/contact/blocks/block_cholesky.hpp"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "solver/runtime/threads.hpp"
#include "tests/solver/contact/dome_blocks.hpp"

namespace cupola::block_cholesky_test {
namespace {

using testing::random_vector;

struct Problem {
  BlockPattern pattern;
  BlockMatrix matrix;
};

/// The Hessian of a dome with all contacts sticking, not whitened.
Problem dome_hessian(int rings, int blocks_per_ring) {
  const testing::DomeBlocks dome(rings, blocks_per_ring);
  const std::vector<Mat3> G(dome.problem.num_contacts(), 1e4 * Mat3::Identity());
  return {dome.graph.pattern, assemble_hessian(dome.problem, dome.graph, G)};
}

Eigen::MatrixXd dense(const Problem& p) {
  return testing::dense_matrix(p.pattern, p.matrix,
                               [&p](int pair) -> Mat6 { return p.matrix.lower[pair].transpose(); });
}

/// The same with entries of up to 100 beside an inertia of 1.
Problem well_conditioned(Problem p) {
  double largest = 0.0;
  for (Mat6& block : p.matrix.diagonal) largest = std::max(largest, block.norm());
  for (Mat6& block : p.matrix.lower) block *= 100.0 / largest;
  for (Mat6& block : p.matrix.diagonal) block = 100.0 / largest * block + Mat6::Identity();
  return p;
}

// Ten digits, as the condition number of these matrices is 1e4.
TEST(BlockCholesky, MatchesADenseFactor) {
  for (const auto& [rings, slots] : {std::pair{1, 4}, {5, 8}, {9, 12}}) {
    const Problem p = dome_hessian(rings, slots);
    const VecX rhs = random_vector(6 * p.pattern.num_blocks());
    BlockCholesky factor;
    ASSERT_TRUE(factor.factorize(p.pattern, p.matrix));
    const VecX expected = dense(p).llt().solve(rhs);
    EXPECT_LE((factor.solve(rhs) - expected).norm(), 1e-10 * expected.norm()) << rings << " rings";
  }
}

// Rounding the factor to single precision, 6e-8, changes a well-conditioned solution by less than 1e-4. A
// system with entries from 1 to 1e10 is solved in double precision.
TEST(BlockCholesky, SolvesApproximatelyInSinglePrecisionWhereThatIsAccurate) {
  Problem p = well_conditioned(dome_hessian(9, 12));
  const VecX rhs = random_vector(6 * p.pattern.num_blocks());
  BlockCholesky factor;
  ASSERT_TRUE(factor.factorize(p.pattern, p.matrix));
  const VecX exact = factor.solve(rhs), approximate = factor.solve_approximately(rhs);
  EXPECT_LE((approximate - exact).norm(), 1e-4 * exact.norm());
  EXPECT_GT((approximate - exact).norm(), 1e-12 * exact.norm());
  p.matrix.diagonal[5] *= 1e10;
  ASSERT_TRUE(factor.factorize(p.pattern, p.matrix));
  EXPECT_EQ(factor.solve_approximately(rhs), factor.solve(rhs));
}

TEST(BlockCholesky, RejectsIndefiniteMatricesAndNaN) {
  Problem p = dome_hessian(4, 8);
  BlockCholesky factor;
  const Mat6 valid = p.matrix.diagonal[9];
  p.matrix.diagonal[9] = -valid;
  EXPECT_FALSE(factor.factorize(p.pattern, p.matrix));
  p.matrix.diagonal[9](2, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(factor.factorize(p.pattern, p.matrix));
  EXPECT_FALSE(factor.has_factor());
  p.matrix.diagonal[9] = valid;
  EXPECT_TRUE(factor.factorize(p.pattern, p.matrix));
}

// 1,600 blocks: panels wider than a tile, subtrees, and panels above them.
TEST(BlockCholesky, GivesTheSameBitsForAnyNumberOfThreads) {
  const VecX rhs = random_vector(6 * 1600);
  VecX expected, approximate;
  for (const int threads : {1, 2, 3, 8}) {
    set_num_threads(threads);
    const Problem p = well_conditioned(dome_hessian(40, 40));
    BlockCholesky factor;
    ASSERT_TRUE(factor.factorize(p.pattern, p.matrix));
    const VecX x = factor.solve(rhs), y = factor.solve_approximately(rhs);
    if (threads == 1) expected = x, approximate = y;
    EXPECT_TRUE((x.array() == expected.array()).all()) << threads << " threads";
    EXPECT_TRUE((y.array() == approximate.array()).all()) << threads << " threads";
  }
  set_num_threads(1);
}

// Ranges order their matrices on many threads at once. METIS has one sequence of random numbers for all of
// them, and shared sequences give other orders.
TEST(BlockCholesky, OrdersTheSameOnManyThreadsAtOnce) {
  const Problem p = dome_hessian(10, 16);
  const FactorStructure alone = analyze(p.pattern);
  std::atomic<int> others = 0;
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&] {
        for (int k = 0; k < 100; ++k)
          if (analyze(p.pattern).block != alone.block) ++others;
      });
  }
  EXPECT_EQ(others, 0);
}

}  // namespace
}  // namespace cupola::block_cholesky_test
