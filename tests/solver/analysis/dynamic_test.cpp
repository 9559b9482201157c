#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/analysis/analysis.hpp"
#include "tests/solver/accounted_simulation.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::dynamic_test {
namespace {

using testing::kG;
using testing::make_case;

/// The last frame and the summary of a dynamic case.
struct RunResult {
  Summary summary;
  Frame last;
  int rows = -1;  // of history.csv without the header
  std::vector<std::string> history;

  /// Cell of history.csv in a step, from 1.
  std::string cell(int step, int column) const {
    std::istringstream row(history.at(static_cast<size_t>(step)));
    std::string text;
    for (int k = 0; k <= column; ++k) std::getline(row, text, ',');
    return text;
  }
};

RunResult run(const Case& scene, const Assembly& assembly) {
  RunResult result;
  AnalysisSinks sinks;
  sinks.frame = [&result](const Frame& frame) { result.last = frame; };
  sinks.history = [&result](const std::string& row) {
    ++result.rows;
    result.history.push_back(row);
  };
  result.summary = run_dynamic(scene, assembly, sinks).value();
  // Rounding of the positions is more than the energies of a structure that only settles.
  constexpr double kAtRest = 1e-6;  // m/s
  if (result.summary.max_speed_m_per_s.value_or(0.0) > kAtRest) {
    EXPECT_LE(result.summary.energy_error.value(), 1e-6);
  }
  return result;
}

// A block released in equilibrium does not move, and its forces stay those of the static analysis. The
// tolerance of 1e-7 allows for the elastic displacement c F = 2e-6 m, which changes the lever arms of 1 m.
TEST(StaticStart, KeepsTheBlockAtRestWithItsStaticForces) {
  const Assembly assembly = testing::box_on_floor({1.0, 0.5, 0.2});
  Case scene = make_case(0.6, 1e-8, 0.01);
  scene.analysis.tolerance = 1e-10;
  scene.analysis.duration = 1.0;
  scene.analysis.start = Analysis::Start::static_;
  scene.loads.gravity = testing::tilted_gravity(0.3);
  const RunResult moved = run(scene, assembly);
  EXPECT_EQ(moved.summary.status, Status::stable) << moved.summary.message;
  EXPECT_LT(moved.summary.max_speed_m_per_s.value(), 1e-9);
  scene.analysis.type = AnalysisType::static_;
  Frame still;
  AnalysisSinks sinks;
  sinks.frame = [&still](const Frame& frame) { still = frame; };
  run_static(scene, assembly, sinks);
  ASSERT_EQ(moved.last.contacts.size(), still.contacts.size());
  const double W = assembly.blocks[1].mass * kG;
  for (int i = 0; i < still.contacts.size(); ++i)
    EXPECT_LT((moved.last.contacts.force[i] - still.contacts.force[i]).norm(), 1e-7 * W);
}

// A beam that jams between two walls under the associated law slides in the static step, and its loaded
// joints open by mu times the slip. After the static start it stays at rest.
TEST(StaticStart, KeepsJointsThatHaveSlidAtRest) {
  const Assembly assembly = testing::make_boxes({{.center = {-1.6, 0, 0}, .size = {1, 1, 3}, .fixed = true},
                                                 {.center = {1.6, 0, 0}, .size = {1, 1, 3}, .fixed = true},
                                                 {.center = {0, 0, 0}, .size = {2.2, 0.5, 0.5}}});
  Case scene = make_case(0.5, 1e-8, 0.01);
  scene.analysis.tolerance = 1e-10;
  scene.analysis.duration = 0.2;
  scene.analysis.start = Analysis::Start::static_;
  const RunResult moved = run(scene, assembly);
  EXPECT_EQ(moved.summary.status, Status::stable) << moved.summary.message;
  // One step of free fall gives 0.1 m/s.
  EXPECT_LT(moved.summary.max_speed_m_per_s.value(), 1e-6);
}

TEST(StaticStart, ReportsThatThereIsNoEquilibrium) {
  Case scene = make_case(0.2, 1e-6, 0.01);
  scene.analysis.start = Analysis::Start::static_;
  scene.loads.gravity = testing::tilted_gravity(0.3);
  const RunResult moved = run(scene, testing::box_on_floor({1.0, 0.5, 0.2}));
  EXPECT_EQ(moved.summary.status, Status::moving);
  EXPECT_NE(moved.summary.message.find("analysis.start: static"), std::string::npos);
  EXPECT_EQ(moved.summary.steps, 1);
}

/// A wall at rest under its weight, solved by a first-order method with a limit of iterations.
RunResult run_limited(int max_iterations, double duration) {
  Case scene = make_case(0.4, 1e-8, 0.01);
  scene.analysis.method = ContactMethod::spg;
  scene.analysis.tolerance = 1e-8;
  scene.analysis.max_iterations = max_iterations;
  scene.analysis.duration = duration;
  return run(scene, testing::running_bond_wall({1.0, 0.5, 0.5}, 3, 3));
}

// A dual method satisfies the momentum balance to rounding: the message names what was missed instead.
TEST(Accuracy, NamesTheMeasureThatWasMissed) {
  const Summary s = run_limited(5, 0.05).summary;
  EXPECT_EQ(s.status, Status::unconverged);
  EXPECT_EQ(s.message.find("5 of 5 steps missed the tolerance 1.0e-08 of the force error bound"), 0u)
      << s.message;
  EXPECT_EQ(s.message.find("momentum"), std::string::npos);
  EXPECT_NE(s.message.find("violates the contact law by"), std::string::npos) << s.message;
  EXPECT_EQ(s.accuracy.quantity, "contact forces of a step");
  EXPECT_GT(s.accuracy.worst_over_run, s.accuracy.asked);
  EXPECT_LE(s.momentum_residual.value(), 1e-12);
  EXPECT_GT(s.contact_law_residual.value(), 1e-3);
  ASSERT_TRUE(s.largest_law_violation);
  EXPECT_GT(s.largest_law_violation->value, 1e-3);
  EXPECT_GT(s.largest_law_violation->block_b, s.largest_law_violation->block_a);
}

// The first steps are missed and the last ones are not: residuals and bound are those of the worst step.
TEST(Accuracy, IsTheWorstOfTheRun) {
  const RunResult run =
      run_limited(80, 3.0);  // with 70 to 100 iterations late steps converge and early ones do not
  const Summary& s = run.summary;
  EXPECT_EQ(s.status, Status::unconverged) << s.message;
  EXPECT_LE(s.accuracy.reached, s.accuracy.asked) << "the last step converged";
  EXPECT_GT(s.accuracy.worst_over_run, s.accuracy.asked);
  double in_last = 0.0;
  for (const double violation : run.last.contacts.law_violation) in_last = std::max(in_last, violation);
  EXPECT_GT(s.largest_law_violation.value().value, 10.0 * in_last);
  EXPECT_GT(s.certified_force_error.value.value(), s.accuracy.asked);
  EXPECT_LT(s.largest_law_violation->time, 1.0) << "the worst step is an early one";
  // The steps of the worst numbers are those in which the history has them.
  const WorstSteps& worst = s.worst_steps.value();
  EXPECT_EQ(run.cell(worst.momentum_residual.value().step, 3), fmt::format("{:.6e}", *s.momentum_residual));
  EXPECT_EQ(run.cell(worst.contact_law_residual.value().step, 4),
            fmt::format("{:.6e}", *s.contact_law_residual));
  EXPECT_EQ(std::stod(run.cell(worst.contact_law_residual->step, 0)), worst.contact_law_residual->time);
  EXPECT_LT(worst.certified_force_error.value().step, s.steps);
}

// A block that falls by 0.1 m: with steps of no less than 20 ms the impact misses 1 um, with short ones it
// does not.
TEST(Accuracy, SaysThatTheTimeErrorWasMissed) {
  const Assembly assembly = testing::make_boxes(
      {{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true}, {.center = {0, 0, 0.6}}});
  for (const double smallest : {0.02, 1e-7}) {
    Case scene = make_case(0.4, 1e-8, 0.02);
    scene.analysis.duration = 0.3;
    scene.analysis.time_error = 1e-6;
    scene.analysis.adaptive = AdaptiveStep{.smallest = smallest, .largest = 0.02, .displacement_error = 1e-6};
    const Summary s = run(scene, assembly).summary;
    const bool missed = smallest > 1e-3;
    EXPECT_EQ(s.status == Status::unconverged, missed) << s.message;
    EXPECT_EQ(s.message.find("missed `analysis.time_error`, 1.0e-06 m") != std::string::npos, missed)
        << s.message;
  }
}

// A block in free flight has no contact forces: its steps do not spoil what is certified of the others.
TEST(Accuracy, IgnoresStepsWithoutLoadedContacts) {
  Case scene = make_case(0.4, 1e-8, 0.01);
  scene.analysis.tolerance = 1e-9;
  scene.analysis.duration = 0.5;
  const Summary s =
      run(scene, testing::make_boxes(
                     {{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true}, {.center = {0, 0, 0.6}}}))
          .summary;
  EXPECT_LE(s.accuracy.worst_over_run, 1e-9) << s.message;
  EXPECT_LE(s.certified_force_error.value.value(), 1e-6);
  EXPECT_TRUE(s.forces_unique.value);
}

// A dead load applied suddenly compresses a spring to twice its static penetration; applied slowly, to the
// static one.
TEST(Ramp, AppliesTheDeadLoadWithoutOvershoot) {
  const Assembly assembly = testing::box_on_floor({1, 1, 1});
  const double depth = 1000.0 * kG * 1e-6 / 4.0;
  for (const bool ramped : {false, true}) {
    Case scene = make_case(0.4, 1e-6, 1e-4);
    scene.analysis.tolerance = 1e-9;
    if (ramped) scene.loads.dead_load_time = RampInTime{.from = 0, .to = 1, .start = 0, .duration = 0.5};
    testing::AccountedSimulation simulation(scene, assembly);
    double deepest = 0.0;
    while (simulation.state().time < 0.6) {
      simulation.advance();
      deepest = std::max(deepest, 0.5 - simulation.state().poses[1].p_WB.z());
    }
    // Numerical damping reduces the first oscillation by w h / 2 per radian.
    EXPECT_NEAR(deepest / depth, ramped ? 1.0 : 2.0, 0.02);
  }
}

TEST(AdaptiveStep, TakesFewStepsAndEndsOnTheTimesOfFrames) {
  const Assembly assembly = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {20, 20, 1}, .fixed = true},
                                                 {.center = {0, 0, 0.9}, .size = {1, 1, 1}}});
  Case scene = make_case(0.4, 1e-10, 0.001);
  scene.analysis.tolerance = 1e-9;
  scene.analysis.duration = 2.0;
  scene.output.frames_every = 0.25;
  scene.analysis.adaptive = AdaptiveStep{.smallest = 1e-5, .largest = 0.1, .displacement_error = 1e-3};
  std::vector<double> times;
  AnalysisSinks sinks;
  sinks.frame = [&times](const Frame& frame) { times.push_back(frame.time); };
  const Summary summary = run_dynamic(scene, assembly, sinks).value();
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  ASSERT_EQ(times.size(), 8u);
  for (size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(times[i], 0.25 * (static_cast<double>(i) + 1), 1e-9);
  EXPECT_LT(summary.steps, 400) << "2,000 steps of constant length";
}

// 0.3 s does not divide 1 s, nor 0.5 s; 0.1 s does, up to rounding.
// A blow of 1 MN for 6 ms (from half to half of its flanks) on a cube at rest, whose steps are now 50 ms:
// v = 6 m/s less mu g (7 ms), then v^2 / (2 mu g).
TEST(AdaptiveStep, SeesShortLoads) {
  Case scene = make_case(0.5, 0.0, 0.01);
  scene.analysis.tolerance = 1e-9;
  scene.analysis.friction_law = FrictionLaw::coulomb;
  scene.analysis.duration = 3.0;
  scene.analysis.time_error = 1e-4;
  scene.analysis.adaptive.emplace();
  scene.loads.forces.push_back(
      {BlockRef{1}, {}, {1e6, 0, 0}, TableInTime{"", {1.0, 1.001, 1.006, 1.007}, {0.0, 1.0, 1.0, 0.0}}});
  const Summary s = run(scene, testing::box_on_floor({1, 1, 1})).summary;
  const double mu_g = 0.5 * kG, v = 6.0 - mu_g * 7e-3;
  EXPECT_NEAR(s.max_displacement_m.value(), 0.5 * v * v / mu_g, 0.03)
      << "5 mm each of the blow and of the last step";
}

// A static start finds the joints as built, and the block follows its floor, which has moved by more than the
// margin within which faces make a joint.
TEST(StaticStart, FollowsSupportsThatHaveMoved) {
  Case scene = make_case(0.5, 1e-8, 0.01);
  scene.analysis.start = Analysis::Start::static_;
  scene.analysis.duration = 0.2;
  scene.supports.moves = {{.region = {}, .displacement = {0.3, 0, -0.05}, .time = {}}};
  const RunResult result = run(scene, testing::box_on_floor({1, 1, 1}));
  EXPECT_EQ(result.summary.status, Status::stable) << result.summary.message;
  EXPECT_LT((result.last.blocks.displacement[1] - Vec3(0.3, 0, -0.05)).norm(), 1e-4)
      << "the joint yields by W c / 4 = 2.5e-5 m";
}

TEST(FixedSteps, CoverTheDurationAndTheTimesOfFrames) {
  const Assembly assembly = testing::box_on_floor({1, 1, 1});
  const auto frame_times = [&](double h) {
    Case scene = make_case(0.4, 1e-8, h);
    scene.analysis.duration = 1.0;
    scene.output.frames_every = 0.5;
    std::vector<double> times;
    AnalysisSinks sinks;
    sinks.frame = [&times](const Frame& frame) { times.push_back(frame.time); };
    run_dynamic(scene, assembly, sinks);
    return times;
  };
  const auto expect_times = [](const std::vector<double>& times, const std::vector<double>& expected) {
    ASSERT_EQ(times.size(), expected.size());
    for (size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(times[i], expected[i], 1e-12);
  };
  expect_times(frame_times(0.3), {0.6, 1.2});
  expect_times(frame_times(0.1), {0.5, 1.0});
}

// The ground gains 0.375 m/s within a second and keeps it, so that it moves by almost a metre. The block rides
// on it by friction: seen from the ground, it hardly moves and comes to rest.
TEST(BaseMotion, CountsMotionFromTheGround) {
  const std::string path = ::testing::TempDir() + "/ground.csv";
  std::ofstream(path) << "0, 0\n0.25, 0.5\n0.75, 0.5\n1, 0\n";
  const Assembly assembly = testing::box_on_floor({1, 1, 1});
  Case scene = make_case(0.6, 1e-10, 0.005);
  scene.analysis.duration = 3.0;
  scene.supports.base_motion = BaseMotion{path, BaseMotion::Quantity::acceleration, Vec3::UnitX()};
  scene.analysis.start = Analysis::Start::static_;
  const RunResult result = run(scene, assembly);
  EXPECT_EQ(result.summary.status, Status::stable) << result.summary.message;
  // 4 N of horizontal force per kg m/s2 on springs of 1e-10 m/N shift it by less than a micrometre.
  EXPECT_LT(*result.summary.max_displacement_m, 1e-6);
  EXPECT_LT(*result.summary.max_speed_m_per_s, 1e-6);
  EXPECT_NEAR(result.last.blocks.position[1].x(), 0.1875 + 2.0 * 0.375, 1e-6);
  for (const Vec3& displacement : result.last.blocks.displacement) EXPECT_LT(displacement.norm(), 1e-6);
}

// A cube of 1000 kg falls by 0.1 m on four points of 1e-8 m/N. A corner alone meets 250 kg: its time of impact
// is sqrt(m c) = 1.6 ms.
// Ground that stays where it is, at 0.6 m by its record, moves no block.
TEST(BaseMotion, CountsFromTheGroundAtTheStart) {
  const std::string path = ::testing::TempDir() + "/still.csv";
  std::ofstream(path) << "0, 0.6\n1, 0.6\n";
  for (const auto start : {Analysis::Start::rest, Analysis::Start::static_}) {
    Case scene = make_case(0.5, 1e-8, 0.01);
    scene.analysis.start = start;
    scene.analysis.duration = 0.5;
    scene.supports.base_motion = BaseMotion{path, BaseMotion::Quantity::displacement, Vec3::UnitX()};
    const Summary s = run(scene, testing::box_on_floor({1, 1, 1})).summary;
    EXPECT_EQ(s.status, Status::stable) << s.message;
    EXPECT_LT(s.max_displacement_m.value(), 6e-5) << "twice the weight of 9810 N on four springs of 1e-8 m/N";
  }
}

TEST(Impact, IsElasticOnlyIfStepsResolveItUndamped) {
  const Assembly assembly = testing::make_boxes(
      {{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true}, {.center = {0, 0, 0.6}}});
  struct Fall {
    double h, damping;  // s
    bool bounces;
  };
  for (const Fall& fall :
       {Fall{1e-2, 0.0, false}, {2e-4, 0.0, true}, {2e-4, 4e-3, false}, {2e-4, 2e-2, false}}) {
    SCOPED_TRACE(fmt::format("h = {} s, alpha = {} s", fall.h, fall.damping));
    Case scene = make_case(0.4, 1e-8, fall.h, fall.damping);
    scene.analysis.duration = 0.3;
    scene.analysis.tolerance = 1e-9;
    Simulation simulation = testing::simulate(scene, assembly);
    double upward = 0.0;
    while (simulation.state().time < 0.3) {
      simulation.advance();
      upward = std::max(upward, simulation.state().v[2]);
    }
    const double speed = std::sqrt(2.0 * kG * 0.1);
    EXPECT_EQ(upward > 0.8 * speed, fall.bounces)
        << upward;  // exp(- pi w h / 2) of implicit Euler, w = 632 1/s
    EXPECT_EQ(upward > 0.1 * speed, fall.bounces) << upward;
    const Summary s = run(scene, assembly).summary;
    ASSERT_EQ(!s.warnings.empty(), fall.bounces);
    if (fall.bounces) {
      EXPECT_NE(s.warnings[0].find("`analysis.damping: 3.2e-03`"), std::string::npos) << s.warnings[0];
    }
  }
}

// Faces that meet in the first half of a step, at whose middle the method finds contacts, or in the second.
TEST(Impact, IsElasticWhereverInAStepOfGeneralizedAlphaItIs) {
  constexpr double kStep = 2e-4, kGap = 0.1;
  const double way = kStep * std::sqrt(2.0 * kG * kGap);  // m, of the step of the impact
  for (const double part : {0.0, 0.25, 0.5, 0.75}) {
    SCOPED_TRACE(part);
    Case scene = make_case(0.4, 1e-8, kStep);
    scene.analysis.duration = 0.2;
    scene.analysis.tolerance = 1e-9;
    scene.analysis.integrator = TimeIntegrator::generalized_alpha;
    const Summary s =
        run(scene, testing::make_boxes({{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true},
                                        {.center = {0, 0, 0.5 + kGap + part * way}}}))
            .summary;
    ASSERT_EQ(s.warnings.size(), 1U);
    EXPECT_NE(s.warnings[0].find("bounced"), std::string::npos) << s.warnings[0];
  }
}

// A cube of 0.3 m falls by 20 m onto a plate 0.1 m thick: at 20 m/s, 2 m in a fixed step.
TEST(FastBlocks, StopAtAPlateOrAWarningSaysSo) {
  const Assembly assembly =
      testing::make_boxes({{.center = {0, 0, -0.05}, .size = {4, 4, 0.1}, .fixed = true},
                           {.center = {0, 0, 20.15}, .size = Vec3::Constant(0.3)}});
  Case scene = make_case(0.5, 1e-12, 0.1);
  scene.analysis.tolerance = 1e-9;
  scene.analysis.duration = 2.2;
  scene.analysis.thresholds.displacement = 100.0;
  const Summary fixed = run(scene, assembly).summary;
  EXPECT_GT(fixed.final_displacement_m.value(), 22.0) << "through the plate";
  ASSERT_FALSE(fixed.warnings.empty());
  EXPECT_EQ(fixed.warnings[0].find("block 1 may have passed through block 0: in the step up to 2 s"), 0U)
      << fixed.warnings[0];
  scene.analysis.integrator = TimeIntegrator::generalized_alpha;
  scene.analysis.adaptive = AdaptiveStep{.displacement_error = 1e-3};
  const Summary adapted = run(scene, assembly).summary;
  EXPECT_LT(adapted.max_displacement_m.value(), 20.05) << "it may enter the plate in the step of the impact";
  EXPECT_TRUE(adapted.warnings.empty() || adapted.warnings[0].find("passed through") == std::string::npos);
}

TEST(StopRules, EndTheAnalysisWhenSettledOrCollapsed) {
  const Assembly assembly = testing::box_on_floor({1, 1, 1});
  Case scene = make_case(0.4, 1e-8, 0.01);
  scene.analysis.tolerance = 1e-9;
  scene.analysis.stop.settled_time = 0.2;
  const RunResult settled = run(scene, assembly);
  EXPECT_EQ(settled.summary.status, Status::stable);
  EXPECT_LT(settled.last.time, 1.0);
  EXPECT_NE(settled.summary.message.find("settled"), std::string::npos);
  EXPECT_EQ(settled.rows, settled.summary.steps);

  scene.loads.gravity = testing::tilted_gravity(1.0);
  scene.analysis.stop.collapsed = true;
  const RunResult fallen = run(scene, assembly);
  EXPECT_EQ(fallen.summary.status, Status::collapsed);
  EXPECT_LT(fallen.last.time, 1.0);
}

// Pressure and traction on the upper faces of a wall are balanced by the support reaction.
TEST(FaceLoads, AreBalancedByTheSupports) {
  Assembly wall = testing::running_bond_wall({1.0, 0.5, 0.3}, 3, 2);
  for (const Part& part : wall.parts)
    if (part.ring == 1) wall.face_kinds[part.face_start + 1] = FaceKind::top;
  Case scene = make_case(0.6, 1e-9, 1.0);
  scene.analysis.type = AnalysisType::static_;
  scene.analysis.tolerance = 1e-9;
  scene.loads.faces = {{.faces = FaceKind::top, .traction = Vec3(100, 0, 0), .pressure = 2000, .time = {}}};
  const Summary summary = run_static(scene, wall, {});
  const double area = 3.0 * 0.5;
  EXPECT_NEAR(summary.support_reaction_N.z(), summary.weight_N + 2000 * area, 1e-6 * summary.weight_N);
  EXPECT_NEAR(summary.support_reaction_N.x(), -100 * area, 1e-6 * summary.weight_N);
}

}  // namespace
}  // namespace cupola::dynamic_test
