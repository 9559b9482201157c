#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/analysis/construction/mortar_age.hpp"
#include "solver/analysis/construction/stage_problem.hpp"
#include "tests/solver/construction_runs.hpp"

// What construction carries from stage to stage, what it holds, and the age of its mortar.

namespace cupola::construction_test {
namespace {

using testing::build;
using testing::Built;
using testing::course_case;
using testing::CourseSpec;
using testing::kGamma;
using testing::make_course;

constexpr double kDeg = std::numbers::pi / 180.0;

// Under Coulomb's law a stage that carries what the last one left takes one contact solve, from that state.
// Others are solved under the associated law first.
TEST(Construction, CarriedStagesTakeOneSolve) {
  int solves = 0;
  std::vector<int> of_stages;
  AnalysisSinks sinks;
  sinks.log = [&](const std::string& line) {
    if (line.starts_with("static  h")) ++solves;
    if (line.starts_with("stage")) of_stages.push_back(std::exchange(solves, 0));
  };
  Case scene = course_case(38.7 * kDeg, 0.2);
  scene.analysis.tolerance = 1e-5;
  scene.analysis.staged.carry = true;
  scene.analysis.staged.fresh.cohesion = 2000.0;
  const Built built = build(scene, make_course({.bricks = 3, .courses = 2}), sinks);
  ASSERT_EQ(built.summary.status, Status::stable) << built.summary.message;
  ASSERT_EQ(of_stages.size(), 6u);
  for (size_t stage = 1; stage < of_stages.size(); ++stage)  // before stage 0 the course below is solved
    EXPECT_EQ(of_stages[stage], 1) << "stage " << stage;
}

// The blocks around a new one settle before the whole structure is solved.
TEST(Construction, StagesOfADomeTakeFewIterations) {
  int iterations = 0, stages = 0;
  AnalysisSinks sinks;
  sinks.log = [&](const std::string& line) {
    if (line.starts_with("stage")) ++stages;
    if (const size_t at = line.find("iterations"); stages > 0 && at != std::string::npos)
      iterations += std::stoi(line.substr(at + 10));
  };
  Case scene = course_case(0.0, 0.6);
  scene.analysis.tolerance = 1e-5;
  scene.joints.strength = {};
  scene.analysis.staged.first_ring = 4;
  const Built built = build(scene, testing::make_sphere(10.0, 1.0, 5.0 * kDeg, 5, 32), sinks);
  ASSERT_EQ(built.summary.status, Status::stable) << built.summary.message;
  ASSERT_EQ(stages, 32);
  EXPECT_LE(iterations, 7 * (stages - 1) / 2);  // 3.2 of a stage, and 4.6 without
}

// Blocks of a dry wall whose fresh beds slide on both stones below: all their contacts may slide at once, one
// way on the one and the other way on the other.
TEST(Construction, StagesOfADryWallTakeFewIterations) {
  constexpr int courses = 4, half_blocks = 24;  // m / 2
  std::vector<testing::BoxSpec> boxes{{.center = {6, 0, -0.5}, .size = {14, 2, 1}, .fixed = true}};
  for (int ring = 0; ring < courses; ++ring)
    for (int start = -(ring % 2); start < half_blocks; start += 2) {
      const double low = 0.5 * std::max(start, 0), high = 0.5 * std::min(start + 2, half_blocks);
      boxes.push_back({.center = {0.5 * (low + high), 0, 0.5 * ring + 0.25},
                       .size = {high - low, 0.5, 0.5},
                       .density = 1800,
                       .ring = ring});
    }
  Assembly wall = testing::make_boxes(boxes);
  wall.num_rings = courses;
  Case scene = testing::level_case(1e-10, true);
  scene.analysis.tolerance = 1e-5;
  scene.analysis.staged.fresh.friction = 0.1;
  int iterations = 0;
  AnalysisSinks sinks;
  sinks.log = [&](const std::string& line) {
    if (const size_t at = line.find("iterations"); at != std::string::npos)
      iterations += std::stoi(line.substr(at + 10));
  };
  const Built built = build(scene, wall, sinks);
  ASSERT_EQ(built.summary.status, Status::stable) << built.summary.message;
  EXPECT_LE(iterations, 8 * (std::ssize(boxes) - 1));  // 6.2 of a stage, and 9.9 without damping
}

// Stages balance as accurately as the case asks, by courses and by blocks.
TEST(Construction, StagesObeyTheTolerance) {
  const Assembly courses = make_course({.bricks = 3, .courses = 2});
  for (const bool by_blocks : {false, true})
    for (const double tolerance : {1e-4, 1e-8}) {
      Case scene = course_case(38.7 * kDeg, 0.9);
      scene.analysis.tolerance = tolerance;
      scene.analysis.staged.fresh.cohesion = 2000.0;
      if (!by_blocks) {
        scene.analysis.staged.unit = StagedConstruction::Unit::ring;
        scene.analysis.staged.carry = false;
      }
      const Summary summary = build(scene, courses).summary;
      ASSERT_EQ(summary.status, Status::stable) << summary.message;
      EXPECT_EQ(summary.accuracy.asked, tolerance);
      EXPECT_LE(summary.accuracy.worst_over_run, tolerance);
    }
}

// Two courses below the course laid, instead of all, change neither the verdict nor the cohesion; a stack of
// courses settles less.
TEST(Construction, HoldingLowerCoursesKeepsTheLeastCohesion) {
  const double theta = 38.7 * kDeg;
  const CourseSpec course{.bricks = 2, .courses = 6};
  const Assembly assembly = make_course(course);
  double least[2];
  for (const int i : {0, 1}) {
    Case scene = course_case(theta, 0.2);
    scene.analysis.staged.first_ring = testing::kFirstCourse + 5;
    scene.analysis.staged.hold_below = i == 0 ? -1 : 2;
    scene.analysis.staged.least = StagedConstruction::Least::cohesion;
    scene.analysis.staged.fresh.cohesion = 2000.0;
    const Built built = build(scene, assembly);
    ASSERT_EQ(built.stages.size(), 2u) << built.summary.message;
    EXPECT_EQ(built.stages[1].at("blocks"), i == 0 ? "13" : "6");
    least[i] = built.least_stands(1);
  }
  EXPECT_NEAR(least[1] / least[0], 1.0, 0.01) << "brackets of 1 %";
}

// Of 120 stages every third one has a frame, and the last one; all have a row.
TEST(Construction, LongOnesHaveFramesOfSomeStages) {
  constexpr int kStages = 120;
  std::vector<testing::BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {10, 400, 1}, .fixed = true}};
  for (int k = 0; k < kStages; ++k) boxes.push_back({.center = {0, 3.0 * (k - kStages / 2), 0.5}});
  Case scene = course_case(0.0, 0.4);
  scene.joints.strength = {};
  scene.analysis.staged.first_ring = 0;
  const Built built = build(scene, testing::make_boxes(boxes));
  ASSERT_EQ(built.stages.size(), static_cast<size_t>(kStages)) << built.summary.message;
  ASSERT_EQ(built.frames.size(), static_cast<size_t>(kStages / 3 + 1));
  for (size_t i = 0; i + 1 < built.frames.size(); ++i)
    EXPECT_EQ(built.frames[i].owner, fmt::format("stage {}", 3 * i));
  EXPECT_EQ(built.frames.back().owner, "stage 119");
}

// The tables reach the disk from time to time, and always at an interruption, together with the checkpoint.
TEST(Construction, SavesWhatItHasWhenItIsInterrupted) {
  std::string table, bytes;
  int asked = 0;
  AnalysisSinks sinks;
  sinks.table = [&](const std::string& name, const std::string& text) {
    if (name == "construction.csv") table = text;
  };
  sinks.checkpoint = [&](const std::string& written) { bytes = written; };
  sinks.interrupted = [&] { return ++asked == 3; };
  Case scene = course_case(0.0, 0.4);
  scene.joints.strength = {};
  scene.analysis.staged.first_ring = 0;
  EXPECT_FALSE(run_analysis(scene, testing::stack_of_cubes(1.0, std::vector<double>(5, 1000.0)), sinks));
  EXPECT_FALSE(bytes.empty());
  EXPECT_EQ(testing::parse_rows(table).size(), 3u);
}

TEST(Construction, ResumesWithTheSameBits) {
  Case scene = course_case(38.7 * kDeg, 0.2);
  scene.analysis.staged.least = StagedConstruction::Least::cohesion;
  scene.analysis.staged.fresh.cohesion = 2000.0;
  const Assembly assembly = make_course({.bricks = 3, .courses = 2});
  const Built whole = build(scene, assembly);
  std::string bytes;
  int asked = 0;
  std::vector<Frame> frames;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { frames.push_back(frame); };
  sinks.checkpoint = [&](const std::string& written) { bytes = written; };
  sinks.interrupted = [&] { return ++asked == 4; };
  EXPECT_FALSE(run_analysis(scene, assembly, sinks));
  AnalysisSinks again;
  again.resume_from = bytes;
  const Built rest = build(scene, assembly, again);
  ASSERT_EQ(frames.size() + rest.frames.size(), whole.frames.size());
  ASSERT_EQ(frames.size(), 4u);
  for (size_t i = 0; i < rest.frames.size(); ++i)
    for (int k = 0; k < rest.frames[i].contacts.size(); ++k)
      ASSERT_EQ(rest.frames[i].contacts.force[k], whole.frames[i + 4].contacts.force[k]);
  EXPECT_EQ(rest.summary.message, whole.summary.message);
  ASSERT_EQ(rest.stages.size(), whole.stages.size());
  for (size_t i = 0; i < rest.stages.size(); ++i)
    EXPECT_EQ(rest.stages[i].at("least_stands"), whole.stages[i].at("least_stands"));
}

// A joint with a support is fresh while the course of its block is laid, and no longer.
TEST(Construction, JointsWithSupportsHaveTheAgeOfTheirBlocks) {
  const double theta = 38.7 * kDeg;
  Assembly assembly = testing::make_boxes(
      {{.center = {0, 0, -0.05}, .size = {1, 3, 0.1}, .fixed = true},
       {.center = {0, 0, 0.025}, .size = {0.34, 0.34, 0.05}, .density = kGamma / testing::kG, .ring = 3},
       {.center = {0, 1, 0.025}, .size = {0.34, 0.34, 0.05}, .density = kGamma / testing::kG, .ring = 4}});
  assembly.num_rings = 5;
  Case scene = course_case(theta, 0.0);
  scene.analysis.staged.first_ring = 3;
  scene.analysis.staged.least = StagedConstruction::Least::cohesion;
  const Built built = build(scene, assembly);
  ASSERT_EQ(built.stages.size(), 2u) << built.summary.message;
  const double needed = kGamma * 0.05 * std::sin(theta);
  for (size_t k = 0; k < 2; ++k) EXPECT_NEAR(built.least_stands(k) / needed, 1.0, 0.01);
  EXPECT_EQ(built.failures.front().at("block"), "1");
  EXPECT_EQ(built.failures.back().at("block"), "2") << "block 1 has hardened";
}

// The haunches of an arch on mortar rise together: each stage is symmetrical, its joints have the same age on
// both sides, and the last one closes the crown. Joints of frames keep the rings of the assembly.
TEST(Construction, HaunchesOfAnArchCarryTheSame) {
  constexpr int kVoussoirs = 9;
  Assembly arch = testing::make_arch({.voussoirs = kVoussoirs});
  arch.sheets = {{.name = "arch", .num_rings = kVoussoirs, .thrust_lines = Sheet::ThrustLines::one}};
  Case scene = course_case(0.0, 0.6);
  StagedConstruction& staged = scene.analysis.staged;
  staged.unit = StagedConstruction::Unit::ring;
  staged.first_ring = 0;
  scene.joints.strength = {.tension = 1e6, .cohesion = 1e6};
  staged.curing = {{0.0, testing::joint_law(0.6, 2e5)}, {2.0, testing::joint_law(0.6, 1e6)}};
  for (CuringMortar& row : staged.curing) row.law.tension = row.law.cohesion;
  staged.curing.front().law.normal = 1e-8;
  staged.curing.back().law.normal = 1e-10;
  const Built built = build(scene, arch);
  ASSERT_EQ(built.summary.status, Status::stable) << built.summary.message;
  ASSERT_EQ(built.stages.size(), 5u);
  EXPECT_EQ(built.stages[0].at("laid"), "2");
  EXPECT_EQ(built.stages[4].at("laid"), "1");
  for (const Frame& frame : built.frames) {
    const double weight = arch.blocks[1].mass * testing::kG;
    for (int k = 0; k < kVoussoirs; ++k)  // joints between blocks k and k + 1, and their images
      EXPECT_NEAR(testing::normal_force(frame, k, k + 1),
                  testing::normal_force(frame, kVoussoirs - k, kVoussoirs + 1 - k), 1e-4 * weight)
          << frame.owner << ", joint " << k;
    for (int i = 0; i < frame.contacts.size(); ++i)
      if (frame.contacts.kind[i] == JointKind::bed) {
        EXPECT_EQ(frame.contacts.ring[i], arch.blocks[frame.contacts.block_b[i]].ring);
      }
  }
}

// Two stones of two courses are laid with the lower one. Their joint has a part in either course, each under
// the law of its ring; both are as old as the lower course.
TEST(Construction, LawsOfRingsHoldForTheSameJointsAsInStatics) {
  Assembly uprights = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {9, 9, 1}, .fixed = true}});
  for (const double x : {0.0, 1.0}) {
    testing::add_block({}, &uprights);
    uprights.blocks.back().num_rings = 2;
    for (const int ring : {0, 1}) {
      testing::add_box_part({.center = {x, 0, 0.5 + ring}}, false, false, &uprights);
      uprights.parts.back().ring = ring;
    }
  }
  uprights.num_rings = 2;
  compute_mass_properties(&uprights);
  Case scene = course_case(0.0, 0.6);
  scene.joints.rings = {{1, 1, RingJoints::Sort::all, testing::joint_law(0.9, {})}};
  scene.analysis.staged.fresh.heads = true;
  scene.analysis.staged.fresh.friction = 0.1;
  const BuildingSite site(scene, uprights);
  ASSERT_EQ(site.contacts.patches.size(), 4u) << "two on the floor, and two between the stones";
  BuiltState state;
  state.laid.assign(uprights.blocks.size(), 1);
  for (const int laying : {0, 1}) {
    state.ring = laying;
    const Model model = stage_model(site, state, {});
    for (const Patch& patch : site.contacts.patches)
      EXPECT_EQ(model.joints.law(uprights, patch, 1.0).mu, laying == 0 ? 0.1 : patch.ring == 1 ? 0.9 : 0.6);
  }
}

// Ages of 0 and 1 course, interpolated at 5 days for courses of 5 days.
TEST(Construction, CuringInterpolatesBetweenAges) {
  StagedConstruction staged;
  staged.days_per_course = 5.0;
  JointLawChange young, old;
  young.cohesion = 1000.0;
  old.cohesion = 5000.0;
  staged.curing = {{0.0, young}, {20.0, old}};
  const std::vector<RingJoints> laws = mortar_by_course(staged, 10);
  ASSERT_EQ(laws.size(), 5u) << "ages of 0, 5, 10, 15 and 20 days";
  for (const RingJoints& group : laws) {
    EXPECT_TRUE(group.from == 10 || group.from == group.to);
    EXPECT_DOUBLE_EQ(*group.law.cohesion, 1000.0 + 1000.0 * (10 - group.from));
  }
}

// Mortar that cures over ages of 0 and 1 course is fresh as long as that of the two courses laid last.
TEST(Construction, CuringMortarIsFreshUntilItHardens) {
  StagedConstruction curing, plain;
  plain.fresh.courses = 2;
  for (StagedConstruction* staged : {&curing, &plain}) staged->fresh.friction = 0.3;
  curing.fresh.courses = 1;  // replaced
  curing.curing = {{0.0, testing::joint_law(0.3, 0.0)}, {1.0, testing::joint_law(0.3, 0.0)}};
  for (const int courses : {0, 1, 2, 3})
    EXPECT_EQ(is_fresh(curing, courses), is_fresh(plain, courses)) << courses;
  EXPECT_TRUE(is_fresh(plain, 1));
  EXPECT_FALSE(is_fresh(plain, 2));
}

// Two courses of weight q per area down the slope, half a day apart, in mortar that hardens from c to 2.5 q
// in a day: the upper bed needs c = q, the lower one (c + 2.5 q) / 2 = 2 q once it carries both.
TEST(Construction, CuringMortarCarriesTheNextCourseByItsAge) {
  const double theta = 22.9 * kDeg, q = kGamma * CourseSpec{}.height * std::sin(theta);
  Case scene = course_case(theta, 0.0);
  StagedConstruction& staged = scene.analysis.staged;
  staged.least = StagedConstruction::Least::cohesion;
  staged.days_per_course = 0.5;
  staged.curing = {{0.0, testing::joint_law(0.0, 2.0 * q)}, {1.0, testing::joint_law(0.0, 2.5 * q)}};
  const Built built = build(scene, make_course({.bricks = 1, .courses = 2}));
  ASSERT_EQ(built.stages.size(), 2u) << built.summary.message;
  EXPECT_EQ(built.summary.status, Status::stable) << built.summary.message;
  EXPECT_NEAR(built.least_stands(0) / q, 1.0, 0.01);  // brackets of 1 %
  EXPECT_NEAR(built.least_stands(1) / q, 1.5, 0.015);
  EXPECT_NEAR(built.least_moves(1) / q, 1.5, 0.015);
}

}  // namespace
}  // namespace cupola::construction_test
