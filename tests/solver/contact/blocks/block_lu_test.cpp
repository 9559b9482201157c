// The sparse LU factor and its matrix-vector product against dense ones.

#include "solver/contact/blocks/block_lu.hpp"

#include <limits>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/solver/contact/contact_scenes.hpp"

namespace cupola::block_lu_test {
namespace {

struct Problem {
  BlockPattern pattern;
  UnsymmetricBlockMatrix matrix;
};

VecX random_vector(Eigen::Index n) {
  std::mt19937 random(7);
  VecX x(n);
  for (double& value : x) value = random() / 4294967296.0 - 0.5;
  return x;
}

/// The Jacobian of a dome whose contacts have arbitrary unsymmetric stiffnesses.
Problem dome_jacobian(int rings, int blocks_per_ring) {
  scenes::DomeShape shape;
  shape.rings = rings;
  shape.blocks_per_ring = blocks_per_ring;
  const ContactProblem p = scenes::dome(shape, 1.0, {0.4, 1e-8, 1e-8});
  const ContactGraph graph = contact_graph(p);
  std::vector<Mat3> G(p.num_contacts());
  const VecX values = random_vector(9 * p.num_contacts());
  for (int i = 0; i < p.num_contacts(); ++i)
    G[i] = 1e4 * (Mat3::Identity() + 0.3 * Eigen::Map<const Mat3>(values.data() + 9 * i));
  return {graph.pattern, assemble_jacobian(p, graph, G)};
}

Eigen::MatrixXd dense(const Problem& p) {
  const int nb = p.pattern.num_blocks();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(6 * nb, 6 * nb);
  for (int k = 0; k < nb; ++k) {
    A.block<6, 6>(6 * k, 6 * k) = p.matrix.diagonal[k];
    for (int q = p.pattern.column_start[k]; q < p.pattern.column_start[k + 1]; ++q) {
      A.block<6, 6>(6 * p.pattern.row[q], 6 * k) = p.matrix.lower[q];
      A.block<6, 6>(6 * k, 6 * p.pattern.row[q]) = p.matrix.upper[q];
    }
  }
  return A;
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

}  // namespace
}  // namespace cupola::block_lu_test
