#include "solver/contact/problem/kinematic_bound.hpp"

#include <random>

#include <gtest/gtest.h>

#include "solver/contact/methods/solve_contact.hpp"
#include "tests/solver/contact/contact_scenes.hpp"

namespace cupola::kinematic_bound_test {
namespace {

using scenes::kGravity;

ContactSolution solve(const ContactProblem& problem) {
  ContactSolverOptions options;
  options.tolerance = 1e-9;
  options.reference_speed = kGravity * problem.h;
  ContactSolution x;
  const SolveSummary summary = solve_contact(problem, options, &x);
  EXPECT_EQ(summary.ending, SolveEnding::converged) << summary.message;
  return x;
}

/// Bound over the sum of the computed normal forces; above 1 these are too small for any equilibrium.
double bound_ratio(const ContactProblem& problem) {
  const ContactSolution x = solve(problem);
  return required_normal_force(problem, x.v) / normal_force_sum(problem, x.gamma);
}

/// Arch of 27 voussoirs whose thickness is `share` of the minimum thickness (see arch_test.cpp).
ContactProblem arch(double share, double h) {
  return scenes::arch(27, share * 0.10672, std::numbers::pi / 2, 0.0, h, {0.8, 1e-9, 1e-9});
}

TEST(KinematicBound, IsInfiniteForABlockThatCannotBeHeld) {
  ContactProblem problem = scenes::stack({2000.0}, 0.01, {0.4, 1e-9, 1e-9});
  VecX up = VecX::Zero(6), down = up;
  up[2] = 1.0;
  down[2] = -1.0;
  EXPECT_EQ(required_normal_force(problem, up), 0.0);                          // the loads do no work
  EXPECT_NEAR(required_normal_force(problem, down), 2000.0 * kGravity, 1e-9);  // the ground's reaction
  problem = scenes::incline(0.5, 0.01, {0.4, 0.0, 0.0});                       // slides, as tan a > mu
  VecX along_and_up = VecX::Zero(6);
  along_and_up[0] = 1.0;
  along_and_up[2] = 0.4 + 1e-12;
  EXPECT_EQ(required_normal_force(problem, along_and_up), std::numeric_limits<double>::infinity());
  problem =
      scenes::incline(0.3, 0.01, {0.4, 0.0, 0.0});  // sticks: dilation takes more work than the slope does
  EXPECT_EQ(required_normal_force(problem, along_and_up), 0.0);
}

// No velocities disprove the equilibrium of a structure that stands.
TEST(KinematicBound, StaysBelowTheForcesOfAnEquilibrium) {
  const ContactProblem problem = arch(1.05, 100.0);
  const ContactSolution x = solve(problem);
  const double sum = normal_force_sum(problem, x.gamma);
  EXPECT_LE(required_normal_force(problem, x.v), sum);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 1000; ++trial) {
    VecX v = x.v;
    for (double& component : v) component += 0.1 * x.v.norm() * normal(random);
    EXPECT_LE(required_normal_force(problem, v), sum);
  }
}

// The elastic part of the motion weakens the bound. Its share falls with h^2, so the bound grows with h^2.
TEST(KinematicBound, ProvesThatAnArchFalls) {
  const double at_1 = bound_ratio(arch(0.95, 1.0)), at_10 = bound_ratio(arch(0.95, 10.0));
  EXPECT_GT(at_1, 100.0);
  EXPECT_NEAR(at_10 / at_1, 100.0, 10.0);
  EXPECT_GT(bound_ratio(arch(0.99, 10.0)), 100.0);
  EXPECT_LT(bound_ratio(arch(1.01, 10.0)), 1.0);
}

}  // namespace
}  // namespace cupola::kinematic_bound_test
