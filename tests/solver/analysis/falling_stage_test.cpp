#include <cmath>

#include <gtest/gtest.h>

#include "solver/analysis/construction/solved_stage.hpp"
#include "tests/solver/construction_runs.hpp"

// Stages of which only the verdict counts: what falls by itself needs no solve of the whole.

namespace cupola::falling_stage_test {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

// Bricks of an open course slide down their bed, closed courses stand. Each stage is asked both ways.
TEST(FallingStage, HasTheVerdictOfTheWholeStructure) {
  const Assembly assembly = testing::make_sphere(10.0, 1.0, 12.0 * kDeg, 5, 8);
  for (const FrictionLaw law : {FrictionLaw::coulomb, FrictionLaw::associated}) {
    Case scene = testing::course_case(0.0, 0.4);
    scene.joints.strength = {};
    scene.joints.friction = 0.4;
    scene.analysis.friction_law = law;
    scene.analysis.staged.carry = false;
    scene.analysis.staged.first_ring = 0;
    Construction building(scene, assembly, [](const std::string&) {});
    int falling = 0, by_parts = 0;
    for (const LaidBlocks& laid : laying_order(assembly, scene.analysis.staged)) {
      building.lay(laid.blocks, laid.course);
      const StaticSolution quick = building.solve(Construction::Need::verdict);
      const int solved = building.problem().model.num_free(), blocks = building.problem().num_blocks;
      const std::vector<FallingBlock> quick_blocks =
          falling_blocks(building.problem(), quick.step_solution.v);
      const StaticSolution whole = building.solve(Construction::Need::forces);
      ASSERT_EQ(building.problem().model.num_free(), blocks);
      ASSERT_EQ(to_string(quick.outcome), to_string(whole.outcome)) << blocks << " blocks";
      if (whole.outcome == StaticOutcome::equilibrium) {
        building.accept(whole);
        continue;
      }
      ++falling;
      EXPECT_TRUE(quick.proven);
      if (solved == blocks) continue;
      ++by_parts;
      // The bricks below yield a little to those that slide.
      EXPECT_NEAR(quick.speed_ratio / whole.speed_ratio, 1.0, 0.02) << blocks << " blocks";
      for (const FallingBlock& block : quick_blocks) EXPECT_EQ(to_string(block.mode), "slides");
    }
    EXPECT_EQ(falling, 16)
        << "all but the last of the two upper courses, and two below, before their heads jam";
    EXPECT_EQ(by_parts, falling);
  }
}

// A brick on a bracket that tips under it: with the bracket held it would stand.
TEST(FallingStage, IsAskedOfTheWholeWhereItsBlocksStand) {
  const Assembly assembly =
      testing::make_boxes({{.center = {0, 0, -0.5}, .size = {1, 1, 1}, .fixed = true},
                           {.center = {8, 0, -0.5}, .size = {1, 1, 1}, .fixed = true},
                           {.center = {0.4, 0, 0.25}, .size = {1.6, 1, 0.5}},
                           {.center = {8, 0, 0.5}},
                           {.center = {1.0, 0, 0.75}, .size = {0.4, 0.4, 0.5}, .density = 5000}});
  Case scene = testing::level_case(1e-10, false);
  Construction building(scene, assembly, [](const std::string&) {});
  building.lay({2, 3}, 0);
  const StaticSolution bracket = building.solve(Construction::Need::forces);
  ASSERT_EQ(bracket.outcome, StaticOutcome::equilibrium) << bracket.message;
  building.accept(bracket);
  building.lay({4}, 0);
  const StaticSolution loaded = building.solve(Construction::Need::verdict);
  EXPECT_EQ(loaded.outcome, StaticOutcome::moving) << loaded.message;
  EXPECT_EQ(building.problem().model.num_free(), 3);
}

// Five slabs of length 1, each 0.24 farther out: the mean of the upper four lies 0.6 outwards of the lowest,
// which ends at 0.5. They turn about its edge, some about an axis outside their own corners, and none slides.
TEST(FallingStage, ACorbelTipsAboutItsLowestEdge) {
  std::vector<testing::BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {1, 1, 1}, .fixed = true}};
  for (int k = 0; k < 5; ++k)
    boxes.push_back({.center = {0.24 * k, 0, 0.25 * k + 0.125}, .size = {1, 1, 0.25}});
  const Assembly assembly = testing::make_boxes(boxes);
  Case scene = testing::level_case(1e-10, false);
  Construction building(scene, assembly, [](const std::string&) {});
  building.lay({1, 2, 3, 4, 5}, 0);
  const StaticSolution solution = building.solve(Construction::Need::forces);
  ASSERT_EQ(solution.outcome, StaticOutcome::moving) << solution.message;
  const std::vector<FallingBlock> falling = falling_blocks(building.problem(), solution.step_solution.v);
  ASSERT_EQ(falling.size(), 4u);
  for (const FallingBlock& block : falling) EXPECT_EQ(to_string(block.mode), "tips") << block.block;
}

}  // namespace
}  // namespace cupola::falling_stage_test
