// Ranges of ratios, of which the denominator may vanish or be negative.

#include <gtest/gtest.h>

#include "solver/analysis/admissible/rigid_scene.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::ratio_range_test {
namespace {

const JointForce kEccentricity{0, 1, JointForce::Component::eccentricity, Vec3::UnitX()};

Case range_case(std::vector<ForceQuantity> quantities) {
  Case scene = testing::make_case(0.5, 1e-8, 0.01);
  scene.geometry.surface = WallSurface{};
  scene.analysis.type = AnalysisType::range;
  scene.analysis.tolerance = 1e-9;
  scene.analysis.range.quantities = std::move(quantities);
  return scene;
}

TEST(RatioRange, RatiosToNothingAreUndefined) {
  Case scene = range_case({JointForce{0, 1, JointForce::Component::normal, Vec3::UnitX()}, kEccentricity});
  scene.loads.gravity.setZero();
  const Summary summary = run_range(scene, testing::box_on_floor({1, 1, 1}), {}).value();
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  ASSERT_EQ(summary.ranges.size(), 2u);
  EXPECT_EQ(summary.ranges[0].max.outcome, RangeOutcome::bounded);
  EXPECT_EQ(summary.ranges[1].min.outcome, RangeOutcome::undefined);
  EXPECT_EQ(summary.ranges[1].max.outcome, RangeOutcome::undefined);
}

// Of a block that hangs from its tensile strength and is pulled sideways the normal force is -W everywhere:
// M / -W.
TEST(RatioRange, AJointThatPullsHasAnEccentricity) {
  const Assembly hung =
      testing::make_boxes({{.center = {0, 0, 0.5}, .fixed = true}, {.center = {0, 0, -0.5}}});
  const double weight = free_weight(hung, testing::kG), push = 0.1 * weight;
  Case scene = range_case({kEccentricity});
  scene.joints.compliance.per = Compliance::Per::area;
  scene.joints.strength = {.tension = 3.0 * weight, .cohesion = 3.0 * weight};
  scene.loads.forces = {BlockForce{.block = 1, .point = {}, .force = Vec3(push, 0.0, 0.0), .time = {}}};
  const ForceRange range = run_range(scene, hung, {}).value().ranges.at(0);
  constexpr double kGap = 1e-6;  // m, relative to an edge of 1 m
  EXPECT_NEAR(range.min.value.value(), -0.5 * push / weight, kGap);
  EXPECT_NEAR(range.max.value.value(), -0.5 * push / weight, kGap);
}

// A block on a bed with tension, held both ways from above: its normal force passes from pull to push, at the
// same moment.
TEST(RatioRange, ARatioIsUnboundedWhereItsDenominatorChangesItsSign) {
  const Assembly box = testing::box_on_floor({1, 1, 1});
  const double weight = free_weight(box, testing::kG);
  Case scene = range_case({kEccentricity});
  scene.joints.compliance.per = Compliance::Per::area;
  scene.joints.strength = {.tension = weight, .cohesion = weight, .compression = 4.0 * weight};
  scene.supports.restraints = {{BlockRef{1}, Vec3(0, 0, 1), Vec3::UnitZ()}};
  scene.loads.forces = {
      BlockForce{.block = 1, .point = {}, .force = Vec3(0.1 * weight, 0.0, 0.0), .time = {}}};
  const Summary summary = run_range(scene, box, {}).value();
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  EXPECT_EQ(summary.ranges.at(0).min.outcome, RangeOutcome::unbounded) << summary.message;
  EXPECT_EQ(summary.ranges.at(0).max.outcome, RangeOutcome::unbounded) << summary.message;
}

}  // namespace
}  // namespace cupola::ratio_range_test
