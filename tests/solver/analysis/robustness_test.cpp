// The least horizontal acceleration over several directions, against closed forms and limit analyses.
#include <cmath>
#include <numbers>
#include <regex>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/analysis/analysis.hpp"
#include "solver/analysis/statics/limit_search.hpp"
#include "tests/solver/analysis/limit_scenes.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::robustness_test {
namespace {

using Parameter = LimitSearch::Parameter;
using testing::limit_case;

Summary pushed(double friction, const Assembly& assembly, int directions) {
  Case scene = testing::make_case(friction, 1e-8, 0.01);
  scene.analysis.type = AnalysisType::static_;
  scene.analysis.robustness = directions;
  return run_static(scene, assembly, {});
}

// A brick tips about the edge of its base: half width over half height, here about the y axis first. Friction
// would let it slide at 0.7.
TEST(Robustness, BrickTipsAboutItsLongEdge) {
  const Summary summary = pushed(0.7, testing::box_on_floor({0.2, 0.5, 0.8}), 8);
  ASSERT_TRUE(summary.robustness) << summary.message;
  EXPECT_NEAR(summary.robustness->acceleration_g, 0.25, 1e-6);
  EXPECT_NEAR(summary.robustness->moving_g, 0.25, 1e-6);
  EXPECT_EQ(summary.robustness->azimuth_deg, 0.0);
  EXPECT_EQ(summary.robustness->directions, 8);
}

// Without friction any push moves a box; the bounds of its limit are rounding. With a little it bears so much.
TEST(Robustness, WhatSlidesAtAnyPushBearsNone) {
  const Assembly box = testing::box_on_floor({1.0, 1.0, 1.0});
  const Summary free = pushed(0.0, box, 8);
  ASSERT_TRUE(free.robustness) << free.message;
  EXPECT_EQ(free.robustness->acceleration_g, 0.0);
  EXPECT_EQ(free.robustness->moving_g, kZeroLimit);
  EXPECT_NE(free.message.find("; any horizontal acceleration towards 0 degrees makes it move"),
            std::string::npos)
      << free.message;
  const Summary rough = pushed(1e-6, box, 8);
  ASSERT_TRUE(rough.robustness) << rough.message;
  EXPECT_NEAR(rough.robustness->moving_g, 1e-6, 1e-10) << "relative width 1e-4 of the bounds";
}

// A box in a tight pit cannot be pushed over or out.
TEST(Robustness, WhatIsWedgedHasNoLimit) {
  std::vector<testing::BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {10, 10, 1}, .fixed = true},
                                      {.center = {0, 0, 0.5}, .size = {1, 1, 1}}};
  for (const double x : {-1.0, 1.0}) {
    boxes.push_back({.center = {x, 0, 0.5}, .size = {1, 1, 1}, .fixed = true});
    boxes.push_back({.center = {0, x, 0.5}, .size = {1, 1, 1}, .fixed = true});
  }
  const Summary summary = pushed(0.5, testing::make_boxes(boxes), 4);
  EXPECT_EQ(summary.status, Status::stable);
  EXPECT_FALSE(summary.robustness);
  EXPECT_NE(summary.message.find("; no horizontal acceleration in 4 directions makes it move"),
            std::string::npos)
      << summary.message;
}

// Beside mortar of 1 TPa the weights are rounding, which leaves directions undecided: how many depends on the
// machine.
TEST(Robustness, UndecidedDirectionsAreAWarning) {
  Case scene = testing::make_case(0.5, 1e-10, 0.01);
  scene.joints.compliance.per = Compliance::Per::area;
  scene.joints.strength.cohesion = 1e12;
  scene.analysis.type = AnalysisType::static_;
  scene.analysis.robustness = 8;
  const Summary summary = run_static(scene, testing::box_on_floor({1.0, 0.5, 1.0}), {});
  const int undecided = 8 - (summary.robustness ? summary.robustness->directions : 0);
  ASSERT_GT(undecided, 0) << summary.message;
  ASSERT_EQ(summary.warnings.size(), 1u) << summary.message;
  EXPECT_TRUE(summary.warnings[0].starts_with(
      fmt::format("analysis.robustness: {} of 8 directions are undecided, the first towards ", undecided)))
      << summary.warnings[0];
}

// A dome in mortar, which the programmes solve to bounds that differ by rounding only if the mechanism is
// improved. Below a friction of a thousandth cohesion leaves nothing to solve.
TEST(Robustness, DomesInMortarHaveALimit) {
  const Assembly dome = testing::make_sphere(2.0, 0.25, std::numbers::pi / 28.0, 12, 24);
  Case scene = testing::course_case(0.0, 0.3);
  scene.joints.friction = 0.6;
  scene.joints.strength = {.tension = 5e4, .cohesion = 1e5};
  scene.analysis.type = AnalysisType::static_;
  scene.analysis.friction_law = FrictionLaw::associated;
  scene.analysis.robustness = 1;
  const Summary shaken = run_static(scene, dome, {});
  ASSERT_TRUE(shaken.robustness) << shaken.message;
  EXPECT_NEAR(shaken.robustness->moving_g / shaken.robustness->acceleration_g, 1.0, 1e-4);

  scene.analysis.type = AnalysisType::limit;
  scene.analysis.limit.parameter = Parameter::friction;
  scene.analysis.limit.low = 0.0;
  scene.analysis.limit.high = 1.0;
  const Summary slides = run_limit(scene, dome, {}).value();
  EXPECT_EQ(slides.status, Status::stable);
  // From 0.001 or, where rounding prevents that solve, twice or more of it. More friction leaves mortar less
  // tension, so that the ends say nothing of the values between them.
  EXPECT_TRUE(std::regex_match(
      slides.message,
      std::regex(
          "friction: the structure stands at both ends of the bracket, 0\\.00\\d and 1; widen the bracket")))
      << slides.message;
}

// A square tower of bricks turned by its place has four equal sectors: two of eight directions represent all,
// and have the limits that analyses of one direction find.
TEST(Robustness, EqualSectorsHaveEqualLimits) {
  std::vector<testing::BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {10, 10, 1}, .fixed = true}};
  for (const double x : {-1.0, 1.0}) {
    boxes.push_back({.center = {x, 0, 0.5}, .size = {0.4, 0.6, 1.0}});
    boxes.push_back({.center = {0, x, 0.5}, .size = {0.6, 0.4, 1.0}});
  }
  const Assembly assembly = testing::make_boxes(boxes);
  const Summary summary = pushed(0.7, assembly, 8);
  ASSERT_TRUE(summary.robustness) << summary.message;
  EXPECT_NEAR(summary.robustness->moving_g, 0.4, 1e-6) << "over its shorter side";
  EXPECT_EQ(summary.robustness->azimuth_deg, 0.0);
  for (const double azimuth : {0.0, 90.0, 180.0, 270.0}) {
    Case push = limit_case(Parameter::acceleration, 0.0, 2.0, 0.7);
    const double a = azimuth * std::numbers::pi / 180.0;
    push.analysis.limit.direction = {std::cos(a), std::sin(a), 0.0};
    const Summary limit = run_limit(push, assembly, {}).value();
    ASSERT_TRUE(limit.critical) << limit.message;
    EXPECT_NEAR(limit.critical->value, summary.robustness->moving_g, 1e-6) << azimuth;
  }
}

}  // namespace
}  // namespace cupola::robustness_test
