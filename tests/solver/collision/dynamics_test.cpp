#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/solver/accounted_simulation.hpp"
#include "tests/solver/motion_scenes.hpp"
#include "tests/solver/scenes.hpp"
#include "tests/test_names.hpp"

namespace cupola::dynamics_test {
namespace {

using namespace testing;  // the scenes
using Eigen::AngleAxisd;
using Eigen::Quaterniond;

// Rocking block of half-width b and half-height H, released at rest at half its slenderness alpha. Housner
// (1963), between impacts:
//
//     theta'' = -p^2 sin(alpha - theta),   p^2 = 3 g / (4 R),   R^2 = b^2 + H^2,   tan alpha = b / H
//
// The reference values come from numerical integration of that equation.
struct Rocking {
  double b, H;             ///< m
  double quarter_period;   ///< s
  double omega_at_impact;  ///< rad/s
  double impact_ratio;     ///< 1 - 3/2 sin^2 alpha: speed after over speed before the impact
};

class RockingBlock : public ::testing::TestWithParam<Rocking> {};

TEST_P(RockingBlock, FollowsHousnersEquationAndImpactRatio) {
  const auto& [b, H, quarter_period, omega_at_impact, impact_ratio] = GetParam();
  const double h = 1e-3;
  const Assembly assembly = box_on_floor({2 * b, 1.0, 2 * H});
  Case scene = make_case(0.8, 1e-12, h);  // sqrt(m c) = 3e-5 s: rigid
  scene.analysis.tolerance = 1e-10;
  testing::AccountedSimulation simulation(scene, assembly);
  Pose& pose = simulation.mutable_state()->poses[1];
  const Vec3 hinge(b, 0, 0);
  pose.q_WB = AngleAxisd(0.5 * std::atan(b / H), Vec3::UnitY());
  pose.p_WB = hinge + pose.q_WB * (pose.p_WB - hinge);

  std::vector<double> angle, omega;
  for (int step = 0; step * h < 1.1 * quarter_period; ++step) {
    simulation.advance();
    const Quaterniond& q = simulation.state().poses[1].q_WB;
    angle.push_back(2.0 * std::atan2(q.y(), q.w()));
    omega.push_back(simulation.state().v[4]);
  }
  std::size_t hit = 0;
  while (hit < angle.size() && angle[hit] > 0.0) ++hit;
  ASSERT_LT(hit + 2, angle.size());
  const double time = h * (static_cast<double>(hit) + angle[hit - 1] / (angle[hit - 1] - angle[hit]));
  EXPECT_NEAR(time / quarter_period, 1.0, 0.01);  // first-order scheme: error O(h p), p = 2.7 1/s
  EXPECT_NEAR(-omega[hit - 1] / omega_at_impact, 1.0, 0.01);
  EXPECT_NEAR(omega[hit + 1] / omega[hit - 1] / impact_ratio, 1.0, 0.02);  // 1 ms before and 1 ms after
}

INSTANTIATE_TEST_SUITE_P(Housner, RockingBlock,
                         ::testing::Values(Rocking{0.2, 1.0, 0.490864, 0.458240, 0.942308},
                                           Rocking{0.5, 1.0, 0.516630, 1.018535, 0.700000}),
                         test_names({"Slender", "Stout"}));

/// Uniformly distributed random orientation.
Quaterniond random_turn(std::mt19937* random) {
  std::normal_distribution<double> normal;
  return Quaterniond(normal(*random), normal(*random), normal(*random), normal(*random)).normalized();
}

/// Drops block 1 of the scene in `count` random orientations. It must come to rest on one of its faces, and
/// the energy must never rise.
void drop(const Assembly& assembly, int count, unsigned seed) {
  std::mt19937 random(seed);
  const double h = 0.01;
  for (int trial = 0; trial < count; ++trial) {
    Case scene = make_case(0.5, 1e-10, h);  // sinks by about 1e-6 m under its weight
    scene.analysis.tolerance = 1e-8;
    testing::AccountedSimulation simulation(scene, assembly);
    simulation.mutable_state()->poses[1].q_WB = random_turn(&random);
    double energy = simulation.energy().total();
    double rise = 0.0;
    for (int step = 0; step * h < 8.0; ++step) {
      const StepReport report = simulation.advance();
      EXPECT_EQ(report.solve.ending, SolveEnding::converged) << report.solve.message << ", trial " << trial;
      const double next = simulation.energy().total();
      rise = std::max(rise, next - energy);
      energy = next;
    }
    // The solver leaves an error of 1e-8 of the impulse h g m in each step, at speeds up to 10 m/s: weight
    // times 1e-9 m, or a few times that when several contacts close at once.
    EXPECT_LT(rise, 1e-8 * assembly.blocks[1].mass * kG) << "J, trial " << trial;
    EXPECT_LT(simulation.state().v.norm(), 1e-6) << "trial " << trial;
    const Mat3 turn = simulation.state().poses[1].q_WB.toRotationMatrix();
    EXPECT_NEAR(turn.row(2).cwiseAbs().maxCoeff(), 1.0, 1e-6) << "not on a face, trial " << trial;
  }
}

/// A box above the floor (lower_box = 0), or above another box of that size on the floor. It can tumble off a
/// small one.
Assembly box_in_the_air(double lower_box) {
  std::vector<BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {40, 40, 1}, .fixed = true},
                             {.center = {0, 0, lower_box > 0.0 ? 2.5 : 1.5}, .size = {1, 1.2, 0.8}}};
  if (lower_box > 0.0) boxes.push_back({.center = {0, 0, 0.5}, .size = {lower_box, lower_box, 1}});
  return make_boxes(boxes);
}

TEST(DroppedBox, ComesToRestOnAFace) {
  drop(box_in_the_air(0.0), 10, 1);
  drop(box_in_the_air(3.0), 10, 2);
  drop(box_in_the_air(1.5), 10, 3);
}

// In one step from rest, g h^2 = 25 mm, a tile would pass through a gap of 5 mm and its own thickness.
TEST(DroppedBox, IsSeenBeforeItsFirstStepLeadsThroughTheFloor) {
  const double gap = 5e-3, thickness = 0.015;
  const Assembly assembly = box_on_floor({1.0, 1.0, thickness});
  testing::AccountedSimulation simulation(make_case(0.5, 0.0, 0.05), assembly);
  simulation.mutable_state()->poses[1].p_WB.z() += gap;
  for (int step = 0; step < 10; ++step) simulation.advance();
  EXPECT_NEAR(simulation.state().poses[1].p_WB.z(), 0.5 * thickness, 1e-9) << "rounding";
}

// The same of a couple that would turn an edge of a plate by 0.1 m in the first step.
TEST(DroppedBox, IsSeenBeforeItsFirstStepTurnsItIntoTheFloor) {
  const double h = 0.05, gap = 5e-3;
  const Assembly assembly = box_on_floor({1.0, 1.0, 0.1});
  Case scene = make_case(0.0, 0.0, h);
  scene.loads.gravity.setZero();
  BlockForce turn;
  turn.block = BlockRef{1};
  turn.moment = Vec3(0, 0.1 / (0.5 * h * h) * assembly.blocks[1].inertia(1, 1), 0);
  scene.loads.forces.push_back(turn);
  testing::AccountedSimulation simulation(scene, assembly);
  simulation.mutable_state()->poses[1].p_WB.z() += gap;
  simulation.advance();
  const Pose& pose = simulation.state().poses[1];
  // The contact point moves along the floor while the plate turns by up to 0.2, to the second order.
  EXPECT_GT((pose.p_WB + pose.q_WB * Vec3(0.5, 0, -0.05)).z(), -0.01);
}

TEST(DroppedBoxSlow, ThousandOnAPlane) {
  drop(box_in_the_air(0.0), 1000, 4);
}
TEST(DroppedBoxSlow, ThousandOnABox) {
  drop(box_in_the_air(3.0), 1000, 5);
}
TEST(DroppedBoxSlow, ThousandTumblingOffABox) {
  drop(box_in_the_air(1.5), 1000, 6);
}

}  // namespace
}  // namespace cupola::dynamics_test
