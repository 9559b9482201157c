#include <cmath>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "solver/analysis/construction/construction_progress.hpp"
#include "solver/dynamics/laying_order.hpp"
#include "solver/runtime/threads.hpp"
#include "tests/solver/construction_runs.hpp"
#include "tests/solver/motion_scenes.hpp"

// Whole courses from unloaded joints.

namespace cupola::staged_test {
namespace {

using testing::build;
using testing::Built;

Case staged_case(double friction, double fresh) {
  Case scene = testing::make_case(friction, 1e-8, 0.01);
  scene.analysis.type = AnalysisType::staged;
  scene.analysis.staged.fresh.friction = fresh;
  return scene;
}

// The same with hardened joints that hold by cohesion, which the fresh bed does not have yet.
TEST(Staged, TheFreshBedHasNoCohesion) {
  const Assembly wall = testing::running_bond_wall({1.0, 0.5, 0.3}, 3, 2);
  for (const double fresh : {0.29, 0.31}) {
    Case scene = staged_case(0.1, fresh);
    scene.loads.gravity = testing::tilted_gravity(0.3);
    scene.joints.compliance.per = Compliance::Per::area;
    scene.joints.strength.cohesion = 1e5;
    const Built result = build(scene, wall);
    ASSERT_EQ(result.stages.size(), 2U);
    for (const auto& row : result.stages)
      EXPECT_EQ(row.at("verdict"), fresh > 0.3 ? "equilibrium" : "moving") << fresh;
  }
}

// A wall on a slope of 0.3: each course slides if the friction of the fresh mortar is below the slope.
// Hardened joints hold.
TEST(Staged, TheLeastFreshFrictionEqualsTheSlope) {
  const Assembly wall = testing::running_bond_wall({1.0, 0.5, 0.3}, 3, 3);
  Case scene = staged_case(0.7, 0.31);
  scene.loads.gravity = testing::tilted_gravity(0.3);
  scene.analysis.staged.least = StagedConstruction::Least::friction;
  const Built built = build(scene, wall);
  EXPECT_EQ(built.summary.status, Status::stable) << built.summary.message;
  ASSERT_EQ(built.stages.size(), 3u);
  const double course = 3.0 * 0.5 * 0.3 * 1000.0 * testing::kG;
  for (size_t ring = 0; ring < 3; ++ring) {
    const testing::TableRow& row = built.stages[ring];
    EXPECT_EQ(row.at("ring"), std::to_string(ring));
    EXPECT_NEAR(std::stod(row.at("weight_N")) / (course * static_cast<double>(ring + 1)), 1.0, 1e-8);
    EXPECT_EQ(row.at("verdict"), "equilibrium");
    EXPECT_NEAR(built.least_stands(ring), 0.3, 3e-3) << "bracket of 1e-2";
    EXPECT_NEAR(built.least_moves(ring), 0.3, 3e-3);
    EXPECT_GT(built.least_stands(ring), built.least_moves(ring));
  }
  ASSERT_TRUE(built.summary.critical);
  EXPECT_NEAR(built.summary.critical->value, 0.3, 3e-3);

  scene.analysis.staged.fresh.friction = 0.29;
  scene.analysis.staged.least = StagedConstruction::Least::none;
  const Built slides = build(scene, wall);
  EXPECT_EQ(slides.summary.status, Status::moving);
  EXPECT_NE(slides.summary.message.find("stages that stand with the mortar of the case: 0 of 3"),
            std::string::npos)
      << slides.summary.message;
  ASSERT_EQ(slides.frames.size(), 3u);
  for (size_t ring = 0; ring < 3; ++ring)
    for (size_t b = 0; b < wall.blocks.size(); ++b) {
      const bool slips = !wall.blocks[b].fixed && wall.blocks[b].ring == static_cast<int>(ring);
      const double speed = slides.frames[ring].blocks.velocity[b].norm();
      EXPECT_LE(speed, 1.0 + 1e-12);
      if (slips)
        EXPECT_GT(speed, 0.5) << "block " << b << " of the course just laid";
      else
        EXPECT_LT(speed, 0.05) << "block " << b << " in stage " << ring
                               << ": its bed has hardened, it moves only "
                               << "by its compliance";
    }
}

// A block on a slope s = 2 / 9.81 slides with a friction below s - c A / W and would tip without the tension
// of its bed, which ends at c / mu: it falls with the friction of 0.6 that hardened mortar has.
TEST(Staged, TheLeastFreshFrictionMayBeBelowOneThatLetsItFall) {
  const Assembly block = testing::running_bond_wall({0.16, 0.5, 1.0}, 1, 1);
  Case scene = staged_case(0.6, 0.2);
  scene.loads.gravity = Vec3(2.0, 0.0, -testing::kG);
  scene.contact.subdivide = 4;
  scene.joints.compliance = {1e-9, 2e-9, Compliance::Per::area};
  scene.joints.strength = {.tension = 5e4, .cohesion = 1e5};
  const double weight_per_area = 1000.0 * testing::kG, cohesion = 0.15 * weight_per_area;
  scene.analysis.staged.fresh.cohesion = cohesion;
  scene.analysis.staged.fresh.tension = 0.4 * weight_per_area;
  scene.analysis.staged.least = StagedConstruction::Least::friction;
  const Built built = build(scene, block);
  EXPECT_EQ(built.summary.status, Status::stable) << built.summary.message;
  ASSERT_TRUE(built.summary.critical) << built.summary.message;
  EXPECT_NEAR(built.summary.critical->value, 2.0 / testing::kG - cohesion / weight_per_area, 5e-4)
      << "the width of the bracket, a hundredth";
}

// On level ground no course slides, even without friction.
TEST(Staged, ReportsStagesThatNeedNoFriction) {
  Case scene = staged_case(0.6, 0.1);
  scene.analysis.staged.least = StagedConstruction::Least::friction;
  const Built built = build(scene, testing::running_bond_wall({1.0, 0.5, 0.3}, 2, 2));
  EXPECT_EQ(built.summary.status, Status::stable) << built.summary.message;
  EXPECT_NE(built.summary.message.find("; 2 stages stand without fresh friction"), std::string::npos)
      << built.summary.message;
  EXPECT_FALSE(built.summary.critical);
  for (const testing::TableRow& row : built.stages) {
    EXPECT_EQ(row.at("least_stands"), "0");
    EXPECT_EQ(row.at("least_moves"), "");
    EXPECT_EQ(row.at("note"), "stands without friction");
  }
}

// Frames number the blocks as the complete assembly does. Blocks that are not laid yet have their final
// position and no contacts.
TEST(Staged, FramesContainTheCompleteAssembly) {
  const Assembly wall = testing::running_bond_wall({1.0, 0.5, 0.3}, 2, 3);
  Case scene = staged_case(0.6, 0.5);
  scene.analysis.staged.first_ring = 1;
  const Built built = build(scene, wall);
  ASSERT_EQ(built.frames.size(), 2u);
  EXPECT_EQ(built.frames[0].time, 1.0);
  ASSERT_EQ(built.frames[0].blocks.size(), static_cast<int>(wall.blocks.size()));
  for (const int block : built.frames[0].contacts.block_b)
    EXPECT_LE(wall.blocks[static_cast<size_t>(block)].ring, 1);
  EXPECT_GT(built.frames[1].contacts.size(), built.frames[0].contacts.size());
}

// Loads on the finished building, and ties to blocks that are not laid yet, are inactive.
TEST(Staged, LoadsAndTiesActOnlyOnceTheirBlocksAreLaid) {
  const Assembly wall = testing::running_bond_wall({1.0, 0.5, 0.3}, 2, 3);
  Case scene = staged_case(0.6, 0.5);
  scene.loads.forces = {{.block = 4, .point = {}, .force = Vec3(0, 0, -1e5), .time = {}}};
  PairTie tie;
  tie.block_a = 1;
  tie.block_b = 7;  // in the last course
  scene.ties.pairs = {tie};
  Construction building(scene, wall, [](const std::string&) {});
  for (const LaidBlocks& laid : laying_order(wall, scene.analysis.staged)) {
    building.lay(laid.blocks, laid.course);
    const Model model = stage_problem(building.site(), building.state(), {}, FreeBlocks::all).model;
    EXPECT_EQ(model.loads.points.size(), laid.ring == 2 ? 1U : 0U);
    EXPECT_EQ(model.ties.size(), laid.ring == 2 ? 1U : 0U);
  }
}

// A beam whose centre of mass lies 0.1 m beyond its support stands only with the counterweight laid on it.
TEST(Staged, WhatLiesBelowTheFirstRingMustStandByItself) {
  const Assembly boxes =
      testing::make_boxes({{.center = {0, 0, -0.5}, .fixed = true},
                           {.center = {0.6, 0, 0.25}, .size = {2, 1, 0.5}, .ring = 0},
                           {.center = {-0.2, 0, 0.75}, .size = {0.4, 1, 0.5}, .density = 5000.0, .ring = 1}});
  for (const bool carry : {false, true}) {
    Case scene = staged_case(0.6, 0.5);
    scene.analysis.staged.carry = carry;
    scene.analysis.staged.first_ring = 1;
    const Built built = build(scene, boxes);
    EXPECT_EQ(built.summary.status, Status::moving) << built.summary.message;
    EXPECT_NE(built.summary.message.find("first_ring, laid at once, do not stand"), std::string::npos)
        << built.summary.message;
    ASSERT_EQ(built.stages.size(), carry ? 1u : 2u);
    EXPECT_EQ(built.stages[0].at("ring"), "0");
    EXPECT_EQ(built.stages[0].at("verdict"), "moving");
    ASSERT_EQ(built.failures.size(), 1u);
    EXPECT_EQ(built.stages.back().at("verdict"), carry ? "moving" : "equilibrium");
    ASSERT_EQ(built.frames.size(), built.stages.size());
    EXPECT_EQ(built.frames[0].role, FrameRole::failed_stage);
  }
}

// The same beam on a slab, which is laid with it.
TEST(Staged, CoursesLaidAtOnceAreNamedByTheLast) {
  const Assembly boxes =
      testing::make_boxes({{.center = {0, 0, -1.5}, .fixed = true},
                           {.center = {0, 0, -0.5}, .ring = 0},
                           {.center = {0.6, 0, 0.25}, .size = {2, 1, 0.5}, .ring = 1},
                           {.center = {-0.2, 0, 0.75}, .size = {0.4, 1, 0.5}, .density = 5000.0, .ring = 2}});
  Case scene = staged_case(0.6, 0.5);
  scene.analysis.staged.first_ring = 2;
  const Built built = build(scene, boxes);
  EXPECT_NE(built.summary.message.find("stage 0 in course 1 (block 2): the courses below"), std::string::npos)
      << built.summary.message;
}

// Two uprights, laid with the courses 0 and 1, touch in course 2.
TEST(Staged, AJointOfUprightsIsAsOldAsTheYoungerOne) {
  Assembly boxes = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {10, 10, 1}, .fixed = true},
                                        {.center = {-0.5, 0, 0.5}, .ring = 0},
                                        {.center = {0.5, 0, 0.5}, .ring = 1}});
  for (Part& part : boxes.parts)
    if (part.block != 0) part.ring = 2;
  const Case scene = staged_case(0.6, 0.5);
  const BuildingSite site(scene, boxes);
  for (const Patch& patch : site.contacts.patches) {
    EXPECT_EQ(patch.course, patch.block_b == 1 ? 0 : 1);
    EXPECT_EQ(patch.ring, 2);
  }
}

TEST(Staged, RefusesAFirstRingAboveTheLast) {
  Case scene = staged_case(0.6, 0.5);
  scene.analysis.staged.first_ring = 7;
  EXPECT_THROW(build(scene, testing::running_bond_wall({1.0, 0.5, 0.3}, 2, 3)), InputError);
}

/// Boxes on a slope of 0.3: an arch of three rings, and a wall of one, laid right after its crown (block 2).
Assembly arch_and_wall() {
  Assembly boxes = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {20, 20, 1}, .fixed = true},
                                        {.center = {-3, 0, 0.5}, .ring = 0},
                                        {.center = {0, 0, 0.5}, .ring = 1},
                                        {.center = {3, 0, 0.5}, .ring = 2},
                                        {.center = {6, 0, 0.5}, .ring = 3}});
  boxes.sheets = {{.name = "arch", .num_rings = 3, .thrust_lines = Sheet::ThrustLines::one},
                  {.name = "wall", .first_ring = 3, .num_rings = 1}};
  return boxes;
}

// Mortar of two courses is fresh: the crown slides before the wall is laid, and with it, one course old.
TEST(Staged, TheCrownIsOneCourseOlderThanTheNextMember) {
  Case scene = staged_case(0.7, 0.29);
  scene.loads.gravity = testing::tilted_gravity(0.3);
  scene.analysis.staged.fresh.courses = 2;
  scene.analysis.staged.first_ring = 3;
  const Built built = build(scene, arch_and_wall());
  ASSERT_EQ(built.failures.size(), 3U) << built.summary.message;
  EXPECT_EQ(built.failures[0].at("block"), "2");
  EXPECT_EQ(built.failures[1].at("block"), "2");
  EXPECT_EQ(built.failures[2].at("block"), "4");
}

TEST(Staged, TheCrownIsOneCourseBelowTheNextMember) {
  Case scene = staged_case(0.7, 0.5);
  scene.analysis.staged.hold_below = 1;
  const Assembly assembly = arch_and_wall();
  const BuildingSite site(scene, assembly);
  EXPECT_FALSE(site.is_held(2, site.course[4]));
  EXPECT_TRUE(site.is_held(1, site.course[4]));
}

TEST(Staged, RefusesRingsThatAreAllLaidWithLowerOnes) {
  Case scene = staged_case(0.6, 0.5);
  scene.analysis.staged.first_ring = scene.analysis.staged.last_ring = 2;
  scene.analysis.staged.least = StagedConstruction::Least::cohesion;
  EXPECT_THROW(build(scene, arch_and_wall()), InputError);
}

// Threads solve whole stages; what is recorded, and in which order, does not depend on them.
TEST(Staged, IsTheSameOnAnyNumberOfThreads) {
  const Assembly wall = testing::running_bond_wall({1.0, 0.5, 0.3}, 2, 6);
  Case scene = staged_case(0.7, 0.31);
  scene.loads.gravity = testing::tilted_gravity(0.3);
  scene.analysis.staged.least = StagedConstruction::Least::friction;
  std::vector<Built> results;
  std::vector<std::vector<std::string>> logs(2);
  for (const int threads : {1, 3}) {
    set_num_threads(threads);
    AnalysisSinks sinks;
    sinks.log = [&log = logs[results.size()]](const std::string& line) { log.push_back(line); };
    results.push_back(build(scene, wall, sinks));
  }
  set_num_threads(1);
  EXPECT_EQ(results[0].stages, results[1].stages);
  EXPECT_EQ(results[0].summary.message, results[1].summary.message);
  EXPECT_EQ(logs[0], logs[1]);
  ASSERT_EQ(results[0].frames.size(), 6u);
  ASSERT_EQ(results[1].frames.size(), 6u);
  for (size_t k = 0; k < 6; ++k)
    EXPECT_EQ(results[0].frames[k].contacts.force, results[1].frames[k].contacts.force);
}

// The state that is saved has the stages before it as standing, as the run that saves it has.
TEST(Staged, ResumesWithAsManyIterations) {
  const Assembly wall = testing::running_bond_wall({1.0, 0.5, 0.3}, 3, 10);
  Case scene = staged_case(0.7, 0.31);
  scene.loads.gravity = testing::tilted_gravity(0.3);
  scene.analysis.staged.least = StagedConstruction::Least::friction;
  const Summary whole = build(scene, wall).summary;
  AnalysisSinks sinks, again;
  int asked = 0;
  sinks.checkpoint = [&](const std::string& written) { again.resume_from = written; };
  sinks.interrupted = [&] { return ++asked == 5; };
  EXPECT_FALSE(run_analysis(scene, wall, sinks));
  const Built rest = build(scene, wall, again);
  ASSERT_EQ(rest.stages.size(), 10u);
  EXPECT_EQ(rest.summary.iterations, whole.iterations);
}

// What other stages leave open does not take back a proof.
TEST(Staged, OneStageThatIsProvenToMoveRefutesTheConstruction) {
  ConstructionProgress progress;
  progress.solved = 2;
  progress.unconverged = progress.motion_proven = true;
  Summary summary;
  progress.judge({LaidBlocks{}, LaidBlocks{}}, Case{}, Assembly{}, &summary);
  EXPECT_EQ(to_string(summary.status), to_string(Status::moving));
  progress.motion_proven = false;
  progress.judge({LaidBlocks{}, LaidBlocks{}}, Case{}, Assembly{}, &summary);
  EXPECT_EQ(to_string(summary.status), to_string(Status::unconverged));
}

}  // namespace
}  // namespace cupola::staged_test
