#include <algorithm>
#include <cmath>

#include "tests/solver/analysis/path_run.hpp"

// Steps of a path so long that their linear geometry says little of where they end.

namespace cupola::path_test {
namespace {

Case long_step_case(double friction, int steps) {
  Case scene = testing::make_case(friction, 1e-9, 0.01);
  scene.analysis.type = AnalysisType::path;
  scene.analysis.friction_law = FrictionLaw::coulomb;
  scene.analysis.tolerance = 1e-9;
  scene.analysis.path.steps = steps;
  return scene;
}

/// A cube of 1 m on a floor and a wall of the given thickness, with its near face at x = 0.7 and `aside` from
/// the middle of the cube. Blocks: floor, cube, wall.
Assembly cube_and_wall(double thickness, double aside) {
  return testing::make_boxes(
      {{.center = {0, 0, -0.5}, .size = {20, 20, 1}, .fixed = true},
       {.center = {0, 0, 0.5}, .size = {1, 1, 1}},
       {.center = {0.7 + 0.5 * thickness, aside, 0.55}, .size = {thickness, 1, 1}, .fixed = true}});
}

/// The path of the wall's motion; it stands.
Frame end_of_push(const Assembly& assembly, const Vec3& motion) {
  Case scene = long_step_case(0.5, 1);
  scene.supports.moves = {
      {.region = {.blocks = {BlockRef{2}}}, .displacement = motion, .time = RampInTime{}}};
  const PathResult path = run(scene, assembly);
  EXPECT_EQ(path.summary.status, Status::stable) << path.summary.message;
  return path.frames.back();
}

// The wall is twenty margins from the cube at the start of the step, where contacts are detected, and would
// be inside the cube at its end, or beyond it.
TEST(LongStep, AWallPushesACubeBeyondTheMargin) {
  for (const double way : {0.5, 3.0}) {
    for (const double thickness : {0.2, 1.0}) {
      const Frame frame = end_of_push(cube_and_wall(thickness, 0.0), {-way, 0, 0});
      EXPECT_NEAR(frame.blocks.displacement[1].x(), 0.2 - way, 1e-4) << way << " " << thickness;
    }
  }
}

// The faces of wall and cube are not opposite each other at the start of the step.
TEST(LongStep, AWallFromAsidePushesACube) {
  const Frame frame = end_of_push(cube_and_wall(1.0, 1.3), {-0.5, -1.0, 0});
  const Vec3 apart = Vec3(0.7, 0.3, 0) - frame.blocks.displacement[1];  // of the centroids
  EXPECT_GT(std::max(std::abs(apart.x()), std::abs(apart.y())), 1.0 - 1e-3) << frame.blocks.displacement[1];
}

// A tower of height h on a bed of the compliance c (m3/N) and width b, pushed at its top. It leans by t where
// the bed, without tension, bears M = W (b / 2 - sqrt(2 W c / t) / 3) = H h + W h t / 2, which has a solution
// up to H = 0.35 W b / h. In the geometry at the start of the step it is up to W b / (2 h). Shorter steps, to
// which the path then turns, need no correction and are off by what they move.
TEST(LongStep, WhatFindsNoEquilibriumAtItsEndDoesNotStand) {
  const double b = 1.0, h = 10.0, W = 1000.0 * testing::kG * b * h, tilt = 0.01;
  const double c = std::pow(tilt, 3) * std::pow(3.0 * h, 2) / (2.0 * W);
  const double largest = W / h * (0.5 * b - std::sqrt(2.0 * W * c / tilt) / 3.0 - 0.5 * h * tilt);
  for (const double share : {0.9, 1.2}) {
    Case scene = long_step_case(0.5, 1);
    scene.joints.compliance = {c, c, Compliance::Per::area};
    scene.contact.subdivide = 8;
    scene.loads.forces = {{BlockRef{1}, Vec3(0, 0, h), Vec3(share * largest, 0, 0), RampInTime{}}};
    const PathResult path = run(scene, testing::box_on_floor({b, 1, h}));
    EXPECT_EQ(path.summary.status == Status::stable, share < 1.0) << path.summary.message;
    EXPECT_NEAR(path.largest_force(), std::min(share, 1.0) * largest, 0.08 * largest) << share;
  }
}

/// A cube on a floor under a horizontal force along x, on two ties of 1 m that are `lag` behind the normal to
/// it.
Case pulled_across(double friction, double force, double lag, double stiffness) {
  Case scene = long_step_case(friction, 1);
  for (const double side : {-1.0, 1.0}) {
    PairTie tie;
    tie.block_a = BlockRef{0};
    tie.block_b = BlockRef{1};
    tie.point_a = {-lag, side, 0.5};
    tie.point_b = {0, 0, 0.5};
    tie.stiffness = stiffness;
    scene.ties.pairs.push_back(tie);
  }
  scene.loads.forces = {{BlockRef{1}, Vec3(0, 0, 0.5), Vec3(force, 0, 0), RampInTime{}}};
  return scene;
}

// Until they turn, the ties resist little: in the geometry at the start of the step the cube moves 0.39 m,
// held by the soft spring, and the ties elongate by 7.8 mm and yield; at rest it has moved 0.08 m.
TEST(LongStep, TiesDoNotYieldBeyondTheirEquilibrium) {
  const double k = 5e4, lag = 0.02, spring = 100.0, force = 50.0, yield = 275.0;
  Case scene = pulled_across(0.0, force, lag, k);
  PairTie soft = scene.ties.pairs[0];
  soft.point_a = {-2, 0, 0.5};
  soft.stiffness = spring;
  for (PairTie& tie : scene.ties.pairs) tie.yield_force = yield;
  scene.ties.pairs.push_back(soft);
  const PathResult path = run(scene, testing::box_on_floor({1, 1, 1}));
  ASSERT_EQ(path.summary.status, Status::stable) << path.summary.message;
  const Frame& frame = path.frames.back();
  const double x = frame.blocks.displacement[1].x();
  const double length = std::hypot(1.0, x + lag), tension = k * (length - std::hypot(1.0, lag));
  EXPECT_LT(tension, yield);
  EXPECT_NEAR(2.0 * tension * (x + lag) / length + spring * x, force, 1e-5 * force);
  for (const double yielded : frame.ties.yielded) EXPECT_EQ(yielded, 0.0);
  EXPECT_NEAR(path.rows.back()[3], 0.0, 1e-12) << "J, rounding";
}

// The same ties without a spring: in the geometry at the start of the step they resist after 40 m. Steps that
// move less than a hundredth of the cube are not corrected, and balance to 1 %.
TEST(LongStep, TiesAcrossTheMotionHoldItWhereTheyHaveTurned) {
  for (const double friction : {0.0, 0.1}) {
    const double k = 5e5, lag = 0.0087, force = 3000.0;
    const PathResult path = run(pulled_across(friction, force, lag, k), testing::box_on_floor({1, 1, 1}));
    ASSERT_EQ(path.summary.status, Status::stable) << path.summary.message;
    const double x = path.frames.back().blocks.displacement[1].x(), length = std::hypot(1.0, x + lag);
    const double held = 2.0 * k * (length - std::hypot(1.0, lag)) * (x + lag) / length;
    const double slides_at = friction * 1000.0 * testing::kG;  // N
    EXPECT_NEAR(held, force, slides_at + 0.01 * force) << friction;
    const double slid = slides_at * x;  // J; of it springs store 1e-5
    EXPECT_NEAR(path.rows.back()[3], slid, 1e-4 * slid + 1e-12) << "to and fro of corrections does not count";
  }
}

// A block pushed over by a force beside its middle. Cracks that bear after one solve pull after the next.
TEST(LongStep, NoticesThatCracksComeBackToAnEarlierState) {
  const Assembly block = testing::box_on_floor({0.8, 1, 0.7}, 2000);
  Case scene = long_step_case(0.3, 1);
  scene.joints.compliance = {1e-11, 1e-11, Compliance::Per::area};
  scene.joints.strength = {1e4, 100.0};
  scene.analysis.tolerance = 1e-8;
  scene.loads.forces = {{BlockRef{1}, Vec3(0, 0.3, 0.7), Vec3(-3708, 0, 0), RampInTime{}}};
  const std::string message = run(scene, block).summary.message;
  EXPECT_NE(message.find("came back to what it was before after 2 solves"), std::string::npos) << message;
}

}  // namespace
}  // namespace cupola::path_test
