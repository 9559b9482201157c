// Direct limits where the bracket of the case does not hold the critical value, or only just.
#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/statics/analysis_options.hpp"
#include "tests/solver/analysis/limit_scenes.hpp"

namespace cupola::limit_bracket_test {
namespace {

using Parameter = LimitSearch::Parameter;
using testing::limit_case;

/// A block of 2 kN that a factor on 1 kN lifts at 2, and presses down below 0.
Case lifted_block(double low, double high) {
  Case scene = limit_case(Parameter::load, low, high, 0.6);
  BlockForce lift;
  lift.block.number = 1;
  lift.force = {0, 0, 1000.0};
  scene.loads.forces = {lift};
  return scene;
}

const Assembly& block() {
  static const Assembly block = testing::box_on_floor({1.0, 1.0, 2.0 / testing::kG});
  return block;
}

TEST(LimitBracket, ALimitAboveItIsNamed) {
  const Summary summary = run_limit(lifted_block(0.0, 1.0), block(), {}).value();
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  EXPECT_NE(
      summary.message.find("stands at both ends of the bracket, 0 and 1; widen the bracket beyond about 2"),
      std::string::npos)
      << summary.message;
}

TEST(LimitBracket, NegativeFactorsHaveNoLimitBelow) {
  const Summary summary = run_limit(lifted_block(-1.0, 0.0), block(), {}).value();
  EXPECT_NE(summary.message.find("no limit: the structure stands at 0 and at every lower value"),
            std::string::npos)
      << summary.message;
}

// A frictionless floor: the critical acceleration is zero, which has no relative width.
TEST(LimitBracket, ACriticalValueOfZeroIsFound) {
  Case scene = limit_case(Parameter::acceleration, 0.0, 1.0, 0.0);
  for (const auto method : {LimitSearch::Method::direct, LimitSearch::Method::bisection}) {
    scene.analysis.limit.method = method;
    const Summary summary = run_limit(scene, block(), {}).value();
    EXPECT_EQ(summary.status, Status::stable) << summary.message;
    ASSERT_TRUE(summary.critical) << summary.message;
    EXPECT_NEAR(summary.critical->value, 0.0, 1e-8) << "of the bracket";
    EXPECT_LE(summary.accuracy.reached, summary.accuracy.asked);
    EXPECT_EQ(summary.accuracy.norm, "width of its bracket, relative to the bracket given");
  }
}

// Joints with cohesion are searched from 1e-3 up, others from 1e-5.
TEST(LimitBracket, FrictionsBelowTheLeastOfASearchAreRefused) {
  Case scene = limit_case(Parameter::friction, 0.0, 5e-4, 0.5);
  scene.loads.gravity = testing::tilted_gravity(0.3);
  EXPECT_EQ(run_limit(scene, block(), {})->status, Status::unconverged) << "the case has a friction of 0.5";
  scene.joints.compliance.per = Compliance::Per::area;
  scene.joints.strength = {.tension = 100.0, .cohesion = 1000.0};
  EXPECT_THROW(run_limit(scene, block(), {}), InputError);
}

// A block of weight W on its unit face crushes its joint, of extent x, at a strength of W / x^2. Below that no
// pull holds it either, and the solves stall. The tolerance is the width of the bracket, wherever it begins.
TEST(LimitBracket, BeginsWhereJointsOfSmallExtentCrush) {
  const double weight = free_weight(block(), testing::kG);
  for (const double exact : {0.1, 0.5, 0.9}) {
    for (const double low : {0.001, 0.01, 0.05}) {
      Case scene = limit_case(Parameter::joint_extent, low, 1.0, 0.7);
      scene.joints.compliance.per = Compliance::Per::area;
      scene.joints.strength.compression = weight / (exact * exact);
      const Summary summary = run_limit(scene, block(), {}).value();
      EXPECT_EQ(summary.status, Status::stable) << summary.message;
      ASSERT_TRUE(summary.critical) << summary.message;
      EXPECT_NEAR(summary.critical->value, exact, 1e-4 * exact) << "from " << low;
    }
  }
}

}  // namespace
}  // namespace cupola::limit_bracket_test
