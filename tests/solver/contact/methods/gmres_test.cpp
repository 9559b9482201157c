#include "solver/contact/methods/gmres.hpp"

#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace cupola::gmres_test {
namespace {

// In exact arithmetic GMRES solves a system of n unknowns in n iterations, with any preconditioner.
TEST(Gmres, SolvesInAsManyIterationsAsUnknowns) {
  constexpr int n = 12;
  std::mt19937 random(3);
  const auto entry = [&random] { return random() / 4294967296.0 - 0.5; };
  const Eigen::MatrixXd A = 2.0 * Eigen::MatrixXd::Identity(n, n) + Eigen::MatrixXd::NullaryExpr(n, n, entry);
  const VecX rhs = VecX::NullaryExpr(n, entry), diagonal = A.diagonal();
  VecX x;
  const auto solve = [&](double forcing, int limit) {
    return gmres([&](const VecX& v) { return VecX(A * v); },
                 [&](const VecX& v) { return VecX(v.cwiseQuotient(diagonal)); }, rhs, forcing, limit, &x);
  };
  EXPECT_GT(solve(1e-12, n), 0);
  EXPECT_LE((A * x - rhs).norm(), 2e-12 * rhs.norm()) << "the stated reduction, with rounding";
  const int coarse = solve(0.1, n);
  EXPECT_GT(coarse, 0);
  EXPECT_LT(coarse, n) << "stops early";
  EXPECT_LE((A * x - rhs).norm(), 0.1000001 * rhs.norm());
  EXPECT_EQ(solve(1e-12, 2), 0) << "two iterations do not suffice";
}

}  // namespace
}  // namespace cupola::gmres_test
