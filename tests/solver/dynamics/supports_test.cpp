#include "solver/dynamics/supports.hpp"

#include <algorithm>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/files/time_table.hpp"
#include "assembly/model/smooth_motion.hpp"
#include "tests/solver/accounted_simulation.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::supports_test {
namespace {

using testing::kG;
using testing::make_case;

/// All fixed blocks move by `displacement` (m) within `duration` (s).
SupportMove move_supports(const Vec3& displacement, double duration) {
  SupportMove move;
  move.displacement = displacement;
  move.time = RampInTime{.from = 0.0, .to = 1.0, .start = 0.0, .duration = duration};
  return move;
}

// A plate starts to move at speed V under a block. Friction accelerates the block by mu g until both move
// together.
TEST(MovingSupport, DragsABlockByFriction) {
  const Assembly assembly = testing::box_on_floor({1.0, 1.0, 0.2});
  const double h = 1e-3, mu = 0.3, V = 1.0;
  Case scene = make_case(mu, 1e-14, h);
  scene.supports.moves = {move_supports({V, 0, 0}, 1.0)};
  testing::AccountedSimulation simulation(scene, assembly);
  for (int step = 0; step < 200; ++step) simulation.advance();
  // Under the associated law sliding dilates: the block gains an upward velocity mu V in the first step, and
  // the impulse that causes it adds friction once.
  EXPECT_NEAR(simulation.state().v[0], mu * kG * 0.2, mu * mu * V + 1e-3);
  for (int step = 200; step < 900; ++step) simulation.advance();
  EXPECT_NEAR(simulation.state().v[0], V, 1e-6);
  EXPECT_NEAR(simulation.state().poses[0].p_WB.x(), 0.9 * V, 1e-9);
}

// A lift: the block rises with its support, and the reaction is m (g + a) while the support accelerates.
TEST(MovingSupport, LiftsABlockWithTheReactionOfItsAcceleration) {
  const Assembly assembly = testing::box_on_floor({1.0, 1.0, 1.0});
  const double h = 1e-3, a = 2.0;
  Case scene = make_case(0.3, 1e-12, h);
  SupportMove move;
  move.displacement = Vec3(0, 0, 1);
  TableInTime table;  // a t^2 / 2 on a fine grid
  for (int i = 0; i <= 1000; ++i) {
    table.times.push_back(i * h);
    table.values.push_back(0.5 * a * i * h * i * h);
  }
  move.time = table;
  scene.supports.moves = {move};
  testing::AccountedSimulation simulation(scene, assembly);
  StepReport report;
  for (int step = 0; step < 500; ++step) report = simulation.advance();
  EXPECT_NEAR(simulation.state().poses[1].p_WB.z(), 0.5 + 0.5 * a * 0.25, 1e-6);
  EXPECT_NEAR(report.balance.support_reaction.z() / (1000.0 * (kG + a)), 1.0, 1e-6);
}

// A floor rotates slowly by 30 degrees about y. A sticking block rotates with it like a rigid body.
TEST(MovingSupport, RotatesAStickingBlock) {
  const Assembly assembly = testing::box_on_floor({1.0, 1.0, 0.2});
  Case scene = make_case(2.0, 1e-10, 1e-2, 0.01);
  SupportMove move;
  move.rotation_deg = Vec3(0, 30, 0);
  move.pivot = Vec3(-5, 0, 0);
  TableInTime table;
  for (int i = 0; i <= 400; ++i) {
    table.times.push_back(0.01 * i);
    table.values.push_back(0.5 * (1.0 - std::cos(std::numbers::pi * i / 400)));
  }
  move.time = table;
  scene.supports.moves = {move};
  testing::AccountedSimulation simulation(scene, assembly);
  for (int step = 0; step < 500; ++step) simulation.advance();
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(std::numbers::pi / 6, Vec3::UnitY()));
  const Vec3 expected = move.pivot + turn * (Vec3(0, 0, 0.1) - move.pivot);
  // Each step of at most 5 mm deviates from the arc by its sagitta, 5e-3^2 / (2 * 5) m; there are 400 steps.
  EXPECT_LT((simulation.state().poses[1].p_WB - expected).norm(), 1e-3);
  EXPECT_LT(simulation.state().poses[1].q_WB.angularDistance(turn), 1e-3);
  EXPECT_LT(simulation.state().v.norm(), 1e-6);
}

// Rotations turn a support about its pivot as built, so that the moves of a support add up in any order.
TEST(MovingSupport, AddsUpMovesWithoutTurningTheDisplacements) {
  const Assembly assembly = testing::box_on_floor({1.0, 1.0, 1.0});
  Case scene;
  SupportMove turn, away = move_supports({0.5, 0, 0}, 1.0);
  turn.rotation_deg = Vec3(0, 30, 0);
  turn.pivot = Vec3(-1, 0, -0.5);
  const Vec3 expected = Vec3(-1 + std::cos(std::numbers::pi / 6) + 0.5, 0, -0.5 - 0.5);
  for (const auto& moves : {std::vector{away, turn}, std::vector{turn, away}}) {
    scene.supports.moves = moves;
    std::vector<Pose> poses(2);
    place_supports(assembly, make_support_motions(scene, assembly), 1.0, &poses);
    EXPECT_LT((poses[0].p_WB - expected).norm(), 1e-15) << "rounding";
  }
}

// A rigid wall advances by 10 mm a step towards a block 25 mm away, on a smooth floor, and pushes it along.
// Contacts are looked for within 2 mm, and farther by what the blocks move.
TEST(MovingSupport, MeetsABlockThatItReachesWithinAStep) {
  const Assembly assembly =
      testing::make_boxes({{.center = {0, 0, -0.5}, .size = {9, 9, 1}, .fixed = true},
                           {.center = {-0.525, 0, 0.2}, .size = {0.8, 0.8, 0.4}, .fixed = true},
                           {.center = {0, 0, 0.1}, .size = {0.2, 0.2, 0.2}}});
  Case scene = make_case(0.0, 0.0, 0.02);
  scene.analysis.tolerance = 1e-9;
  scene.supports.moves = {move_supports({0.5, 0, 0}, 1.0)};
  scene.supports.moves[0].region.blocks = {BlockRef{1}};
  testing::AccountedSimulation simulation(scene, assembly);
  for (int step = 0; step < 50; ++step) simulation.advance();
  EXPECT_NEAR(simulation.state().poses[2].p_WB.x(), 0.5 - 0.025, 1e-9);
  EXPECT_NEAR(simulation.state().v[0], 0.5, 1e-9);
}

TEST(BaseMotion, ReadsDisplacementsAndIntegratesAccelerations) {
  const std::string path = ::testing::TempDir() + "/motion.csv";
  std::ofstream(path) << "# time, value\n0 , 0\n0.5, 1.5\n1\t3\n";
  const TableInTime table = read_time_table(path);
  ASSERT_EQ(table.times.size(), 3u);
  EXPECT_DOUBLE_EQ(factor_at(TimeFunction(table), 0.75), 2.25);
  EXPECT_DOUBLE_EQ(factor_at(TimeFunction(table), 9.0), 3.0);
  // a(t) = 3 t: d = t^3 / 2, at the points of the table and between them.
  const TimeFunction displacement = integrate_twice(table);
  for (const double t : {0.0, 0.25, 0.5, 0.7, 1.0})
    EXPECT_NEAR(factor_at(displacement, t), 0.5 * t * t * t, 1e-15) << t << " s";
  EXPECT_DOUBLE_EQ(factor_at(displacement, 2.0), 0.5 + 1.5) << "on at 1.5 m/s after the end of the record";
}

// A lift whose accelerometer has four samples a second. Its velocity does not jump at the samples, so that the
// reaction never exceeds m (g + a).
TEST(BaseMotion, CoarseAccelerogramGivesNoJolts) {
  const std::string path = ::testing::TempDir() + "/lift.csv";
  std::ofstream(path) << "0, 0\n0.25, 2\n0.5, 2\n0.75, 0\n";
  const Assembly assembly = testing::box_on_floor({1.0, 1.0, 1.0});
  const double a = 2.0, h = 1e-3;
  Case scene = make_case(0.3, 1e-12, h);
  scene.supports.base_motion = BaseMotion{path, BaseMotion::Quantity::acceleration, Vec3::UnitZ()};
  testing::AccountedSimulation simulation(scene, assembly);
  double largest = 0.0;
  for (int step = 0; step < 700; ++step)
    largest = std::max(largest, simulation.advance().balance.support_reaction.z());
  EXPECT_NEAR(largest / (1000.0 * (kG + a)), 1.0, 1e-6);
}

// x = 3 t^2 - 2 t^3 is at rest at 0 and 1 s, where the record waits before and after.
TEST(BaseMotion, InterpolatesDisplacementsByACubicSpline) {
  const auto exact = [](double t) { return t * t * (3.0 - 2.0 * t); };
  TableInTime table;
  table.times = {-2.0, -1.0, 0.0, 0.2, 0.3, 0.7, 1.0, 1.5, 3.0};
  for (const double t : table.times) table.values.push_back(exact(std::clamp(t, 0.0, 1.0)));
  const TimeFunction motion = interpolate_smoothly(table);
  for (const double t : {-3.0, -0.5, 0.0, 0.1, 0.25, 0.5, 0.9, 1.0, 1.2, 4.0})
    EXPECT_NEAR(factor_at(motion, t), exact(std::clamp(t, 0.0, 1.0)), 1e-15) << "rounding, " << t << " s";
  EXPECT_DOUBLE_EQ(last_change(motion), 1.0);
  // There and back, with a rest between.
  const TimeFunction jerks =
      interpolate_smoothly({.file = "", .times = {0.0, 0.1, 0.5, 0.6}, .values = {0.0, 0.2, 0.2, 0.0}});
  for (const double t : {0.1, 0.101, 0.3, 0.499, 0.5}) EXPECT_NEAR(factor_at(jerks, t), 0.2, 1e-15) << t;
  EXPECT_NEAR(factor_at(jerks, 0.05), 0.1, 1e-15);
  EXPECT_NEAR(factor_at(jerks, 0.55), 0.1, 1e-15);
}

// A lift that rises and returns in a second, by twenty displacements. The acceleration of the spline errs by
// (w dt)^2 / 12 = 0.8 %.
TEST(BaseMotion, CoarseDisplacementsGiveNoJolts) {
  const std::string path = ::testing::TempDir() + "/lift_displacements.csv";
  const double w = 2.0 * std::numbers::pi, rise = 0.05, a = rise * w * w;
  std::ofstream file(path);
  for (int i = 0; i <= 20; ++i) file << 0.05 * i << ", " << rise * (1.0 - std::cos(w * 0.05 * i)) << "\n";
  file.close();
  const Assembly assembly = testing::box_on_floor({1.0, 1.0, 1.0});
  Case scene = make_case(0.3, 1e-12, 1e-3);
  scene.supports.base_motion = BaseMotion{path, BaseMotion::Quantity::displacement, Vec3::UnitZ()};
  testing::AccountedSimulation simulation(scene, assembly);
  double largest = 0.0;
  for (int step = 0; step < 1200; ++step)
    largest = std::max(largest, simulation.advance().balance.support_reaction.z());
  EXPECT_NEAR(largest / (1000.0 * kG) - 1.0, a / kG, 0.01 * a / kG);
}

// The ground accelerates steadily. However long the steps, the block on it needs the friction m a; the first
// step starts from rest.
TEST(BaseMotion, StepsOfOtherLengthsGiveNoJolts) {
  const std::string path = ::testing::TempDir() + "/steady.csv";
  std::ofstream(path) << "0, 2\n10, 2\n";
  const Assembly assembly = testing::box_on_floor({1.0, 1.0, 0.2});
  Case scene = make_case(0.8, 1e-12, 0.01);
  scene.supports.base_motion = BaseMotion{path, BaseMotion::Quantity::acceleration, Vec3::UnitX()};
  testing::AccountedSimulation simulation(scene, assembly);
  simulation.advance();
  for (const double h : {0.01, 1e-4, 2e-4, 0.01, 1e-3, 1e-4, 0.01}) {
    const double friction = simulation.advance(h).balance.support_reaction.x();
    EXPECT_NEAR(friction / (200.0 * 2.0), 1.0, 1e-4) << "its springs swing, a step of " << h << " s";
  }
}

TEST(BaseMotion, ErrorsStateLineAndRule) {
  const std::string path = ::testing::TempDir() + "/motion.csv";
  const auto message = [&](const char* text) {
    std::ofstream(path) << text;
    try {
      read_time_table(path);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message("0 0\n1 x\n").find(":2:1: "), std::string::npos);
  EXPECT_NE(message("0 0\n1 1 1\n").find("two numbers"), std::string::npos);
  EXPECT_NE(message("0 0\n0 1\n").find("times must increase"), std::string::npos);
  EXPECT_NE(message("0 nan\n").find(":1:1: "), std::string::npos);
  EXPECT_NE(message("# nothing\n").find("no rows"), std::string::npos);
  EXPECT_THROW(read_time_table(path + ".absent"), InputError);
}

TEST(MovingSupport, RejectsFreeOrMissingBlocks) {
  const Assembly assembly = testing::box_on_floor({1, 1, 1});
  Case scene;
  scene.supports.moves = {SupportMove{}};
  scene.supports.moves[0].region.blocks = {1};
  EXPECT_THROW(make_support_motions(scene, assembly), InputError);
  scene.supports.moves[0].region.blocks = {2};
  EXPECT_THROW(make_support_motions(scene, assembly), InputError);
}

}  // namespace
}  // namespace cupola::supports_test
