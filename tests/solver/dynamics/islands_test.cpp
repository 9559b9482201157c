#include "solver/dynamics/islands.hpp"

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/solver/accounted_simulation.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::islands_test {
namespace {

using testing::BoxSpec;

/// A floor with `number` stacks of two cubes, 3 m apart; optionally a cube dropped from 1 m onto the first
/// stack.
Assembly stacks(int number, bool dropped) {
  std::vector<BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {200, 3, 1}, .fixed = true}};
  for (int k = 0; k < number; ++k)
    for (int level = 0; level < 2; ++level) boxes.push_back({.center = {3.0 * k, 0, level + 0.5}});
  if (dropped) boxes.push_back({.center = {0, 0, 3.5}});
  return testing::make_boxes(boxes);
}

Case sleeping_case(double duration) {
  Case scene = testing::make_case(0.4, 1e-9, 0.01);
  scene.analysis.tolerance = 1e-9;
  scene.analysis.duration = duration;
  scene.analysis.start = Analysis::Start::rest;
  scene.analysis.damping = 0.01;
  scene.analysis.sleep = Sleep{.speed = 1e-3, .time = 0.05};
  return scene;
}

TEST(Islands, AreFreeBlocksConnectedByContacts) {
  const Assembly assembly = stacks(3, false);
  const Case scene = sleeping_case(1.0);
  const Model model = make_model(scene, assembly);
  ContactDetector detector(assembly, detection_options(scene));
  const std::vector<int> islands = islands_of(model, detector.update(state_at_rest(model).poses));
  EXPECT_EQ(islands, (std::vector<int>{0, 0, 2, 2, 4, 4}));
}

TEST(Islands, FallAsleepAtRestAndKeepTheirForces) {
  const Assembly assembly = stacks(3, false);
  testing::AccountedSimulation run(sleeping_case(1.0), assembly);
  StepReport report;
  for (int k = 0; k < 100; ++k) report = run.advance();
  EXPECT_EQ(report.num_asleep, 6);
  EXPECT_EQ(report.problem.problem.num_blocks(), 0);
  EXPECT_EQ(report.problem.problem.num_contacts(), 0);
  const double weight = run.model().free_weight;
  // They fell asleep at speeds below 1e-3 m/s, so the relative imbalance is below 1e-3 / (g h).
  EXPECT_NEAR(report.balance.support_reaction.z() / weight, 1.0, 1e-3 / (9.81 * 0.01));
}

TEST(Islands, WakeWhenABlockArrives) {
  const Assembly assembly = stacks(3, true);
  Case scene = sleeping_case(1.0);
  testing::AccountedSimulation run(scene, assembly);
  bool first_slept = false, first_woke = false;
  for (int k = 0; k < 200; ++k) {
    const int asleep = run.advance().num_asleep;
    if (run.state().time < 0.4) first_slept = first_slept || asleep == 6;
    if (first_slept) first_woke = first_woke || asleep == 4;
  }
  EXPECT_TRUE(first_slept);
  EXPECT_TRUE(first_woke);
  // The dropped cube rests on the first stack, whose blocks stayed in place.
  EXPECT_NEAR(run.state().poses.back().p_WB.z(), 2.5, 1e-2);
}

TEST(Islands, SleepingOnesDoNotChangeTheMotionOfOthers) {
  const Assembly assembly = stacks(4, true);
  Case scene = sleeping_case(1.0);
  testing::AccountedSimulation with(scene, assembly);
  scene.analysis.sleep.reset();
  testing::AccountedSimulation without(scene, assembly);
  for (int k = 0; k < 40; ++k) {
    with.advance();
    without.advance();
  }
  const Pose &p = with.state().poses.back(), &q = without.state().poses.back();
  EXPECT_NEAR((p.p_WB - q.p_WB).norm(), 0.0, 1e-9);
}

TEST(Islands, ContinueWithTheSameBitsAfterRestoring) {
  const Assembly assembly = stacks(2, true);
  testing::AccountedSimulation run(sleeping_case(1.0), assembly);
  for (int k = 0; k < 30; ++k) run.advance();
  run.forget_factor();
  testing::AccountedSimulation again(sleeping_case(1.0), assembly);
  again.restore(run.save());
  for (int k = 0; k < 60; ++k) {
    EXPECT_EQ(run.advance().num_asleep, again.advance().num_asleep);
  }
  EXPECT_EQ(run.state().v, again.state().v);
}

TEST(Islands, CannotSleepIfFrictionVariesInTime) {
  const Assembly assembly = stacks(1, false);
  Case scene = sleeping_case(0.1);
  scene.joints.friction_time = RampInTime{};
  EXPECT_THROW(run_dynamic(scene, assembly, {}), InputError);
}

}  // namespace
}  // namespace cupola::islands_test
