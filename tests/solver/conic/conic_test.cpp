// Ranges and limits with closed forms, and the certificates of problems without a solution.
#include <numbers>

#include <gtest/gtest.h>

#include "solver/conic/motion_proof.hpp"
#include "solver/conic/opening_motion.hpp"
#include "tests/solver/conic/conic_scenes.hpp"

namespace cupola::conic_test {
namespace {

using scenes::conic;
using scenes::Joint;
using scenes::maximise_load;
using scenes::range;
using scenes::sideways;

// The solver asks for 1e-9 of the problem's values. A hundred times that leaves room for the scaling of one
// force by the whole.
constexpr double kAgrees = 1e-7;

// N_++ = W (1 + x + y) / 4 + t, and the other legs likewise, with a free t: legs (++) and (--) gain what the
// others lose.
TEST(Conic, RangeOfALegOfATable) {
  const double W = 1000.0, x = 0.3, y = -0.2;
  ConicProblem problem = conic(scenes::table(W, x, y, 0.01, {.mu = 0.4}));
  problem.cost[0] = 1.0;
  const auto [least, largest] = range(problem);
  const double a = W * (1 + x + y) / 4, b = W * (1 + x - y) / 4, c = W * (1 - x + y) / 4,
               d = W * (1 - x - y) / 4;
  EXPECT_NEAR(least, a - std::min(a, d), kAgrees * W);
  EXPECT_NEAR(largest, a + std::min(b, c), kAgrees * W);
}

// Of two bodies on each other the lower joint carries both weights. Without friction nothing holds them
// sideways, so that the equilibrium rows are dependent.
TEST(Conic, ForceThatEquilibriumDeterminesHasNoRange) {
  for (const double mu : {0.0, 0.4}) {
    ConicProblem problem = conic(scenes::stack({1000.0, 2000.0}, 0.01, {.mu = mu}));
    for (int i = 0; i < 4; ++i) problem.cost[3 * i] = 1.0;
    const auto [least, largest] = range(problem);
    const double weight = 3000.0 * scenes::kGravity;
    EXPECT_NEAR(least, weight, kAgrees * weight) << mu;
    EXPECT_NEAR(largest, weight, kAgrees * weight) << mu;
  }
}

// A block of 1 x 1 x 0.2 m slides at mu, or tips at width / height = 5.
TEST(Conic, HorizontalLoadSlidesOrTipsABlock) {
  for (const double mu : {1e-4, 0.3, 1.0, 10.0}) {
    ConicProblem problem = conic(scenes::incline(0.0, 0.01, {.mu = mu}));
    maximise_load(&problem, sideways(problem));
    const ConicSolution solution = solve_conic(problem);
    ASSERT_EQ(solution.outcome, ConicOutcome::optimal) << mu;
    EXPECT_NEAR(solution.multipliers[0], std::min(mu, 5.0), kAgrees * std::min(mu, 5.0)) << mu;
    EXPECT_NEAR(-solution.dual, std::min(mu, 5.0), kAgrees * std::min(mu, 5.0)) << mu;
  }
}

/// Block of 1 x 1 x 0.2 m on level ground, on 8 x 8 points of which 4 would do.
ContactProblem block_on_many_points(const Joint& joint) {
  scenes::Scene scene(0.01, {0, 0, -scenes::kGravity});
  const int block = scene.add_box({0, 0, 0.1}, {1, 1, 0.2}, 2000.0);
  for (int i = 0; i < 64; ++i)
    scene.add_contact(scenes::kGround, block, {(i / 8) / 7.0 - 0.5, (i % 8) / 7.0 - 0.5, 0.0}, {0, 0, 1},
                      joint);
  return scene.problem();
}

TEST(Conic, RedundantPointsChangeNothing) {
  for (const double mu : {0.3, 10.0}) {
    ConicProblem problem = conic(block_on_many_points({.mu = mu}));
    maximise_load(&problem, sideways(problem));
    const ConicSolution solution = solve_conic(problem);
    ASSERT_EQ(solution.outcome, ConicOutcome::optimal) << mu;
    EXPECT_NEAR(solution.multipliers[0], std::min(mu, 5.0), kAgrees * std::min(mu, 5.0)) << mu;
  }
  // The half at x < 0 carries the least where it presses at its edge, 1/2 from the middle, and the other half
  // at its nearest points, 1/14 from it.
  ConicProblem problem = conic(block_on_many_points({.mu = 0.3}));
  for (int i = 0; i < 32; ++i) problem.cost[3 * i] = 1.0;
  const auto [least, largest] = range(problem);
  const double weight = 400.0 * scenes::kGravity;
  EXPECT_NEAR(least, weight / 8, kAgrees * weight);
  EXPECT_NEAR(largest, weight * 7 / 8, kAgrees * weight);
}

// Slope 0.5 at mu = 0.4. The proof is a motion that no joint resists and that the weight drives.
TEST(Conic, BlockThatSlidesHasNoAdmissibleState) {
  const ConicProblem problem = conic(scenes::incline(0.5, 0.01, {.mu = 0.4}));
  const ConicSolution solution = solve_conic(problem);
  ASSERT_EQ(solution.outcome, ConicOutcome::infeasible);
  const VecX& v = solution.v;
  EXPECT_GT(problem.load.dot(v), 0.0);
  const VecX s = relative_velocity(problem.contacts, v);
  for (int i = 0; i < 4; ++i)
    EXPECT_LE(0.4 * s.segment<2>(3 * i + 1).norm() - s[3 * i], 1e-8 * v.head<3>().norm());
  EXPECT_GT(v[0], 0.0);  // down the slope
}

// At mu = 0.6 on a slope of 0.5 the same block stands.
TEST(Conic, BlockThatHoldsHasAnAdmissibleState) {
  EXPECT_EQ(solve_conic(conic(scenes::incline(0.5, 0.01, {.mu = 0.6}))).outcome, ConicOutcome::optimal);
}

// Between two walls a block can be pressed by any force.
TEST(Conic, ClampedBlockHasUnboundedForces) {
  scenes::Scene scene(0.01, {0, 0, -scenes::kGravity});
  const int block = scene.add_box({0, 0, 0}, {1, 1, 1}, 2000.0);
  scene.add_patch(scenes::kGround, block, {-0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {1, 0, 0}, {.mu = 0.4});
  scene.add_patch(block, scenes::kGround, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {1, 0, 0}, {.mu = 0.4});
  ConicProblem problem = conic(scene.problem());
  problem.cost[0] = -1.0;
  const ConicSolution ray = solve_conic(problem);
  ASSERT_EQ(ray.outcome, ConicOutcome::unbounded);
  EXPECT_GT(ray.gamma[0], 0.0);
  const VecX imbalance = generalized_impulse(problem.contacts, ray.gamma);
  EXPECT_LE(imbalance.norm(), 1e-7 * ray.gamma.norm());
  // Its least force is what friction needs: 4 mu (N + N') = W on both sides together.
  problem.cost.setZero();
  for (int i = 0; i < 4; ++i) problem.cost[3 * i] = 1.0;
  const ConicSolution least = solve_conic(problem);
  ASSERT_EQ(least.outcome, ConicOutcome::optimal);
  const double weight = 2000.0 * scenes::kGravity;
  EXPECT_NEAR(least.primal, weight / (2 * 0.4), kAgrees * weight);
}

// 27 polygonal voussoirs, t/R = 0.15, over the weight: primal and dual of an independent interior-point
// program agree to the digits given. At mu = 0.4 the base slides at H = mu V, V = W / 2.
TEST(Conic, ThrustOfASemicircularArch) {
  for (const double mu : {0.5, 0.4}) {
    ConicProblem problem = conic(scenes::arch(27, 0.15, std::numbers::pi / 2, 0.0, 0.01, {.mu = mu}));
    const double weight = -problem.load(Eigen::seq(2, Eigen::last, 6)).sum();
    // Force of the first voussoir on the left springing, outwards: minus that of the ground on it.
    for (int i = 0; i < 4; ++i)
      problem.cost.segment<3>(3 * i) = problem.contacts.D_b[i].frame.row(0).transpose() / weight;
    const auto [least, largest] = range(problem);
    EXPECT_NEAR(least, 0.1755685, 1e-7) << mu;
    EXPECT_NEAR(largest, mu == 0.4 ? 0.2 : 0.2273735, 1e-7) << mu;
  }
}

// Ratio of two legs of the table by the transformation of Charnes and Cooper: forces over the denominator,
// the weight a free multiplier.
TEST(Conic, RangeOfARatio) {
  const double W = 1000.0, x = 0.3, y = -0.2;
  ConicProblem problem = conic(scenes::table(W, x, y, 0.01, {.mu = 0.4}));
  problem.cost[0] = 1.0;
  problem.load_columns = problem.load;
  problem.load.setZero();
  problem.multiplier_cost = VecX::Zero(1);
  problem.rows = MatX::Zero(problem.cost.size(), 1);
  problem.rows(3, 0) = 1.0;  // the force of leg (+-) is 1
  problem.row_multipliers = MatX::Zero(1, 1);
  problem.row_values = VecX::Ones(1);
  const ConicSolution solution = solve_conic(problem);
  ASSERT_EQ(solution.outcome, ConicOutcome::optimal);
  const double a = (1 + x + y) / 4, b = (1 + x - y) / 4, d = (1 - x - y) / 4;
  EXPECT_NEAR(solution.primal, (a - std::min(a, d)) / (b + std::min(a, d)), kAgrees);
  EXPECT_GT(solution.multipliers[0], 0.0);
}

// 200 cubes, each closed joint a hinge at x = 0.5 m: the loads drive the mechanism at width / height. Bounds
// to 1e-6 need a mechanism without the rounding of 800 contacts.
TEST(Conic, OpeningMotionSharpensTheBoundOfASlenderTower) {
  ConicProblem problem = conic(scenes::stack(std::vector(200, 1000.0), 0.01, {.mu = 2.0}));
  maximise_load(&problem, sideways(problem));
  ConicSolution solution = solve_conic(problem);
  const ConicBounds rough = conic_bounds(problem, solution);
  ASSERT_TRUE(open_contacts(problem, &solution));
  const ConicBounds sharp = conic_bounds(problem, solution);
  const double exact = 1.0 / 200;
  EXPECT_LE(-sharp.upper, exact * (1 + 1e-12));
  EXPECT_GE(-sharp.lower, exact * (1 - 1e-12));
  EXPECT_LE(sharp.upper - sharp.lower, 1e-6 * exact);
  EXPECT_LE(sharp.upper - sharp.lower, rough.upper - rough.lower);
}

// A cube of weight W sinks at e into its bed of four points: the load does W e, and forces of N W / 400 at
// each point as much from N = 100 on.
TEST(Conic, StatesUpToWhichForcesAMotionIsDriven) {
  const ConicProblem problem = conic(scenes::stack({1000.0}, 0.01, {.mu = 0.5}));
  const double weight = -problem.load[2];
  ASSERT_EQ(problem.contacts.num_contacts(), 4);
  ConicSolution sinking;
  sinking.gamma = VecX::Zero(12);
  sinking.gamma(Eigen::seq(0, Eigen::last, 3)).setConstant(weight / 400);
  sinking.v = VecX::Zero(6);
  sinking.v[2] = -1e-3;
  sinking.row_velocities = VecX(0);
  sinking.multipliers = VecX(0);
  EXPECT_NEAR(positive_up_to(problem, sinking), 100.0, 1.0) << "the search ends within 1 %";
  sinking.v *= -1.0;
  EXPECT_EQ(positive_up_to(problem, sinking), 0.0) << "the weight resists";
}

// A cube of weight W on four points that bear 1.5 W together, and W t on it: t is at most 0.5. Without forces
// it is in equilibrium at t = -1, which must not bound the forces of other states.
TEST(Conic, VanishingForcesBoundNoOthers) {
  ConicProblem problem = conic(scenes::stack({1000.0}, 0.01, {.mu = 0.5}));
  maximise_load(&problem, problem.load);
  const double weight = -problem.load[2];
  problem.contacts.strength.assign(4, ContactStrength{.compression = 1.5 * weight / 4});
  ConicSolution lifted;
  lifted.gamma = VecX::Zero(12);
  lifted.v = VecX::Zero(6);
  lifted.v[2] = -1.0 / weight;
  lifted.row_velocities = VecX(0);
  lifted.multipliers = VecX::Constant(1, -1.0);
  EXPECT_NEAR(conic_bounds(problem, lifted).lower, -0.5, kAgrees);
}

// A block between two walls can jam: no motion opens both joints.
TEST(Conic, NoMotionOpensAJammedBlock) {
  scenes::Scene scene(0.01, {0, 0, -scenes::kGravity});
  const int block = scene.add_box({0, 0, 0}, {1, 1, 1}, 2000.0);
  for (const double side : {-1.0, 1.0})
    scene.add_patch(scenes::kGround, block, {0.5 * side, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {-side, 0, 0},
                    {.mu = 0.4});
  ConicProblem problem = conic(scene.problem());
  maximise_load(&problem, problem.load);
  ConicSolution solution;
  solution.v = VecX::Ones(6);
  EXPECT_FALSE(open_contacts(problem, &solution));
  EXPECT_EQ(solution.v, VecX::Ones(6));
}

// One of its joints that yields need not open: the motion that pushes the block into it is a proof once the
// load exceeds what both joints resist.
TEST(MotionProof, JointThatYieldsNeedNotOpen) {
  constexpr double kYield = 1000.0, kFriction = 0.4;  // N per point
  scenes::Scene scene(0.01, {0, 0, -scenes::kGravity});
  const int block = scene.add_box({0, 0, 0}, {1, 1, 1}, 2000.0);
  for (const double side : {-1.0, 1.0})
    scene.add_patch(scenes::kGround, block, {0.5 * side, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {-side, 0, 0},
                    {.mu = kFriction});
  ConicProblem problem = conic(scene.problem());
  ContactProblem& contacts = problem.contacts;
  const int points = contacts.num_contacts() / 2;
  contacts.strength.assign(static_cast<size_t>(2 * points), {});
  for (int i = points; i < 2 * points; ++i) contacts.strength[i].compression = kYield;
  const double resisted = 2.0 * kFriction * points * kYield;
  for (const double load : {0.99, 1.01}) {
    problem.load = VecX::Zero(6);
    problem.load[2] = -load * resisted;
    MotionProof proof(contacts, problem.load);
    EXPECT_EQ(proof.search(), load < 1.0 ? MotionProof::Answer::admissible : MotionProof::Answer::moves);
  }
}

TEST(Conic, RefusesSizesThatDoNotMatch) {
  ConicProblem problem = conic(scenes::table(1000.0, 0, 0, 0.01, {}));
  problem.cost.conservativeResize(3);
  EXPECT_THROW(solve_conic(problem), std::invalid_argument);
}

}  // namespace
}  // namespace cupola::conic_test
