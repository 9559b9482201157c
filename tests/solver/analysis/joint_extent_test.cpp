// Least extents of joints that are open in part: a reduced joint bears where it is closed.
#include <cmath>

#include <gtest/gtest.h>

#include "solver/analysis/analysis.hpp"
#include "tests/solver/analysis/limit_scenes.hpp"

namespace cupola::joint_extent_test {
namespace {

using Parameter = LimitSearch::Parameter;
using testing::limit_case;

/// Two bars that lean against each other between two walls, which they touch with their upper edges and each
/// other with their lower ones.
Assembly three_hinges() {
  constexpr double kSlope = 0.1, kLength = 4.0, kDepth = 0.1;
  const double c = std::cos(kSlope), s = std::sin(kSlope);
  const double x = 0.5 * (kLength * c + kDepth * s), z = 0.5 * (kDepth * c - kLength * s);
  std::vector<testing::BoxSpec> boxes;
  for (const double side : {-1.0, 1.0}) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(side * kSlope, Vec3::UnitY()));
    boxes.push_back({.center = {side * (2.0 * x + 0.5), 0, z}, .size = {1, 2, 3}, .fixed = true});
    boxes.push_back({.center = {side * x, 0, z}, .size = {kLength, 1, kDepth}, .rotation = turn});
  }
  return testing::make_boxes(boxes);
}

// The line of thrust passes through the edges; reduced, the faces bear nowhere.
TEST(JointExtent, HingesLeaveNothingToReduce) {
  for (const bool plane : {false, true}) {
    Case scene = limit_case(Parameter::joint_extent, 0.1, 1.0, 0.7);
    scene.joints.compliance.per = Compliance::Per::area;
    scene.contact.margin = 1e-4;
    scene.analysis.plane = plane;
    const Summary summary = run_limit(scene, three_hinges(), {}).value();
    EXPECT_EQ(summary.status, Status::stable);
    ASSERT_TRUE(summary.critical) << summary.message;
    EXPECT_EQ(summary.critical->stable, 1.0) << summary.message;
    EXPECT_GE(summary.critical->moving, 1.0 - 1e-4) << "the width of the bracket";
  }
}

// A cube of 1 m whose face is closed from x = -0.5 to -0.1. The resultant of its weight is at -0.12, as far
// from the middle as the reduced face then reaches, and once it is at -0.05, where the face is open.
TEST(JointExtent, AReducedJointBearsWhereItIsClosed) {
  constexpr double kTurn = 1e-3;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(-kTurn, Vec3::UnitY()));
  const double z = 0.5 * (std::cos(kTurn) + std::sin(kTurn));  // its edge is at z = 0
  const Assembly cube = testing::make_boxes(
      {{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true}, {.center = {0, 0, z}, .rotation = turn}});
  Case scene = limit_case(Parameter::joint_extent, 0.1, 1.0, 0.7);
  scene.joints.compliance.per = Compliance::Per::area;
  scene.contact.margin = 0.42e-3;
  scene.contact.subdivide = 10;
  const auto critical = [&](double slope) {
    scene.loads.gravity = testing::tilted_gravity(slope);
    const auto found = run_limit(scene, cube, {}).value().critical;
    return found ? found->value : 0.0;
  };
  EXPECT_NEAR(critical(-0.24), 0.24, 2e-3) << "twice the turn, about which arms are changed";
  EXPECT_EQ(critical(-0.1), 0.0);
}

}  // namespace
}  // namespace cupola::joint_extent_test
