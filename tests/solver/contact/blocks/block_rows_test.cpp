// Sparse rows of 6x6 blocks against dense matrices.

#include "solver/contact/blocks/block_rows.hpp"

#include <random>

#include <gtest/gtest.h>

#include "solver/contact/problem/whitening.hpp"
#include "solver/runtime/threads.hpp"
#include "tests/solver/contact/contact_scenes.hpp"

namespace cupola::block_rows_test {
namespace {

template <class Scalar>
Eigen::MatrixXd dense(const BlockRowsOf<Scalar>& A) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(6 * A.num_rows(), 6 * A.num_columns);
  for (int i = 0; i < A.num_rows(); ++i) {
    for (int k = A.start[i]; k < A.start[i + 1]; ++k)
      result.template block<6, 6>(6 * i, 6 * A.column[k]) = A.value[k].template cast<double>();
  }
  return result;
}

/// A quarter of the blocks filled at random.
BlockRows random_rows(int rows, int columns, unsigned seed) {
  std::mt19937 random(seed);
  BlockRows A;
  A.num_columns = columns;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      if (random() % 4 != 0) continue;
      A.column.push_back(j);
      A.value.push_back(
          Mat6::NullaryExpr([&](Eigen::Index, Eigen::Index) { return random() / 4294967296.0 - 0.5; }));
    }
    A.start.push_back(static_cast<int>(A.column.size()));
  }
  return A;
}

constexpr double kRounding = 1e-13;  // of sums of about a hundred products of numbers below one

TEST(BlockRows, MultiplyLikeDenseMatrices) {
  const BlockRows A = random_rows(30, 20, 1), B = random_rows(20, 25, 2);
  const VecX x = VecX::LinSpaced(6 * 20, -1.0, 1.0);
  EXPECT_LT((multiply(A, x) - dense(A) * x).norm(), kRounding * x.norm());
  EXPECT_LT((dense(multiply(A, B)) - dense(A) * dense(B)).cwiseAbs().maxCoeff(), kRounding);
  const SingleBlockRows S = in_single_precision(B);
  EXPECT_EQ(dense(transpose(S)), dense(S).transpose());
  const BlockRows square = random_rows(20, 20, 5);
  const Eigen::MatrixXd expected = dense(S).transpose() * dense(square) * dense(S);
  EXPECT_LT((dense(galerkin_product(square, S, transpose(S))) - expected).cwiseAbs().maxCoeff(),
            kRounding * expected.cwiseAbs().maxCoeff());
}

/// M + sum of D G D^T over the contacts, by definition.
Eigen::MatrixXd dense_hessian(const ContactProblem& p, const std::vector<Mat3>& G) {
  const Eigen::Index n = 6 * p.num_blocks();
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(n, n);
  for (int k = 0; k < p.num_blocks(); ++k) H.block<6, 6>(6 * k, 6 * k) = p.M[k];
  for (int i = 0; i < p.num_contacts(); ++i) {
    Eigen::MatrixXd D = Eigen::MatrixXd::Zero(n, 3);
    const int a = p.block_a[i], b = p.block_b[i];
    if (a != ContactProblem::kFixed) D.middleRows<6>(6 * a) += p.D_a[i].matrix();
    if (b != ContactProblem::kFixed) D.middleRows<6>(6 * b) += p.D_b[i].matrix();
    H += D * G[i] * D.transpose();
  }
  return H;
}

// A dome, and one sector of it with one block and with two blocks in each ring: their contacts join images of
// one block, and of two blocks.
TEST(BlockMatrix, IsTheSumOverTheContacts) {
  constexpr double kShare = 1e-13;  // rounding of the terms
  for (const int sectors : {1, 8, 4}) {
    const ContactProblem p = scenes::dome({.rings = 5, .blocks_per_ring = 8, .sectors = sectors}, 1.0, {});
    const ContactGraph graph = contact_graph(p);
    std::vector<Mat3> G;
    for (int i = 0; i < p.num_contacts(); ++i) {
      const Mat3 root = Mat3::Identity() + 0.1 * Mat3::Random();
      G.push_back(1e3 * root * root.transpose());
    }
    const auto expect_near = [&](const BlockMatrix& matrix, const Eigen::MatrixXd& expected) {
      const Eigen::MatrixXd H = dense(both_triangles(graph.pattern, matrix));
      EXPECT_LT((H - expected).cwiseAbs().maxCoeff(), kShare * expected.cwiseAbs().maxCoeff()) << sectors;
    };
    const Eigen::MatrixXd H = dense_hessian(p, G);
    expect_near(assemble_hessian(p, graph, G), H);
    const WhitenedProblem white = whiten(p);
    Eigen::MatrixXd L_inverse = Eigen::MatrixXd::Zero(H.rows(), H.cols());
    for (int k = 0; k < p.num_blocks(); ++k) L_inverse.block<6, 6>(6 * k, 6 * k) = white.L_inverse[k];
    expect_near(assemble_hessian(white, graph, G), L_inverse * H * L_inverse.transpose());
  }
}

TEST(BlockRows, AreSortedInAProduct) {
  const BlockRows C = multiply(random_rows(30, 20, 3), random_rows(20, 25, 4));
  for (int i = 0; i < C.num_rows(); ++i) {
    for (int k = C.start[i] + 1; k < C.start[i + 1]; ++k) EXPECT_LT(C.column[k - 1], C.column[k]);
  }
}

TEST(BlockRows, ContainBothTriangles) {
  const ContactProblem p = scenes::dome({.rings = 5, .blocks_per_ring = 8}, 1.0, {});
  const ContactGraph graph = contact_graph(p);
  const BlockMatrix H = assemble_hessian(p, graph, std::vector<Mat3>(p.num_contacts(), Mat3::Identity()));
  const BlockRows A = both_triangles(graph.pattern, H);
  const Eigen::MatrixXd full = dense(A);
  EXPECT_LT((full - full.transpose()).cwiseAbs().maxCoeff(), kRounding * full.cwiseAbs().maxCoeff());
  const VecX x = VecX::LinSpaced(6 * p.num_blocks(), -1.0, 1.0);
  const VecX y = multiply(graph.pattern, H, x);
  EXPECT_LT((multiply(A, x) - y).norm(), kRounding * y.norm());
}

// 4,800 blocks: enough work for a second thread in the product of the matrix with itself, and more rows than
// the product with two matrices takes at once.
TEST(BlockRows, GiveTheSameBitsForAnyNumberOfThreads) {
  const ContactProblem p = scenes::dome({.rings = 75, .blocks_per_ring = 64}, 1.0, {});
  const ContactGraph graph = contact_graph(p);
  const BlockRows A = both_triangles(
      graph.pattern, assemble_hessian(p, graph, std::vector<Mat3>(p.num_contacts(), Mat3::Identity())));
  const VecX x = VecX::LinSpaced(6 * p.num_blocks(), -1.0, 1.0);
  const SingleBlockRows S = in_single_precision(A), S_transposed = transpose(S);
  const BlockRows alone = multiply(A, A), galerkin = galerkin_product(A, S, S_transposed);
  for (const int threads : {2, 3}) {
    set_num_threads(threads);
    const BlockRows together = multiply(A, A);
    EXPECT_EQ(together.column, alone.column);
    EXPECT_EQ(together.value, alone.value);
    EXPECT_EQ(multiply(together, x), multiply(alone, x));
    EXPECT_EQ(galerkin_product(A, S, S_transposed).value, galerkin.value);
  }
  set_num_threads(1);
}

}  // namespace
}  // namespace cupola::block_rows_test
