// The sparse factor against a dense one, and the same bits for any number of threads.

#include "solver/contact/blocks/block_cholesky.hpp"

#include <random>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "solver/runtime/threads.hpp"
#include "tests/solver/contact/contact_scenes.hpp"

namespace cupola::block_cholesky_test {
namespace {

struct Problem {
  BlockPattern pattern;
  BlockMatrix matrix;
};

/// The Hessian of a dome with all contacts sticking, not whitened.
Problem dome_hessian(int rings, int blocks_per_ring) {
  scenes::DomeShape shape;
  shape.rings = rings;
  shape.blocks_per_ring = blocks_per_ring;
  const ContactProblem p = scenes::dome(shape, 1.0, {0.4, 1e-8, 1e-8});
  const ContactGraph graph = contact_graph(p);
  const std::vector<Mat3> G(p.num_contacts(), 1e4 * Mat3::Identity());
  return {graph.pattern, assemble_hessian(p, graph, G)};
}

Eigen::MatrixXd dense(const Problem& p) {
  const int nb = p.pattern.num_blocks();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(6 * nb, 6 * nb);
  for (int k = 0; k < nb; ++k) {
    A.block<6, 6>(6 * k, 6 * k) = p.matrix.diagonal[k];
    for (int q = p.pattern.column_start[k]; q < p.pattern.column_start[k + 1]; ++q) {
      A.block<6, 6>(6 * p.pattern.row[q], 6 * k) = p.matrix.lower[q];
      A.block<6, 6>(6 * k, 6 * p.pattern.row[q]) = p.matrix.lower[q].transpose();
    }
  }
  return A;
}

VecX random_vector(Eigen::Index n) {
  std::mt19937 random(7);
  VecX x(n);
  for (double& value : x) value = random() / 4294967296.0 - 0.5;
  return x;
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
  VecX expected;
  for (const int threads : {1, 2, 3}) {
    set_num_threads(threads);
    const Problem p = dome_hessian(40, 40);
    BlockCholesky factor;
    ASSERT_TRUE(factor.factorize(p.pattern, p.matrix));
    const VecX x = factor.solve(rhs);
    if (threads == 1) expected = x;
    EXPECT_TRUE((x.array() == expected.array()).all()) << threads << " threads";
  }
  set_num_threads(1);
}

}  // namespace
}  // namespace cupola::block_cholesky_test
