// Points held in one direction without friction, both ways: in statics, limits, ranges, motions and paths,
// against closed forms.
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/solver/analysis/path_run.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::restraints_test {
namespace {

constexpr double kHeight = 1.5, kThickness = 0.11;  // m, of the wall

BlockForce push(int block, const Vec3& point, const Vec3& force) {
  BlockForce load;
  load.block = BlockRef{block};
  load.point = point;
  load.force = force;
  return load;
}

/// Two halves of a wall on each other; blocks: floor, lower, upper.
Assembly wall() {
  const Vec3 half(1.0, kThickness, 0.5 * kHeight);
  return testing::make_boxes({{.center = {0, 0, -0.5}, .size = {4, 4, 1}, .fixed = true},
                              {.center = {0, 0, 0.25 * kHeight}, .size = half, .ring = 0},
                              {.center = {0, 0, 0.75 * kHeight}, .size = half, .ring = 1}});
}

/// The head of the wall is held across its plane and free to rise; a force acts at mid-height.
Case pushed_wall(double force) {
  Case scene = testing::make_case(0.7, 1e-12, 0.01);
  scene.loads.forces = {push(1, {0, -0.5 * kThickness, 0.5 * kHeight}, {0, force, 0})};
  scene.supports.restraints = {{BlockRef{2}, Vec3(0, 0, kHeight), Vec3::UnitY()}};
  return scene;
}

// Both halves turn about their toes. Of a unit of displacement at mid-height the wall rises so much that F =
// 2 W t / h.
TEST(Restraints, HoldTheHeadOfAWallInALimit) {
  const Assembly assembly = wall();
  const double weight = free_weight(assembly, testing::kG);
  Case scene = pushed_wall(weight);
  scene.analysis.type = AnalysisType::limit;
  scene.analysis.limit.parameter = LimitSearch::Parameter::load;
  scene.analysis.limit.low = 0.0;
  scene.analysis.limit.high = 1.0;
  const double exact = 2.0 * kThickness / kHeight;
  const Summary held = run_limit(scene, assembly, {}).value();
  ASSERT_TRUE(held.critical) << held.message;
  EXPECT_NEAR(held.critical->value, exact, 2e-6 * exact);  // the width of the bracket
  scene.supports.restraints
      .clear();  // the lower half turns alone: F h / 2 = W t / 2, and the upper one rides on it
  const Summary loose = run_limit(scene, assembly, {}).value();
  ASSERT_TRUE(loose.critical) << loose.message;
  EXPECT_NEAR(loose.critical->value, kThickness / kHeight, 2e-6 * exact);
}

// A step is solved in the geometry at its start, in which the wall has already moved: the force lags by less
// than one step.
TEST(Restraints, HoldTheHeadOfAWallAlongAPath) {
  const Assembly assembly = wall();
  const double weight = free_weight(assembly, testing::kG), exact = 2.0 * kThickness / kHeight;
  Case scene = pushed_wall(weight);
  scene.loads.forces[0].time = RampInTime{};
  scene.analysis.type = AnalysisType::path;
  scene.analysis.tolerance = 1e-8;
  scene.analysis.path.steps = 20;
  scene.analysis.path.end = 0.2;
  scene.analysis.path.control = LoadPath::Control{BlockRef{1}, {}, Vec3::UnitY()};
  const path_test::PathResult result = path_test::run(scene, assembly);
  ASSERT_FALSE(result.rows.empty()) << result.summary.message;
  EXPECT_NEAR(result.rows.back()[0], exact, 0.01 * 0.2);  // steps of 0.01, halved six times
  EXPECT_LE(result.rows.back()[0], exact);
}

// Without friction the restraint carries the whole force, pulling or pushing.
TEST(Restraints, CarryAForceOfBothSigns) {
  const Assembly box = testing::box_on_floor({1.0, 1.0, 1.0});
  for (const double sign : {1.0, -1.0}) {
    Case scene = testing::make_case(0.0, 1e-8, 0.01);
    scene.analysis.type = AnalysisType::static_;
    scene.loads.forces = {push(1, {0, 0, 0.5}, {300.0 * sign, 0, 0})};
    scene.supports.restraints = {{BlockRef{1}, std::nullopt, Vec3(2.0, 0, 0)}};  // its length does not matter
    AnalysisSinks sinks;
    Frame frame;
    sinks.frame = [&](const Frame& f) { frame = f; };
    const Summary summary = run_static(scene, box, sinks);
    EXPECT_EQ(summary.status, Status::stable) << summary.message;
    ASSERT_EQ(frame.ties.size(), 2);
    EXPECT_NEAR(frame.ties.force[0], sign > 0.0 ? 300.0 : 0.0, 1e-6);
    EXPECT_NEAR(frame.ties.force[1], sign > 0.0 ? 0.0 : 300.0, 1e-6);
    EXPECT_EQ(frame.ties.strut[1], 1);
  }
}

// A box on a soft bed slides by 30 mm across its restraint, whose force stays along its direction, through the
// held point. Tables take the force along the written ends.
TEST(Restraints, ForceFollowsTheHeldPointAndDoesNotTurn) {
  const Assembly box = testing::box_on_floor({1.0, 1.0, 1.0});
  Case scene = testing::make_case(0.7, 1e-4, 0.01);
  scene.analysis.type = AnalysisType::static_;
  scene.loads.forces = {push(1, {0, 0, 0.5}, {300.0, 300.0, 0})};
  scene.supports.restraints = {{BlockRef{1}, std::nullopt, Vec3::UnitX()}};
  AnalysisSinks sinks;
  Frame frame;
  sinks.frame = [&](const Frame& f) { frame = f; };
  ASSERT_EQ(run_static(scene, box, sinks).status, Status::stable);
  ASSERT_GT(frame.blocks.displacement[1].y(), 0.01);
  for (int i = 0; i < frame.ties.size(); ++i) {
    const Vec3 along = frame.ties.point_b[i] - frame.ties.point_a[i];
    EXPECT_NEAR(along.x(), 1.0, 1e-12);  // rounding: the edge of the box
    EXPECT_NEAR(along.tail<2>().norm(), 0.0, 1e-12);
  }
}

// A box that is not pushed: the shear of its bed may be anything that friction admits, because the restraint
// balances it. Tie and strut of the restraint do not press against each other.
TEST(Restraints, WidenARange) {
  const Assembly box = testing::box_on_floor({1.0, 1.0, 0.2});
  const double weight = free_weight(box, testing::kG);
  Case scene = testing::make_case(0.3, 1e-8, 0.01);
  scene.geometry.surface = WallSurface{};
  scene.analysis.type = AnalysisType::range;
  scene.analysis.tolerance = 1e-9;
  scene.analysis.range.quantities = {JointForce{0, 1, JointForce::Component::shear, Vec3::UnitX()},
                                     RestraintForce{0}};
  scene.analysis.range.states = true;
  scene.supports.restraints = {{BlockRef{1}, std::nullopt, Vec3::UnitX()}};
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& f) {
    EXPECT_EQ(std::min(f.ties.force[0], f.ties.force[1]), 0.0) << f.label;
    EXPECT_LE(std::max(f.ties.force[0], f.ties.force[1]), (0.3 + 1e-6) * weight) << f.label;
  };
  const Summary summary = run_range(scene, box, sinks).value();
  ASSERT_EQ(summary.status, Status::stable) << summary.message;
  for (const ForceRange& range : summary.ranges) {
    EXPECT_NEAR(range.min.value.value(), -0.3 * weight, 1e-6 * weight) << range.quantity;
    EXPECT_NEAR(range.max.value.value(), 0.3 * weight, 1e-6 * weight) << range.quantity;
  }
}

// A load to the right of less than friction: the restraint pushes by as much as the bed leaves, along its
// direction, or pulls.
TEST(Restraints, HaveARangeWithASign) {
  const Assembly box = testing::box_on_floor({1.0, 1.0, 0.2});
  const double weight = free_weight(box, testing::kG);
  Case scene = testing::make_case(0.3, 1e-8, 0.01);
  scene.analysis.type = AnalysisType::range;
  scene.analysis.tolerance = 1e-9;
  scene.loads.forces = {push(1, Vec3::Zero(), {0.1 * weight, 0, 0})};
  scene.analysis.range.quantities = {RestraintForce{0}};
  for (const double sign : {1.0, -1.0}) {
    scene.supports.restraints = {{BlockRef{1}, Vec3::Zero(), Vec3(2.0 * sign, 0, 0)}};
    const ForceRange range = run_range(scene, box, {}).value().ranges.at(0);
    EXPECT_NEAR(sign > 0.0 ? range.min.value.value() : -range.max.value.value(), -0.4 * weight,
                1e-6 * weight);
    EXPECT_NEAR(sign > 0.0 ? range.max.value.value() : -range.min.value.value(), 0.2 * weight, 1e-6 * weight);
  }
}

TEST(Restraints, AreNoTiesOfARange) {
  const Assembly box = testing::box_on_floor({1.0, 1.0, 0.2});
  Case scene = testing::make_case(0.3, 1e-8, 0.01);
  scene.analysis.type = AnalysisType::range;
  scene.supports.restraints = {{BlockRef{1}, std::nullopt, Vec3::UnitX()}};
  const auto message = [&](const ForceQuantity& quantity) -> std::string {
    scene.analysis.range.quantities = {quantity};
    try {
      run_range(scene, box, {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(TieForce{0}).find("the model has no ties"), std::string::npos);
  EXPECT_NE(message(RestraintForce{1}).find("restraint 1 does not exist: the model has restraints 0 to 0"),
            std::string::npos);
}

// A frictionless plane that falls towards x and y: the box is held along x, and along y it falls freely.
TEST(Restraints, LeaveTheOtherDirectionsFreeInAMotion) {
  const Assembly box = testing::box_on_floor({1.0, 1.0, 0.2});
  Case scene = testing::make_case(0.0, 1e-8, 0.01);
  scene.loads.gravity = {2.0, 1.0, -9.0};
  scene.supports.restraints = {{BlockRef{1}, std::nullopt, Vec3::UnitX()}};
  Simulation simulation = testing::simulate(scene, box);
  for (int step = 0; step < 50; ++step) simulation.advance();
  EXPECT_NEAR(simulation.state().v[1], 1.0 * 50 * 0.01, 1e-9);
  const double stretch = 2.0 * box.blocks[1].mass / 1e10;  // m, of its bar; twice that while it swings
  EXPECT_NEAR(simulation.state().poses[1].p_WB.x(), 0.0, 2.0 * stretch);
  EXPECT_GT(simulation.state().poses[1].p_WB.x(), 0.0);
}

// A floor that moves under a held box drags it with the friction of its bed, the force of the support.
TEST(Restraints, DoNotMoveWithASupport) {
  const Assembly box = testing::box_on_floor({1.0, 1.0, 0.2});
  const double weight = free_weight(box, testing::kG);
  Case scene = testing::make_case(0.3, 1e-9, 0.01);
  scene.supports.restraints = {{BlockRef{1}, Vec3::Zero(), Vec3::UnitX()}};
  SupportMove move;
  move.displacement = {0.05, 0, 0};
  move.time = RampInTime{};
  scene.supports.moves = {move};
  scene.analysis.type = AnalysisType::path;
  scene.analysis.tolerance = 1e-8;
  scene.analysis.path.steps = 5;
  scene.analysis.path.control = LoadPath::Control{BlockRef{0}, {}, Vec3::UnitX()};
  const path_test::PathResult result = path_test::run(scene, box);
  ASSERT_FALSE(result.rows.empty()) << result.summary.message;
  EXPECT_NEAR(result.rows.back()[2], 0.3 * weight, 1e-6 * weight);
  EXPECT_NEAR(result.frames.back().blocks.displacement[1].x(), 0.0, 2.0 * 0.3 * weight / 1e10);  // of its bar
}

// The ground that moves takes a held box on a frictionless floor along.
TEST(Restraints, MoveWithTheGround) {
  const std::string path = ::testing::TempDir() + "/ground_of_a_held_box.csv";
  std::ofstream(path) << "0, 0\n1, 0.5\n";
  const Assembly box = testing::box_on_floor({1.0, 1.0, 0.2});
  Case scene = testing::make_case(0.0, 1e-8, 0.01);
  scene.supports.restraints = {{BlockRef{1}, Vec3::Zero(), Vec3::UnitX()}};
  scene.supports.base_motion = BaseMotion{path, BaseMotion::Quantity::displacement, Vec3::UnitX()};
  Simulation simulation = testing::simulate(scene, box);
  for (int step = 0; step < 50; ++step) simulation.advance();
  EXPECT_NEAR(simulation.state().poses[1].p_WB.x(), 0.25, 1e-6);
}

TEST(Restraints, OfAFixedBlockAreRefused) {
  const Assembly box = testing::box_on_floor({1.0, 1.0, 0.2});
  Case scene = testing::make_case(0.0, 1e-8, 0.01);
  scene.supports.restraints = {{BlockRef{0}, std::nullopt, Vec3::UnitX()}};
  EXPECT_THROW(testing::simulate(scene, box), InputError);
}

// A rigid footing of width b on joints of compliance c per area, such as soil of subgrade modulus 1/c, under
// its weight W and a horizontal force H at height a: it sinks by c W / A and turns by c H a / I about the
// axis through the middle of its base, with I = l b^3 / 12, as long as the whole base is pressed (H a < W b /
// 6).
TEST(ElasticSupports, SinkAndTurnAFootingByItsClosedForm) {
  constexpr double kB = 2.0, kL = 3.0, kZ = 1.0, kC = 2e-8, kH = 4000.0;
  const Assembly box = testing::box_on_floor({kB, kL, kZ});
  const double weight = free_weight(box, testing::kG);
  Case scene = testing::make_case(0.7, 0.0, 0.01);
  scene.joints.compliance = {1e-12, 1e-12, Compliance::Per::area};
  scene.joints.base = JointLawChange{};
  scene.joints.base->normal = kC;
  scene.joints.base->tangential = kC;
  scene.contact.subdivide = 16;
  scene.analysis.type = AnalysisType::static_;
  scene.loads.forces = {push(1, {0, 0, kZ}, {kH, 0, 0})};
  ASSERT_LT(kH * kZ, weight * kB / 6.0);
  AnalysisSinks sinks;
  Frame frame;
  sinks.frame = [&](const Frame& f) { frame = f; };
  run_static(scene, box, sinks);
  const double turn = kC * kH * kZ / (kL * kB * kB * kB / 12.0);
  const Vec3& d = frame.blocks.displacement[1];
  // The quadrature of the pressures is exact for linear ones; the tolerance is that of the solve.
  EXPECT_NEAR(d.z(), -kC * weight / (kB * kL), 1e-5 * kC * weight / (kB * kL));
  EXPECT_NEAR(d.x(), kC * kH / (kB * kL) + turn * 0.5 * kZ, 1e-3 * turn);
}

// Two cubes that a tie connects stand; one beside them, held from the side only, falls.
TEST(Restraint, PartsThatFallLeaveTheirRestraintsOut) {
  const Vec3 cube(1.0, 1.0, 1.0);
  const Assembly assembly = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {20, 4, 1}, .fixed = true},
                                                 {.center = {-5, 0, 0.5}, .size = cube},
                                                 {.center = {0, 0, 0.5}, .size = cube},
                                                 {.center = {5, 0, 1.5}, .size = cube}});
  Case scene = testing::make_case(0.7, 1e-10, 0.01);
  scene.supports.restraints = {{BlockRef{3}, Vec3(5, 0, 1.5), Vec3::UnitX()}};
  PairTie tie;
  tie.block_a = 1;
  tie.block_b = 2;
  tie.stiffness = 1e6;
  tie.prestress = 100.0;  // N, which friction bears
  scene.ties.pairs = {tie};
  std::vector<Frame> frames;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { frames.push_back(frame); };
  const Summary summary = run_static(scene, assembly, sinks);
  EXPECT_EQ(summary.status, Status::moving) << summary.message;
  ASSERT_EQ(summary.parts.size(), 2u) << summary.message;
  EXPECT_EQ(summary.parts[0].blocks, 2);
  EXPECT_EQ(summary.parts[0].status, Status::stable);
  EXPECT_EQ(summary.parts[1].first_block, 3);
  EXPECT_EQ(summary.parts[1].status, Status::moving);
  ASSERT_EQ(frames.front().ties.size(), 1) << "that of the equilibrium";
  // The joints yield by 1e-5 of the elongation of the tie, 0.1 mm.
  EXPECT_NEAR(frames.front().ties.force[0] / tie.prestress, 1.0, 1e-4);
}

}  // namespace
}  // namespace cupola::restraints_test
