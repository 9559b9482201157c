// What the ending of a motion says of the structure.
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

}  // namespace
}  // namespace cupola::motion_ending_test
