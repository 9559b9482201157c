// Limits that find no critical value: what they show of the case itself.
#include <gtest/gtest.h>

#include "solver/analysis/analysis.hpp"
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

}  // namespace
}  // namespace cupola::limit_of_case_test
