#include "solver/contact/methods/coulomb_direction.hpp"

#include <gtest/gtest.h>

#include "solver/contact/methods/coulomb_subproblem.hpp"
#include "solver/contact/problem/whitening.hpp"
#include "tests/solver/contact/contact_scenes.hpp"

namespace cupola::coulomb_direction_test {
namespace {

/// A dome of compliant contacts under Coulomb's law with random relative velocities, so that contacts stick,
/// slide and open side by side.
struct System {
  System(double friction, unsigned seed) : problem(scenes::dome(shape(), 0.01, {friction, 1e-8, 1e-8})) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const CoulombSubproblem sub{white, 0.0, 1.0, VecX::Zero(problem.num_contacts()),
                                VecX::Zero(problem.b.size())};
    VecX y(problem.b.size());
    for (double& value : y) value = normal(random) - 0.5;
    G = sub.stiffnesses(y);
    F = VecX::NullaryExpr(problem.v_star.size(), [&] { return normal(random); });
  }
  System(const System&) = delete;  // `white` refers to `problem`

  static scenes::DomeShape shape() {
    scenes::DomeShape shape;
    shape.rings = 8;
    shape.blocks_per_ring = 12;
    return shape;
  }

  const ContactProblem problem;
  const WhitenedProblem white = whiten(problem);
  const ContactGraph graph = contact_graph(problem);
  std::vector<Mat3> G;
  VecX F;
};

struct Solved {
  double residual;  ///< |J d - F| / |F|
  SolveSummary summary;
};

Solved solve(const System& s, std::optional<double> forcing, CoulombDirection* direction) {
  Solved solved;
  VecX d;
  EXPECT_TRUE(direction->solve(s.G, s.F, {.forcing = forcing}, &d, &solved.summary));
  const UnsymmetricBlockMatrix J = ContactJacobian(s.white, s.graph).at(s.G);
  solved.residual = (multiply(s.graph.pattern, J, d) - s.F).norm() / s.F.norm();
  return solved;
}

/// Leaves the Cholesky factor of a matrix in which every contact sticks.
void factorize_sticking(const System& s, CoulombDirection* direction) {
  SolveSummary summary;
  VecX d;
  const std::vector<Mat3> G(s.G.size(), Mat3::Identity());
  ASSERT_TRUE(direction->solve_symmetric(G, s.F, &d, &summary));
}

TEST(CoulombDirection, AddsTheDampingToTheDiagonal) {
  const System system(0.4, 1);
  constexpr double damping = 100.0;
  BlockLu lu;
  CoulombDirection direction(system.white, system.graph, &lu);
  SolveSummary summary;
  VecX d;
  ASSERT_TRUE(direction.solve(system.G, system.F, {.damping = damping}, &d, &summary));
  const UnsymmetricBlockMatrix J = ContactJacobian(system.white, system.graph).at(system.G);
  const VecX error = multiply(system.graph.pattern, J, d) + damping * d - system.F;
  EXPECT_LE(error.norm(), 1e-11 * system.F.norm());  // condition about 1e2
}

// Up to friction 5 the matrices are far from symmetric, and those of friction 0 are symmetric.
TEST(CoulombDirection, MeetsItsForcing) {
  for (const double friction : {0.0, 0.05, 0.4, 5.0}) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
      const System system(friction, seed);
      BlockLu lu;
      CoulombDirection direction(system.white, system.graph, &lu);
      factorize_sticking(system, &direction);
      for (const double forcing : {0.1, 1e-3, 1e-6})
        EXPECT_LE(solve(system, forcing, &direction).residual, 1.01 * forcing) << friction;  // 1 %: rounding
      const Solved exact = solve(system, std::nullopt, &direction);
      EXPECT_LE(exact.residual, 1e-9) << friction;  // condition about 1e4
      EXPECT_EQ(exact.summary.factorizations, 1);
      EXPECT_EQ(exact.summary.conjugate_gradients, 0);
    }
  }
}

// A Cholesky factor is renewed as one where that serves, as it does for a symmetric matrix, and an LU factor
// takes its place where it does not. Either is kept for the next system.
TEST(CoulombDirection, RenewsFactorsOfTheKindThatServes) {
  System system(0.4, 1);
  const std::vector<Mat3> sliding = system.G;
  BlockLu lu;
  CoulombDirection direction(system.white, system.graph, &lu);
  factorize_sticking(system, &direction);
  for (Mat3& G : system.G) G = 1e4 * Mat3::Identity();
  Solved solved = solve(system, 1e-6, &direction);
  EXPECT_EQ(solved.summary.factorizations, 1);
  EXPECT_EQ(solved.summary.conjugate_gradients, 12 + 1);  // without success, and with its own factor
  EXPECT_EQ(solve(system, 1e-6, &direction).summary.factorizations, 0);
  for (std::size_t i = 0; i < sliding.size(); ++i) system.G[i] = 1e4 * sliding[i];
  solved = solve(system, 1e-12, &direction);
  EXPECT_EQ(solved.summary.factorizations, 2);  // Cholesky, then LU
  solved = solve(system, 1e-6, &direction);
  EXPECT_EQ(solved.summary.factorizations, 0);
  EXPECT_EQ(solved.summary.conjugate_gradients, 1);  // with the LU factor of the same matrix
}

// The first factor is of the kind that is asked for, if it serves.
TEST(CoulombDirection, BeginsWithTheFactorAskedFor) {
  using First = CoulombDirection::First;
  const System system(5.0, 1);
  const auto begins_with_lu = [&](double forcing, First first) {
    BlockLu lu;
    CoulombDirection direction(system.white, system.graph, &lu, first);
    EXPECT_LE(solve(system, forcing, &direction).residual, 0.101);  // the larger forcing, and rounding
    return lu.has_factor();
  };
  EXPECT_TRUE(begins_with_lu(0.1, First::unsymmetric));
  EXPECT_FALSE(begins_with_lu(0.1, First::symmetric));
  EXPECT_TRUE(begins_with_lu(1e-12, First::symmetric));  // GMRES takes more iterations than it may
}

}  // namespace
}  // namespace cupola::coulomb_direction_test
