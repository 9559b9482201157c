// The verdict of a motion that comes back: the largest displacement of all steps decides.

#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/analysis/analysis.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::motion_verdict_test {
namespace {

constexpr double kFriction = 0.1, kJerk = 0.2, kDuration = 0.1;  // -, m, s

/// The ground jerks by 0.2 m in x within 0.1 s and back after half a second; the block slides on it. Within
/// the jerk friction carries it along by mu g t2 / 2 = 4.9 mm, so that it is 195.1 mm behind; after the way
/// back it lies where it started.
Case jerked_block(double threshold) {
  const std::string path = ::testing::TempDir() + "/jerk.csv";
  std::ofstream(path) << "0, 0\n0.1, 0.2\n0.5, 0.2\n0.6, 0\n";
  Case scene = testing::make_case(kFriction, 1e-9, 0.002);
  scene.analysis.tolerance = 1e-9;
  scene.analysis.duration = 1.5;
  scene.analysis.start = Analysis::Start::static_;
  scene.analysis.thresholds.displacement = threshold;
  scene.supports.base_motion = BaseMotion{path, BaseMotion::Quantity::displacement, Vec3::UnitX()};
  return scene;
}

constexpr double kFarthest = kJerk - 0.5 * kFriction * testing::kG * kDuration * kDuration;  // m
// In n steps of h friction carries the block by mu g h2 n (n + 1) / 2, 0.1 mm too far in each of three phases.
constexpr double kOfSteps = 3e-4;  // m

Summary summary_of(const Case& scene, const AnalysisSinks& sinks = {}) {
  return run_dynamic(scene, testing::box_on_floor({1, 1, 1}), sinks).value();
}

void expect_the_way_back(const Summary& summary) {
  EXPECT_NEAR(summary.max_displacement_m.value(), kFarthest, kOfSteps);
  EXPECT_NEAR(summary.max_displacement_time_s.value(), kDuration, 0.002);
  EXPECT_LT(summary.final_displacement_m.value(), kOfSteps);
  EXPECT_TRUE(summary.rest_at_end.value());
}

TEST(MotionThatComesBack, StandsIfItWasNeverBeyondTheThreshold) {
  const Summary summary = summary_of(jerked_block(0.3));
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  expect_the_way_back(summary);
}

// One motion has one verdict, whether it is followed to its end or not.
TEST(MotionThatComesBack, HasCollapsedIfItWasBeyondTheThreshold) {
  Case scene = jerked_block(0.1);
  const Summary summary = summary_of(scene);
  EXPECT_EQ(summary.status, Status::collapsed) << summary.message;
  expect_the_way_back(summary);
  EXPECT_NE(summary.message.find("at rest: a threshold above 0.19"), std::string::npos) << summary.message;

  scene.analysis.stop.collapsed = true;
  const Summary stopped = summary_of(scene);
  EXPECT_EQ(stopped.status, Status::collapsed) << stopped.message;
  EXPECT_LT(stopped.max_displacement_time_s.value(), kDuration);
  EXPECT_EQ(stopped.max_displacement_m, stopped.final_displacement_m);
  EXPECT_FALSE(stopped.rest_at_end.value());
}

// The block is farthest at 0.1 s; the run is interrupted and resumed after that.
TEST(MotionThatComesBack, IsJudgedAlikeAfterAnInterruption) {
  Case scene = jerked_block(0.1);
  scene.output.frames_every = 0.25;
  std::string checkpoint;
  AnalysisSinks sinks;
  double time = 0.0;
  sinks.frame = [&](const Frame& frame) { time = frame.time; };
  sinks.checkpoint = [&](const std::string& bytes) { checkpoint = bytes; };
  sinks.interrupted = [&] { return time > 0.4; };
  ASSERT_FALSE(run_dynamic(scene, testing::box_on_floor({1, 1, 1}), sinks));
  AnalysisSinks rest;
  rest.resume_from = checkpoint;
  const Summary summary = summary_of(scene, rest);
  EXPECT_EQ(summary.status, Status::collapsed) << summary.message;
  expect_the_way_back(summary);
}

// A couple about the vertical turns a cube on its base, whose centroid stays: corners are sqrt(1/2) m away.
TEST(MotionThatTurns, IsJudgedByTheFastestPointOfItsBlock) {
  Case scene = testing::make_case(0.05, 1e-9, 0.01);
  scene.analysis.tolerance = 1e-9;
  scene.analysis.duration = 0.5;
  scene.analysis.start = Analysis::Start::rest;
  scene.loads.forces.push_back({BlockRef{1}, {}, Vec3::Zero(), {}, Vec3(0, 0, 1500)});
  EXPECT_EQ(summary_of(scene).status, Status::collapsed) << "corners move by more than half a metre";
  scene.analysis.thresholds.displacement = 2.0;
  Frame last;
  std::string row;
  AnalysisSinks sinks;
  sinks.frame = [&last](const Frame& frame) { last = frame; };
  sinks.history = [&row](const std::string& text) { row = text; };
  const Summary summary = summary_of(scene, sinks);
  EXPECT_EQ(summary.status, Status::moving) << summary.message;
  EXPECT_FALSE(summary.rest_at_end.value());

  const double radius = std::sqrt(0.5), angle = 2.0 * std::acos(last.blocks.quaternion_wxyz[1][0]);
  EXPECT_GT(angle, 0.5);
  const double speed = radius * last.blocks.angular_velocity[1].z();
  // The block also settles and slides aside, by a millimetre.
  EXPECT_NEAR(summary.max_speed_m_per_s.value(), speed, 1e-3 * speed);
  EXPECT_NEAR(summary.max_displacement_m.value(), 2.0 * radius * std::sin(0.5 * angle), 0.01 * radius)
      << "of a corner";
  EXPECT_NE(row.find(fmt::format("{:.17g}", *summary.max_speed_m_per_s)), std::string::npos) << row;
}

// Ten times the threshold.
TEST(MotionOfSupports, IsNoFallOfWhatFollowsIt) {
  Case scene = testing::make_case(0.5, 1e-9, 0.01);
  scene.analysis.tolerance = 1e-9;
  scene.analysis.duration = 2.5;
  scene.analysis.thresholds.displacement = 0.05;
  SupportMove lift{.region = {}, .displacement = {0.2, 0, 0.5}, .time = {}};
  lift.time = RampInTime{.from = 0.0, .to = 1.0, .start = 0.0, .duration = 2.0};
  scene.supports.moves = {lift};
  const Summary summary = summary_of(scene);
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  EXPECT_LT(summary.max_displacement_m.value(), 0.01) << "a step of the ramp at 0.27 m/s, by which it lags";
}

// A block of 1 x 2 m whose centroid is above an edge of its base.
TEST(MotionFromRest, WarnsOfAnUnstableBalance) {
  const double lean = std::atan(0.5);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(lean, Vec3::UnitY()));
  const Assembly assembly =
      testing::make_boxes({{.center = {0, 0, -0.5}, .size = {5, 5, 1}, .fixed = true},
                           {.center = {0, 0, 0.5 * std::sqrt(5.0)}, .size = {1, 1, 2}, .rotation = turn}});
  Case scene = testing::make_case(0.8, 1e-9, 0.01);
  scene.analysis.tolerance = 1e-9;
  scene.analysis.duration = 0.2;
  scene.analysis.start = Analysis::Start::static_;
  const Summary summary = run_dynamic(scene, assembly, {}).value();
  ASSERT_EQ(summary.warnings.size(), 1U);
  EXPECT_EQ(summary.warnings[0].find("unstable balance at the start"), 0U) << summary.warnings[0];
  EXPECT_TRUE(summary_of(scene).warnings.empty()) << "a cube on its face";
}

}  // namespace
}  // namespace cupola::motion_verdict_test
