// What the ending of a motion says of the structure.
#include <fstream>

#include <gtest/gtest.h>

#include "assembly/model/ending.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::motion_ending_test {
namespace {

/// A block on a slope that is steeper than its friction, from rest or from the equilibrium that it lacks.
Summary slide(Analysis::Start start) {
  Case scene = testing::make_case(0.2, 1e-8, 0.01);
  scene.loads.gravity = testing::tilted_gravity(0.3);
  scene.analysis.duration = 0.02;
  scene.analysis.start = start;
  return run_dynamic(scene, testing::box_on_floor({1.0, 1.0, 0.5}), {}).value();
}

TEST(MotionEnding, WithoutAStaticStartItFalls) {
  const Summary summary = slide(Analysis::Start::static_);
  EXPECT_NE(summary.message.find("static start failed"), std::string::npos) << summary.message;
  EXPECT_TRUE(falls(summary));
  EXPECT_EQ(words_of(summary), "it falls");
}

TEST(MotionEnding, BelowTheThresholdOfCollapseItHasNotComeToRest) {
  const Summary summary = slide(Analysis::Start::rest);
  EXPECT_EQ(summary.status, Status::moving) << summary.message;
  EXPECT_FALSE(falls(summary));
  EXPECT_EQ(words_of(summary), "it has not come to rest");
}

/// A block of friction 0.2 that a force of twice its friction pushes from 0.5 s on, in a motion of 1 s that
/// stops when settled.
Summary pushed_late(const TimeFunction& time) {
  Case scene = testing::make_case(0.2, 0.0, 0.01);
  scene.analysis.tolerance = 1e-9;
  scene.analysis.duration = 1.0;
  scene.analysis.stop.settled_time = 0.2;
  const double weight = 1000.0 * testing::kG;
  scene.loads.forces.push_back({BlockRef{1}, {}, {0.4 * weight, 0, 0}, time});
  return run_dynamic(scene, testing::box_on_floor({1.0, 1.0, 1.0}), {}).value();
}

// A window that is as long as the run is covered, although the run is a sum of rounded steps.
TEST(MotionEnding, ShorterThanTheWindowOfRestItHasNotComeToRest) {
  Case scene = testing::make_case(0.2, 1e-8, 0.01);
  scene.analysis.start = Analysis::Start::static_;
  scene.analysis.duration = 0.1;
  for (const double window : {0.2, 0.1}) {
    scene.analysis.thresholds.window = window;
    const Summary summary = run_dynamic(scene, testing::box_on_floor({1.0, 1.0, 0.5}), {}).value();
    EXPECT_EQ(summary.status, window == 0.1 ? Status::stable : Status::moving) << summary.message;
    EXPECT_EQ(summary.message.find("the motion is shorter than") == 0, window == 0.2) << summary.message;
  }
}

TEST(MotionEnding, IsNotSettledBeforeLoadsAndSupportsHaveTheirLastValues) {
  const TableInTime push{"", {0.5, 0.51}, {0.0, 1.0}}, passes{"", {0.5, 0.51, 0.52}, {0.0, 0.1, 0.0}};
  const Summary slides = pushed_late(push);
  EXPECT_EQ(slides.message.find("settled"), std::string::npos) << slides.message;
  EXPECT_GT(slides.max_displacement_m.value(), 0.1) << "mu g (0.5 s)^2 / 2 = 0.25 m";
  const Summary rests = pushed_late(passes);
  EXPECT_NE(rests.message.find("settled"), std::string::npos) << rests.message;
  EXPECT_EQ(rests.steps, 72) << "0.2 s after the last value";
}

TEST(MotionEnding, IsNotSettledBeforeTheGroundHasMoved) {
  const std::string path = ::testing::TempDir() + "/quiet.csv";
  std::ofstream(path) << "0, 0\n0.5, 0\n0.51, 6\n0.8, 6\n";
  Case scene = testing::make_case(0.2, 0.0, 0.01);
  scene.analysis.tolerance = 1e-9;
  scene.analysis.duration = 1.0;
  scene.analysis.stop.settled_time = 0.2;
  scene.supports.base_motion = BaseMotion{path, BaseMotion::Quantity::acceleration, Vec3::UnitX()};
  const Summary summary = run_dynamic(scene, testing::box_on_floor({1.0, 1.0, 1.0}), {}).value();
  EXPECT_GT(summary.max_displacement_m.value(), 0.1) << "(6 - mu g) (0.3 s)^2 / 2 = 0.18 m";
}

}  // namespace
}  // namespace cupola::motion_ending_test
