#include "solver/contact/methods/block_descent.hpp"

#include <gtest/gtest.h>

#include "solver/contact/methods/newton.hpp"
#include "solver/contact/problem/whitening.hpp"
#include "tests/solver/contact/contact_scenes.hpp"

namespace cupola::block_descent_test {
namespace {

const scenes::Joint kJoint{.mu = 0.4};

/// The solution in whitened velocities, with its cost.
PrimalPoint solution_of(const ContactProblem& problem, const WhitenedProblem& white) {
  SolveOptions options;
  options.tolerance = 1e-12;
  options.reference_speed = scenes::kGravity * problem.h;
  ContactSolution solution;
  EXPECT_EQ(NewtonSolver().solve(problem, options, &solution).ending, SolveEnding::converged);
  return primal_point(white, white.to_w(solution.v));
}

TEST(BlockDescent, SolvesProblemsOfOneBlock) {
  for (const double slope : {0.2, 0.39, 0.6}) {  // sticks, nearly slides, slides
    const ContactProblem problem = scenes::incline(slope, 0.01, kJoint);
    const WhitenedProblem white = whiten(problem);
    const PrimalPoint exact = solution_of(problem, white);
    const BlockDescent descent(white);
    PrimalPoint point = primal_point(white, white.w_star);
    for (int k = 0; k < 20; ++k) point = descent.descend(point, 0.0);
    EXPECT_LT((point.w - exact.w).norm(), 1e-10 * white.w_star.norm()) << slope;
  }
}

TEST(BlockDescent, LowersTheCostTowardsTheMinimum) {
  const ContactProblem problem = scenes::arch(20, 0.15, 1.2, 0.1, 0.01, kJoint);
  const WhitenedProblem white = whiten(problem);
  const PrimalPoint exact = solution_of(problem, white);
  const BlockDescent descent(white);
  PrimalPoint point = primal_point(white, white.w_star);
  const double first = point.cost;
  for (int k = 0; k < 50; ++k) {
    const double before = point.cost;
    point = descent.descend(point, 0.0);
    EXPECT_LE(point.cost, before * (1.0 + 1e-15));  // rounding of a sum
    EXPECT_GE(point.cost, exact.cost * (1.0 - 1e-12));
  }
  EXPECT_LT(point.cost - exact.cost, 0.5 * (first - exact.cost));
}

TEST(BlockDescent, SkipsBlocksInEquilibrium) {
  const ContactProblem problem = scenes::arch(20, 0.15, 1.2, 0.0, 0.01, kJoint);
  const WhitenedProblem white = whiten(problem);
  const PrimalPoint exact = solution_of(problem, white);
  const PrimalPoint same = BlockDescent(white).descend(exact, 2.0 * exact.largest_block_gradient);
  EXPECT_EQ(same.w, exact.w);
}

// A block out of equilibrium moves its neighbours, which were in equilibrium before.
TEST(BlockDescent, FollowsBlocksBesideThoseThatMove) {
  const ContactProblem problem = scenes::arch(20, 0.15, 1.2, 0.0, 0.01, kJoint);
  const WhitenedProblem white = whiten(problem);
  const PrimalPoint exact = solution_of(problem, white);
  constexpr int kMoved = 10;
  VecX w = exact.w;
  w[6 * kMoved] += 1e-3 * white.w_star.norm();
  const PrimalPoint start = primal_point(white, w);
  const double small = 1e-6 * start.largest_block_gradient;
  ASSERT_GT(small, exact.largest_block_gradient);
  const PrimalPoint next = BlockDescent(white).descend(start, small);
  const auto moved = [&](int block) { return next.w.segment<6>(6 * block) != start.w.segment<6>(6 * block); };
  for (const int block : {kMoved - 2, kMoved - 1, kMoved, kMoved + 1, kMoved + 2})
    EXPECT_TRUE(moved(block)) << block;
  EXPECT_LT(next.cost, start.cost);
}

}  // namespace
}  // namespace cupola::block_descent_test
