// Limits that find no critical value: what they show of the case itself.
#include <gtest/gtest.h>

#include "solver/analysis/analysis.hpp"
#include "solver/analysis/statics/static_solve.hpp"
#include "tests/solver/analysis/limit_scenes.hpp"

namespace cupola::limit_of_case_test {
namespace {

using Parameter = LimitSearch::Parameter;
using testing::limit_case;

Assembly block() {
  return testing::box_on_floor({1.0, 0.5, 0.2});
}

/// With 10 N on the block, sideways.
Case pushed(Case scene) {
  BlockForce push;
  push.block.number = 1;
  push.force = {10.0, 0, 0};
  scene.loads.forces = {push};
  return scene;
}

void expect(const Case& scene, const Assembly& assembly, Status status, const std::string& message) {
  const Summary summary = run_limit(scene, assembly, {}).value();
  EXPECT_EQ(summary.status, status) << summary.message;
  EXPECT_FALSE(summary.critical);
  EXPECT_NE(summary.message.find(message), std::string::npos) << summary.message;
}

// A block of friction 0.3 slides at 0.3 g, and on slopes steeper than 0.3.
TEST(LimitOfCase, StandsWhereBothEndsDo) {
  expect(limit_case(Parameter::acceleration, 0.0, 0.1, 0.3), block(), Status::stable,
         "no limit from 0 to 0.1: the structure stands at both ends of the bracket, 0 and 0.1; widen the "
         "bracket beyond about 0.3");
  expect(limit_case(Parameter::tilt, 0.0, 1.0, 0.3), block(), Status::stable, "no limit from 0 to 1");
  expect(pushed(limit_case(Parameter::load, 0.0, 2.0, 0.3)), block(), Status::stable, "no limit from 0 to 2");
}

// A floor moves by 2 m, and the block on it too.
TEST(LimitOfCase, StandsWhereASpreadDoesThroughout) {
  Case scene = limit_case(Parameter::spread, 0.0, 2.0, 0.3);
  SupportMove move;
  move.region.blocks = {0};
  move.displacement = Vec3(1, 0, 0);
  scene.supports.moves = {move};
  expect(scene, block(), Status::stable, "the structure stands up to the end of the bracket, 2; widen");
  scene.supports.moves[0].displacement.setZero();
  expect(scene, block(), Status::stable, "spread: the structure stands, and no support moves; give");
  scene.supports.moves.clear();
  expect(scene, block(), Status::stable, "spread: the structure stands, and no support moves; give");
}

// Factors below 0 withdraw the support, of whose bearing of 0.2 m they use up 0.7, or 0.14. On the other one,
// which bears more, the lintel stays.
TEST(LimitOfCase, ASpreadByNegativeFactorsIsThatOfTheOppositeMotion) {
  const Assembly lintel =
      testing::make_boxes({{.center = {-0.5, 0, -0.25}, .size = {1, 1, 0.5}, .fixed = true},
                           {.center = {2.5, 0, -0.25}, .size = {1, 1, 0.5}, .fixed = true},
                           {.center = {0.6, 0, 0.2}, .size = {3.2, 1, 0.4}}});
  Case scene = limit_case(Parameter::spread, -0.7, -0.6, 0.6);
  scene.analysis.friction_law = FrictionLaw::coulomb;
  SupportMove move;
  move.region.blocks = {1};
  move.displacement = Vec3(-1, 0, 0);
  scene.supports.moves = {move};
  expect(scene, lintel, Status::unconverged, "moving at the start of the bracket, -0.7");
  scene.supports.moves[0].displacement = Vec3(-0.2, 0, 0);
  expect(scene, lintel, Status::stable, "the structure stands up to the end of the bracket, -0.6");
}

// Limits hold for the geometry as built: a block slides at 0.3 g wherever its floor has moved, farther than
// the margin within which faces make a joint, or from under half of the block.
TEST(LimitOfCase, DoesNotDependOnMotionsOfSupports) {
  for (const auto method : {LimitSearch::Method::direct, LimitSearch::Method::bisection}) {
    Case scene = limit_case(Parameter::acceleration, 0.0, 1.0, 0.3);
    scene.analysis.limit.method = method;
    for (const Vec3& moved : {Vec3(0, 0, -0.02), Vec3(0, 0, 0.02), Vec3(10, 0, 0)}) {
      scene.supports.moves = {{.region = {}, .displacement = moved, .time = {}}};
      const Summary summary = run_limit(scene, block(), {}).value();
      ASSERT_TRUE(summary.critical) << moved.transpose() << ": " << summary.message;
      EXPECT_NEAR(0.5 * (summary.critical->stable + summary.critical->moving), 0.3, 1e-3) << "the bracket";
    }
  }
}

// The loads are not linear in the angle where a force stays as it is: in between it could move.
TEST(LimitOfCase, ATiltBesideAForceIsNoInterval) {
  expect(pushed(limit_case(Parameter::tilt, 0.0, 1.0, 0.3)), block(), Status::stable,
         "tilt: the structure stands at both ends of the bracket, 0 and 1");
}

TEST(LimitOfCase, ThicknessesSayNothingOfThoseBetween) {
  const Assembly arch = testing::make_arch({.voussoirs = 12, .thickness = 0.4});
  expect(limit_case(Parameter::thickness, 0.5, 1.0, 0.7), arch, Status::stable,
         "thickness: the structure stands at both ends of the bracket, 0.5 and 1; widen the bracket");
  expect(limit_case(Parameter::thickness, 0.5, 1.0, 0.05), arch, Status::moving,
         "moves at both ends of the bracket, 0.5 and 1; it must stand at one");
}

TEST(LimitOfCase, IsOpenWhereTheCaseDoesOtherwise) {
  expect(limit_case(Parameter::acceleration, 1.0, 2.0, 0.3), block(), Status::unconverged,
         "moves at every value from 1 to 2");
  Case scene = limit_case(Parameter::friction, 0.5, 1.0, 0.1);
  scene.loads.gravity = testing::tilted_gravity(0.25);
  expect(scene, block(), Status::unconverged, "stands at every value from 0.5 to 1");
}

TEST(LimitOfCase, OfBisectionIsItsOwnStatics) {
  const auto bisect = [](double low, double high, double friction) {
    Case scene = limit_case(Parameter::friction, low, high, friction);
    scene.loads.gravity = testing::tilted_gravity(0.25);
    scene.analysis.friction_law = FrictionLaw::coulomb;
    return scene;
  };
  const std::string stands = "stands at both ends of the bracket, 0.5 and 1; widen the bracket";
  const std::string moves = "moves at both ends of the bracket, 0.05 and 0.2; it must stand at one";
  expect(bisect(0.5, 1.0, 0.7), block(), Status::stable, stands);
  expect(bisect(0.5, 1.0, 0.1), block(), Status::unconverged, stands);
  expect(bisect(0.05, 0.2, 0.1), block(), Status::moving, moves);
  expect(bisect(0.05, 0.2, 0.7), block(), Status::unconverged, moves);
}

// Pulled by 0 it stands, by 3 g to one side and 2 g to the other it slides: the state shown is its own.
TEST(LimitOfCase, StandsWhereBothEndsMove) {
  for (const auto method : {LimitSearch::Method::direct, LimitSearch::Method::bisection}) {
    Case scene = limit_case(Parameter::acceleration, -3.0, 2.0, 0.3);
    scene.analysis.limit.method = method;
    std::vector<Frame> frames;
    AnalysisSinks sinks;
    sinks.frame = [&](const Frame& frame) { frames.push_back(frame); };
    const Summary summary = run_limit(scene, block(), sinks).value();
    EXPECT_EQ(summary.status, Status::unconverged) << "of the limit; " << summary.message;
    EXPECT_NE(summary.message.find("; the case itself stands"), std::string::npos) << summary.message;
    EXPECT_DOUBLE_EQ(summary.weight_N, free_weight(block(), testing::kG)) << "without the pull";
    EXPECT_LE(summary.equilibrium_residual.value_or(1.0), kOutcomeTolerance);
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_EQ(frames[0].role, FrameRole::equilibrium);
  }
}

// What both ends, and the case, only show to move: it has blocks and a weight all the same.
TEST(LimitOfCase, WhatFallsHasItsWeight) {
  for (const auto method : {LimitSearch::Method::direct, LimitSearch::Method::bisection}) {
    Case scene = limit_case(Parameter::acceleration, 1.0, 2.0, 0.3);
    scene.loads.gravity = testing::tilted_gravity(0.4);
    scene.analysis.limit.method = method;
    scene.analysis.limit.direction = {0.0, 1.0, 0.0};  // at right angles to gravity
    const Summary summary = run_limit(scene, block(), {}).value();
    EXPECT_EQ(summary.status, Status::moving) << summary.message;
    EXPECT_EQ(summary.free_blocks, 1);
    EXPECT_GT(summary.contacts, 0);
    EXPECT_GT(summary.applied_load_N.norm(), 0.0);
    EXPECT_DOUBLE_EQ(summary.weight_N, free_weight(block(), scene.loads.gravity.norm()))
        << "without the pull";
    EXPECT_FALSE(summary.max_displacement_m);
  }
}

}  // namespace
}  // namespace cupola::limit_of_case_test
