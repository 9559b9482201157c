// Frames of a range analysis: which one is evaluated, under which loads, and the thrust lines at the ends.

#include <gtest/gtest.h>

#include "postproc/report/report.hpp"
#include "postproc/tables/post_summary.hpp"
#include "tests/postproc/ranges.hpp"

namespace cupola::range_evaluation_test {
namespace {

/// The column as an arch, which has a thrust line.
Assembly column_as_arch() {
  Assembly a = test::column(3);
  a.sheets.front().thrust_lines = Sheet::ThrustLines::one;
  return a;
}

TEST(RangeEvaluation, EvaluatesFrameZeroAndTheThrustLinesOfBothEnds) {
  const Assembly a = column_as_arch();
  const std::string folder = test::fresh_folder("results");
  const Evaluation e =
      test::evaluated(a, test::range_frames(a), test::range_summary(a), test::column_case(), folder);
  EXPECT_TRUE(at_rest(e));
  EXPECT_EQ(e.last.frame.time, 0.0);
  EXPECT_FALSE(is_mechanism(ResultsReader(folder, content_hash(a)).read_frame(2).role));
  EXPECT_TRUE(e.warnings.empty());
  ASSERT_EQ(e.meridians.size(), 1u);
  const MeridianEvaluation& m = e.meridians[0];
  ASSERT_TRUE(m.least_thrust && m.greatest_thrust);
  // Frame i has its resultants at y = 0.4 + 0.05 i of a thickness of 0.8 m.
  for (size_t bed = 0; bed < 3; ++bed) {
    EXPECT_NEAR(m.thrust.points[bed].position, 0.5, 1e-12);
    EXPECT_NEAR(m.least_thrust->points[bed].position, 0.45 / 0.8, 1e-12);
    EXPECT_NEAR(m.greatest_thrust->points[bed].position, 0.5 / 0.8, 1e-12);
  }
}

TEST(RangeEvaluation, OnlyBoundedEndsWithAFrameHaveAThrustLine) {
  const Assembly a = column_as_arch();
  Summary summary = test::range_summary(a);
  summary.ranges[0].min.outcome = RangeOutcome::unbounded;
  summary.ranges[0].max.frame.reset();
  const Evaluation e =
      test::evaluated(a, test::range_frames(a), summary, test::column_case(), test::fresh_folder("results"));
  EXPECT_FALSE(e.meridians[0].least_thrust);
  EXPECT_FALSE(e.meridians[0].greatest_thrust);
}

// The time of a frame is its number: the loads must not follow their time function there. The frame of an
// unbounded end shows a self-stress, on which no load acts.
TEST(RangeEvaluation, AllStatesBearTheSameLoadsAndSelfStressesNone) {
  const Assembly a = column_as_arch();
  Case scene = test::column_case();
  scene.loads.dead_load_time = RampInTime{0.5, 1.0, 0.0, 4.0};
  const std::string folder = test::fresh_folder("results");
  const Evaluation e = test::evaluated(a, test::range_frames(a), test::range_summary(a), scene, folder);
  const ResultsReader results(folder, content_hash(a));
  ASSERT_GT(e.last.gravity.norm(), 0.0);
  EXPECT_EQ(evaluate_frame(e, results.read_frame(2)).gravity, e.last.gravity);
  EXPECT_EQ(evaluate_frame(e, results.read_frame(4)).gravity, Vec3(0, 0, 0)) << "shows the unbounded end";
}

TEST(RangeEvaluation, WithoutAnAdmissibleStateFrameZeroIsAMechanism) {
  const Assembly a = column_as_arch();
  const auto [summary, frame] = test::moving_range_run(a);
  const Evaluation e =
      test::evaluated(a, {frame}, summary, test::column_case(), test::fresh_folder("results"));
  EXPECT_FALSE(at_rest(e));
  EXPECT_TRUE(is_mechanism(e.last.frame.role));
  EXPECT_GT(e.last.frame.blocks.displacement[3].x(), 0.0);
  EXPECT_FALSE(post_summary(e).thrust_over_weight);
  EXPECT_EQ(verdict_text(summary, e.last.frame.role),
            "The structure moves: no forces balance the loads within the joint laws.");
  ASSERT_EQ(e.warnings.size(), 1u);
  EXPECT_NE(e.warnings[0].find("no admissible state"), std::string::npos);
}

// A range whose search did not converge leaves the state of frame 0 in equilibrium.
TEST(RangeEvaluation, AnIncompleteRangeStillHasAnEquilibrium) {
  const Assembly a = column_as_arch();
  Summary summary = test::range_summary(a);
  summary.status = Status::unconverged;
  const Evaluation e =
      test::evaluated(a, test::range_frames(a), summary, test::column_case(), test::fresh_folder("results"));
  EXPECT_TRUE(at_rest(e));
  ASSERT_EQ(e.warnings.size(), 1u);
  EXPECT_NE(e.warnings[0].find("not all ends of the ranges"), std::string::npos);
  EXPECT_NE(verdict_text(summary, e.last.frame.role).find("but not all ends of the ranges"),
            std::string::npos);
}

}  // namespace
}  // namespace cupola::range_evaluation_test
