// The sparse LU factor and its matrix-vector product against dense ones.

#include "solver/contact/blocks/block_lu.hpp"

#include <limits>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "solver/runtime/interruption.hpp"
#include "solver/runtime/threads.hpp"
#include "tests/solver/contact/dome_blocks.hpp"

namespace cupola::block_lu_test {
namespace {

using testing::random_vector;

struct Problem {
  BlockPattern pattern;
  UnsymmetricBlockMatrix matrix;
};

/// The Jacobian of a dome whose contacts have arbitrary unsymmetric stiffnesses.
Problem dome_jacobian(int rings, int blocks_per_ring) {
  const testing::DomeBlocks dome(rings, blocks_per_ring);
  std::vector<Mat3> G(dome.problem.num_contacts());
  const VecX values = random_vector(9 * dome.problem.num_contacts());
  for (int i = 0; i < dome.problem.num_contacts(); ++i)
    G[i] = 1e4 * (Mat3::Identity() + 0.3 * Eigen::Map<const Mat3>(values.data() + 9 * i));
  return {dome.graph.pattern, ContactJacobian(whiten(dome.problem), dome.graph).at(G)};
}

Eigen::MatrixXd dense(const Problem& p) {
  return testing::dense_matrix(p.pattern, p.matrix, [&p](int pair) { return p.matrix.upper[pair]; });
}

// What is kept from the last matrix does not show in the next, whatever changes between them.
TEST(ContactJacobian, HasTheSameBitsAfterAnySequence) {
  const testing::DomeBlocks dome(5, 8);
  const int nc = dome.problem.num_contacts();
  const WhitenedProblem white = whiten(dome.problem);
  ContactJacobian kept(white, dome.graph);
  std::vector<Mat3> G(nc, Mat3::Zero());
  for (const int every : {1, 7, 29, nc + 1, 3}) {
    const VecX values = every * random_vector(9 * nc);
    for (int i = 0; i < nc; i += every)
      G[i] = i % 2 == 0 ? Mat3(Eigen::Map<const Mat3>(values.data() + 9 * i)) : Mat3(Mat3::Zero());
    const UnsymmetricBlockMatrix& J = kept.at(G);
    ContactJacobian anew(white, dome.graph);
    EXPECT_EQ(J.diagonal, anew.at(G).diagonal);
    EXPECT_EQ(J.lower, anew.at(G).lower);
    EXPECT_EQ(J.upper, anew.at(G).upper);
    const VecX x = random_vector(6 * dome.graph.pattern.num_blocks());
    VecX expected = relative_velocity(white, x);
    for (int i = 0; i < nc; ++i) expected.segment<3>(3 * i) = (G[i] * expected.segment<3>(3 * i)).eval();
    expected = x + generalized_impulse(white, expected);
    EXPECT_LE((multiply(dome.graph.pattern, J, x) - expected).norm(), 1e-13 * expected.norm());  // rounding
  }
}

// Ten digits, as the condition number of these matrices is 1e4.
TEST(BlockLu, MatchesADenseFactor) {
  BlockLu factor;
  for (const auto& [rings, slots] : {std::pair{1, 4}, {5, 8}, {9, 12}}) {
    const Problem p = dome_jacobian(rings, slots);
    const VecX rhs = random_vector(6 * p.pattern.num_blocks());
    const Eigen::MatrixXd A = dense(p);
    EXPECT_GT((A - A.transpose()).norm(), 1e-3 * A.norm()) << "the test must not be symmetric";
    ASSERT_TRUE(factor.factorize(p.pattern, p.matrix));
    const VecX expected = A.partialPivLu().solve(rhs);
    EXPECT_LE((factor.solve(rhs) - expected).norm(), 1e-10 * expected.norm()) << rings << " rings";
    EXPECT_LE((multiply(p.pattern, p.matrix, rhs) - A * rhs).norm(), 1e-13 * (A * rhs).norm());
  }
}

TEST(BlockLu, RejectsSingularMatricesAndNaN) {
  Problem p = dome_jacobian(2, 6);
  BlockLu factor;
  for (const double value : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    Problem broken = p;
    broken.matrix.diagonal[3].setConstant(value);
    for (int k = 0; k < p.pattern.num_blocks(); ++k)
      for (int q = p.pattern.column_start[k]; q < p.pattern.column_start[k + 1]; ++q)
        if (k == 3 || p.pattern.row[q] == 3) {
          broken.matrix.lower[q].setZero();
          broken.matrix.upper[q].setZero();
        }
    EXPECT_FALSE(factor.factorize(broken.pattern, broken.matrix)) << value;
    EXPECT_FALSE(factor.has_factor());
  }
  EXPECT_TRUE(factor.factorize(p.pattern, p.matrix)) << "usable again";
}

// 1,600 blocks: panels wider than a tile, subtrees, and panels above them.
TEST(BlockLu, GivesTheSameBitsForAnyNumberOfThreads) {
  VecX expected, expected_product;
  for (const int threads : {1, 2, 3, 8}) {
    set_num_threads(threads);
    const Problem p = dome_jacobian(40, 40);
    const VecX rhs = random_vector(6 * p.pattern.num_blocks());
    BlockLu factor;
    ASSERT_TRUE(factor.factorize(p.pattern, p.matrix));
    const VecX x = factor.solve(rhs), product = multiply(p.pattern, p.matrix, rhs);
    if (threads == 1) expected = x, expected_product = product;
    EXPECT_TRUE((x.array() == expected.array()).all()) << threads << " threads";
    EXPECT_TRUE((product.array() == expected_product.array()).all()) << threads << " threads";
  }
  set_num_threads(1);
}

// A factorisation of 6,400 blocks takes a tenth of a second; an interruption ends it between two panels.
TEST(BlockLu, ObeysAnInterruption) {
  const Problem p = dome_jacobian(80, 80);
  BlockLu factor;
  {
    const TimeLimit limit(1e-3);
    EXPECT_THROW((void)factor.factorize(p.pattern, p.matrix), Interrupted);
  }
  EXPECT_FALSE(factor.has_factor());
  EXPECT_TRUE(factor.factorize(p.pattern, p.matrix)) << "usable again";
}

}  // namespace
}  // namespace cupola::block_lu_test
