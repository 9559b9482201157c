// Direct limits beyond an end of the bracket, and those that more of the parameter brings about.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "assembly/case/limit_parameter.hpp"
#include "solver/analysis/admissible/direct_limit.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/solver/analysis/limit_scenes.hpp"

namespace cupola::direct_limit_ends_test {
namespace {

using Parameter = LimitSearch::Parameter;
using testing::kG;
using testing::limit_case;

/// A cube on a floor and beside a wall, against which a tilt of the floor presses it.
Assembly cube_at_a_wall() {
  return testing::make_boxes({{.center = {0, 0, -0.5}, .size = {1, 1, 1}, .fixed = true},
                              {.center = {0, 0, 0.5}, .size = {1, 1, 1}},
                              {.center = {1, 0, 0.5}, .size = {1, 1, 1}, .fixed = true}});
}
constexpr double kWeight = 1000.0 * kG;

Summary run(const Case& scene, const Assembly& assembly) {
  return run_limit(scene, assembly, {}).value();
}

void expect_critical(const Case& scene, const Assembly& assembly, double value) {
  const Summary summary = run(scene, assembly);
  ASSERT_TRUE(summary.critical) << summary.message;
  EXPECT_NEAR(summary.critical->value, value, 1e-5 * value) << summary.message;
}

/// Degrees at which cos a + 0.3 sin a, what holds the cube between floor and wall over its weight, falls to
/// `lifted`, by which a force or, negative, cohesion works against it.
double tilt_of_the_cube(double lifted) {
  return (std::atan(0.3) + std::acos(lifted / std::hypot(1.0, 0.3))) * 180.0 / std::numbers::pi;
}

// A wall holds whatever presses against it, but not the force that lifts the cube once its weight points into
// the wall: loads that are not linear in the tilt have no limit because their growth at one end has none.
TEST(DirectLimitEnds, ATiltBesideAForceIsFollowedToItsLimit) {
  Case scene = limit_case(Parameter::tilt, 0.0, 15.0, 0.3);
  BlockForce lift;
  lift.block.number = 1;
  lift.force = {0.0, 0.0, 0.5 * kWeight};
  scene.loads.forces = {lift};
  const Summary stands = run(scene, cube_at_a_wall());
  EXPECT_EQ(stands.status, Status::stable);
  EXPECT_TRUE(stands.message.starts_with(
      "tilt: the structure stands at both ends of the bracket, 0 and 15; widen the bracket"))
      << stands.message;
  EXPECT_EQ(stands.message.find("beyond"), std::string::npos) << stands.message;
  scene.analysis.limit.high = 85.0;
  expect_critical(scene, cube_at_a_wall(), tilt_of_the_cube(0.5));
}

// Upside down the cube slides along the wall, into which the cohesion of the floor, 2 % of its weight, presses
// it.
TEST(DirectLimitEnds, ATiltBeyondTheVertical) {
  expect_critical(limit_case(Parameter::tilt, 0.0, 150.0, 0.3), cube_at_a_wall(), tilt_of_the_cube(0.0));
  Case mortar = limit_case(Parameter::tilt, 0.0, 150.0, 0.3);
  mortar.joints.compliance.per = Compliance::Per::area;
  mortar.joints.strength.cohesion = 0.02 * kWeight;
  expect_critical(mortar, cube_at_a_wall(), tilt_of_the_cube(-0.02 * 1.3));
}

// A pillar presses with 40 kPa on mortar that bears 50 kPa or 30 kPa: it stands at every friction or at none.
// At small ones the cones begin at a pull of a hundred and more times its weight.
TEST(DirectLimitEnds, CrushingIsDecidedAtSmallFrictions) {
  const Assembly pillar = testing::box_on_floor({1, 1, 2}, 2e4 / kG);
  for (const double low : {0.0, 0.005, 0.02, 0.2})
    for (const double strength : {3e4, 5e4}) {
      Case scene = limit_case(Parameter::friction, low, 2.0, 0.4);
      scene.joints.compliance.per = Compliance::Per::area;
      scene.contact.subdivide = 2;
      scene.joints.strength = {.tension = 2e4, .cohesion = 4e4, .compression = strength};
      const Summary summary = run(scene, pillar);
      EXPECT_EQ(summary.status, strength > 4e4 ? Status::stable : Status::moving) << summary.message;
    }
}

// A cube hangs from mortar, which bears tension up to cohesion over friction.
TEST(DirectLimitEnds, MoreFrictionLeavesMortarLessTension) {
  const Assembly hung = testing::make_boxes({{.center = {0, 0, 1.5}, .size = {1, 1, 1}, .fixed = true},
                                             {.center = {0, 0, 0.5}, .size = {1, 1, 1}}});
  Case scene = limit_case(Parameter::friction, 0.01, 1.0, 0.35);
  scene.joints.compliance.per = Compliance::Per::area;
  scene.joints.strength = {.tension = 2.0 * kWeight, .cohesion = 0.8 * kWeight};
  const Summary summary = run(scene, hung);
  ASSERT_TRUE(summary.critical) << summary.message;
  EXPECT_NEAR(summary.critical->value, 0.8, 1e-4 * 0.8) << "the width of the bracket";
  EXPECT_LT(summary.critical->stable, summary.critical->moving);
  scene.analysis.limit.high = 0.7;
  EXPECT_NE(run(scene, hung).message.find("stands at both ends of the bracket, 0.01 and 0.7"),
            std::string::npos);
}

// A tie bears all of the weight: no joint needs to press.
TEST(DirectLimitEnds, ALeastPeakStressOfZeroIsFound) {
  Case scene = limit_case(Parameter::peak_stress, 0.0, 1.0, 0.3);
  scene.joints.compliance.per = Compliance::Per::area;
  PairTie tie;
  tie.block_a = 1;
  tie.block_b = 2;
  tie.point_a = Vec3(0, 0, 0.5);
  tie.point_b = Vec3(0, 0, 3.5);
  tie.stiffness = 1e8;
  scene.ties.pairs = {tie};
  const Summary summary =
      run(scene, testing::make_boxes({{.center = {0, 0, -0.5}, .size = {1, 1, 1}, .fixed = true},
                                      {.center = {0, 0, 0.5}, .size = {1, 1, 1}},
                                      {.center = {0, 0, 3.5}, .size = {1, 1, 1}, .fixed = true}}));
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  ASSERT_TRUE(summary.critical) << summary.message;
  EXPECT_GE(summary.critical->moving, 0.0);
  EXPECT_NEAR(summary.critical->value, 0.0, 1e-8 * kWeight);
}

// Between parallel walls a block presses as hard as one likes, which no equilibrium notices.
TEST(DirectLimitEnds, ABlockBetweenParallelWallsNeedsNoFriction) {
  const Summary summary =
      run(limit_case(Parameter::friction, 0.0, 1.0, 0.6), testing::wedge_between_walls(0.0));
  EXPECT_EQ(summary.status, Status::stable);
  EXPECT_NE(summary.message.find("no limit: the structure stands with a friction of 1e-05"),
            std::string::npos)
      << summary.message;
}

// A beam on a bed and on an edge, which bears half of it: of the edge no stress is known.
TEST(DirectLimitEnds, APeakStressLeavesOutEdges) {
  const Eigen::Quaterniond on_edge(Eigen::AngleAxisd(0.25 * std::numbers::pi, Vec3::UnitY()));
  const testing::BoxSpec beam{.center = {0, 0, 0.25}, .size = {3, 1, 0.5}},
      bed{.center = {-1, 0, -0.5}, .fixed = true},
      edge{.center = {1, 0, -std::sqrt(0.5)}, .fixed = true, .rotation = on_edge};
  Case scene = limit_case(Parameter::peak_stress, 0.0, 1.0, 0.3);
  scene.joints.compliance.per = Compliance::Per::area;
  expect_critical(scene, testing::make_boxes({bed, edge, beam}), 0.5 * 1.5 * kWeight);
  EXPECT_THROW(run(scene, testing::make_boxes({edge, {.center = {1, 0, 0.5}}})), InputError) << "no area";
}

/// A cube of weight W that hangs from a tie through its centroid, x = y = `missed`, which yields at 1.5 W.
Case hung_cube(double missed) {
  Case scene = limit_case(Parameter::load, 0.0, 10.0, 0.5);
  PairTie tie;
  tie.block_a = 0;
  tie.block_b = 1;
  tie.point_a = Vec3(missed, missed, 5.0);
  tie.point_b = Vec3(missed, missed, 1.0);
  tie.yield_force = 1.5 * kWeight;
  scene.ties.pairs = {tie};
  BlockForce load;
  load.block.number = 1;
  load.force = {0.0, 0.0, -0.5 * kWeight};
  scene.loads.forces = {load};
  return scene;
}
Assembly cube_below_a_ceiling() {
  return testing::make_boxes({{.center = {0, 0, 5.5}, .size = {6, 2, 1}, .fixed = true},
                              {.center = {0, 0, 0.5}, .size = {1, 1, 1}}});
}
constexpr double kRounding = 5e-17;  // m

TEST(DirectLimitEnds, ATieThatMissesACentroidByRoundingBearsTheBlock) {
  expect_critical(hung_cube(kRounding), cube_below_a_ceiling(), 1.0);
}

// With a moment that nothing balances the cube has no state but that without forces, at -2. At the ends of the
// bracket the solver does not notice it.
TEST(DirectLimitEnds, NoLimitLiesOutsideItsBracket) {
  const auto assembly = std::make_shared<const Assembly>(cube_below_a_ceiling());
  const auto scene_at = [&](double value) {
    RigidScene rigid = rigid_scene(case_at(hung_cube(0.0), value), assembly);
    rigid.problem.contacts.D_b[0].arm.head<2>().setConstant(kRounding);
    return rigid;
  };
  const DirectLimit limit = limit_of_loads(scene_at, 0.0, 10.0, 1e-5, [](const DirectTrial&) {});
  ASSERT_TRUE(limit.found) << clauses(limit.sought);
  EXPECT_NEAR(limit.middle(), 1.0, 0.02);  // of bisection, whose solves notice it at some values
}

}  // namespace
}  // namespace cupola::direct_limit_ends_test
