// `--explain` builds the same objects as the run: the first steps are equal, and what the run refuses is
// refused.

#include "solver/explain.hpp"

#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/analysis_table.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::explain_test {
namespace {

/// A wall under inclined gravity, whose blocks slide on each other.
Case moving_wall() {
  Case scene = testing::make_case(0.2, 1e-8, 0.005);
  scene.analysis.tolerance = 1e-9;
  scene.analysis.duration = 0.1;
  scene.output.frames_every = 0.1;  // the run drops its factor at every frame, the estimate does not
  scene.loads.gravity = testing::tilted_gravity(0.1);
  return scene;
}

using Steps = std::vector<std::pair<double, int>>;  // time step (s) and iterations of each step

/// The first three steps of the run, from history.csv.
Steps run_steps(const Case& scene, const Assembly& assembly) {
  Steps steps;
  AnalysisSinks sinks;
  sinks.history = [&, header = true](const std::string& row) mutable {
    if (std::exchange(header, false) || steps.size() == 3) return;
    std::vector<std::string> cells;
    std::istringstream in(row);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    steps.emplace_back(std::stod(cells.at(24)), std::stoi(cells.at(2)));
  };
  run_analysis(scene, assembly, sinks);
  return steps;
}

Steps timed_steps(const Case& scene, const Assembly& assembly) {
  Steps steps;
  for (const TimedStep& step : explain_model(scene, assembly).cost.steps)
    steps.emplace_back(step.h, step.iterations);
  return steps;
}

// Every option changes the first steps, so that an estimate that forgets it fails.
TEST(ExplainMotion, TimesTheFirstStepsOfTheRun) {
  const Assembly wall = testing::running_bond_wall({0.6, 0.3, 0.3}, 3, 4);
  const Case plain = moving_wall();
  Case adaptive = plain;
  adaptive.analysis.adaptive = AdaptiveStep{.smallest = 1e-6, .largest = 0.05, .displacement_error = 1e-6};
  Case sleeping = plain;
  sleeping.analysis.sleep = Sleep{.speed = 100.0, .time = 1e-4};
  Case from_equilibrium = plain;
  from_equilibrium.analysis.start = Analysis::Start::static_;
  const Steps steps = timed_steps(plain, wall);
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(steps, run_steps(plain, wall));
  for (const auto& [name, scene] : std::initializer_list<std::pair<const char*, const Case*>>{
           {"adaptive", &adaptive}, {"sleep", &sleeping}, {"static start", &from_equilibrium}}) {
    const Steps timed = timed_steps(*scene, wall);
    EXPECT_EQ(timed, run_steps(*scene, wall)) << name;
    EXPECT_NE(timed, steps) << name;
  }
}

// The generator prints the convex parts of the blocks, without those of supports.
TEST(ExplainModel, CountsThePartsOfTheBlocks) {
  const Assembly wall = testing::running_bond_wall({0.6, 0.3, 0.3}, 2, 2);
  const auto of_supports = std::count_if(wall.parts.begin(), wall.parts.end(), [&](const Part& part) {
    return wall.blocks[static_cast<size_t>(part.block)].kind == BlockKind::support;
  });
  ASSERT_GT(of_supports, 0);
  Case scene = moving_wall();
  EXPECT_EQ(explain_model(scene, wall).counts.parts, static_cast<int>(wall.parts.size()) - of_supports);
}

TEST(ExplainModel, NamesItsOptions) {
  const Assembly wall = testing::running_bond_wall({0.6, 0.3, 0.3}, 2, 2);
  const auto expect_phrase = [&](const Case& scene, const std::string& phrase) {
    const std::string text = explain_model(scene, wall).text;
    EXPECT_NE(text.find(phrase), std::string::npos) << phrase << "\n" << text;
  };
  Case scene = moving_wall();
  scene.analysis.adaptive = AdaptiveStep{.smallest = 1e-5, .largest = 0.05, .displacement_error = 1e-4};
  expect_phrase(scene, "step        adaptive, 1e-05 to 0.05 s");
  scene = moving_wall();
  scene.analysis.time_step = 0.03;
  expect_phrase(scene, "4 steps of 0.03 s");
  scene = moving_wall();
  scene.analysis.sleep = Sleep{.speed = 1e-3, .time = 0.2};
  expect_phrase(scene, "sleep       islands slower than 0.001 m/s for 0.2 s");
  scene = moving_wall();
  scene.analysis.start = Analysis::Start::static_;
  expect_phrase(scene, "start       static equilibrium");
  expect_phrase(scene, "(static start, ");
  scene = moving_wall();
  scene.analysis.type = AnalysisType::range;
  scene.analysis.cyclic_sectors = 2;
  expect_phrase(scene, "sectors     one of 2 is solved for quantities that repeat around the axis");
}

// Coulomb's law costs the associated solve and about as many iterations again.
TEST(ExplainStatic, SaysWhatCoulombsLawCosts) {
  const Assembly wall = testing::running_bond_wall({0.6, 0.3, 0.3}, 2, 2);
  Case scene = moving_wall();
  scene.analysis.type = AnalysisType::static_;
  const std::string phrase = "the associated problem is solved first";
  EXPECT_EQ(explain_model(scene, wall).text.find(phrase), std::string::npos);
  scene.analysis.friction_law = FrictionLaw::coulomb;
  const std::string text = explain_model(scene, wall).text;
  EXPECT_NE(text.find(phrase), std::string::npos) << text;
}

// Joints that slide under Coulomb's law take tens of times the iterations of the first static solve, so that
// a path is estimated from equilibria of its own: time 0 and two steps, which stand for all others.
TEST(ExplainPath, TimesItsFirstEquilibria) {
  const Assembly wall = testing::running_bond_wall({0.6, 0.3, 0.3}, 2, 2);
  Case scene = moving_wall();
  scene.analysis.type = AnalysisType::path;
  scene.analysis.friction_law = FrictionLaw::coulomb;
  SupportMove move;
  move.displacement = Vec3(1e-3, 0, 0);
  move.time = RampInTime{.from = 0.0, .to = 1.0, .start = 0.0, .duration = 1.0};
  scene.supports.moves = {move};
  const auto cost_of = [&](int steps) {
    scene.analysis.path.steps = steps;
    return explain_model(scene, wall).cost;
  };
  EXPECT_EQ(cost_of(1).basis.find("2 equilibria, "), 0u) << cost_of(1).basis;
  const CostEstimate few = cost_of(10), many = cost_of(1000);
  EXPECT_EQ(few.basis.find("3 equilibria, "), 0u) << few.basis;
  EXPECT_GT(many.seconds, 10.0 * few.seconds) << "a hundred times as many steps";
  EXPECT_EQ(many.left_out, "");
}

// Two abutments of two courses beside each other (rings 0, 1 and 2, 3) under an arch of five stones (4 to 8),
// which is laid from both springings: solved are 1, 2, 2, 2, 4, 4 and 3 of the nine blocks, because each
// abutment keeps its upper course below the springers.
TEST(ExplainStaged, CountsTheBlocksThatStagesSolveOfEveryMember) {
  Assembly bridge;
  bridge.num_rings = 9;
  bridge.sheets = {
      {.name = "abutment", .num_rings = 2},
      {.name = "abutment", .first_ring = 2, .num_rings = 2},
      {.name = "arch", .first_ring = 4, .num_rings = 5, .thrust_lines = Sheet::ThrustLines::one}};
  for (int ring = 0; ring < bridge.num_rings; ++ring) testing::add_block({.ring = ring}, &bridge);
  testing::add_block({.fixed = true}, &bridge);
  Case scene;
  scene.analysis.staged.least = StagedConstruction::Least::none;
  scene.analysis.staged.hold_below = 1;
  EXPECT_EQ(analysis_traits(AnalysisType::staged).num_solves(scene, bridge), 2.0);
}

TEST(ExplainMotion, RefusesWhatTheRunRefuses) {
  const Assembly wall = testing::running_bond_wall({0.6, 0.3, 0.3}, 2, 2);
  Case varying = moving_wall();
  varying.analysis.sleep = Sleep{.speed = 1e-3, .time = 0.2};
  varying.loads.dead_load_time = RampInTime{.from = 0.0, .to = 1.0, .start = 0.0, .duration = 1.0};
  Case cyclic = moving_wall();
  cyclic.analysis.type = AnalysisType::static_;
  cyclic.analysis.cyclic_sectors = 3;
  for (const Case& scene : {varying, cyclic}) {
    EXPECT_THROW(run_analysis(scene, wall, {}), InputError);
    EXPECT_THROW(explain_model(scene, wall), InputError);
  }
}

}  // namespace
}  // namespace cupola::explain_test
