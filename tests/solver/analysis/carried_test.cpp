#include <cmath>

#include <gtest/gtest.h>

#include "solver/analysis/construction/construction.hpp"
#include "tests/solver/construction_runs.hpp"

// Joints, ties and supports of a structure that is built block by block.

namespace cupola::carried_test {
namespace {

using testing::build;
using testing::Built;
using testing::level_case;
using testing::normal_force;

// Column of m cubes of weight W with joints of compliance c over the area A. A block is laid where the one
// below then is, and settles by what is laid on the joints below it from then on: W c / A per joint and
// stage. The joint of the block just laid is fresh.
TEST(Construction, CarriedColumnSettlesFromTheBirthOfEachBlock) {
  const int m = 4;
  const Assembly column = testing::stack_of_cubes(1.0, std::vector<double>(m, 1000.0));
  const double c = 1e-9, fresh = 5e-9, weight = 1000.0 * testing::kG;
  std::vector<double> sank(m, 0.0);
  for (int stage = 0; stage < m; ++stage) {
    if (stage > 0) sank[stage] = sank[stage - 1];
    for (int k = 0; k <= stage; ++k)
      for (int joint = 0; joint <= k; ++joint) sank[k] += (joint == stage ? fresh : c) * weight;
  }
  for (const bool carry : {false, true}) {
    Case scene = level_case(c, carry);
    if (carry) scene.analysis.staged.fresh.normal = fresh;
    const Built built = build(scene, column);
    ASSERT_EQ(built.summary.status, Status::stable) << built.summary.message;
    ASSERT_EQ(built.frames.size(), static_cast<size_t>(m));
    for (int k = 0; k < m; ++k) {
      double from_rest = 0.0;
      for (int j = 0; j <= k; ++j) from_rest += (m - j) * c * weight;
      const double found = -built.frames.back().blocks.displacement[k + 1].z();
      EXPECT_NEAR(found / (carry ? sank[k] : from_rest), 1.0, 1e-4)
          << "block " << k << (carry ? ", carried" : "");
      EXPECT_NEAR(normal_force(built.frames.back(), k, k + 1) / ((m - k) * weight), 1.0, 1e-4);
    }
  }
}

/// What the contacts of block 1 with the floor bear, and how far they are open.
struct Bed {
  double push = 0.0, pull = 0.0;  ///< N
  double gap = 0.0;               ///< m, the widest
};

Bed bed_of_block_1(const Frame& frame) {
  Bed bed;
  const ContactTable& contacts = frame.contacts;
  for (int i = 0; i < contacts.size(); ++i) {
    if (contacts.block_a[i] != 0 || contacts.block_b[i] != 1) continue;
    bed.push += std::max(0.0, contacts.normal_force[i]);
    bed.pull += std::max(0.0, -contacts.normal_force[i]);
    bed.gap = std::max(bed.gap, contacts.gap[i]);
  }
  return bed;
}

// A block of weight W leans so far that its fresh bed, without tension, opens. The bed hardens while a block
// is laid elsewhere: no load changes, and so does nothing. A third block of weight P on top of the first
// opens the crack further, and the bed pulls by at least (W (s h - b) + P (s (2 h + k) - b)) / 2 b, if all at
// one edge, from the moments about the other, with the slope s, height h and width b of the first block, and
// the height k of the third.
TEST(Construction, ACrackOfAFreshBedStaysWhenItHardens) {
  const double b = 0.5, h = 1.0, k = 0.2, slope = 0.45, light = 1000.0, heavy = 5000.0;
  const Assembly boxes =
      testing::make_boxes({{.center = {0, 0, -0.5}, .size = {20, 20, 1}, .fixed = true},
                           {.center = {0, 0, 0.5 * h}, .size = {b, b, h}, .density = light, .ring = 0},
                           {.center = {5, 0, 0.5 * b}, .size = {b, b, b}, .density = light, .ring = 1},
                           {.center = {0, 0, h + 0.5 * k}, .size = {b, b, k}, .density = heavy, .ring = 2}});
  for (const double stiffer : {1.0, 0.5}) {
    Case scene = level_case(stiffer * 1e-9, true);
    scene.loads.gravity = testing::tilted_gravity(slope);
    scene.joints.strength = {.tension = 1e5, .cohesion = 1e5};
    scene.analysis.tolerance = 1e-9;
    FreshMortar& fresh = scene.analysis.staged.fresh;
    fresh.friction = 0.6;
    fresh.normal = 1e-9;
    const Built built = build(scene, boxes);
    ASSERT_EQ(built.summary.status, Status::stable) << built.summary.message;
    ASSERT_EQ(built.frames.size(), 3u);
    const Bed open = bed_of_block_1(built.frames[0]), hardened = bed_of_block_1(built.frames[1]),
              loaded = bed_of_block_1(built.frames[2]);
    const double per_kg = testing::kG * std::cos(std::atan(slope));
    const double weight = light * b * b * h * per_kg, top = heavy * b * b * k * per_kg;
    EXPECT_GT(open.gap, 1e-6);
    EXPECT_NEAR(hardened.gap / open.gap, 1.0, 1e-6) << "the accuracy of the solves, " << stiffer;
    EXPECT_NEAR(hardened.push / weight, 1.0, 1e-6);
    EXPECT_NEAR(hardened.pull / weight, 0.0, 1e-6);
    const double pull = (weight * (slope * h - b) + top * (slope * (2.0 * h + k) - b)) / (2.0 * b);
    EXPECT_GE(loaded.pull, pull);
    EXPECT_GT(loaded.gap, open.gap);
  }
}

// Cubes of weight W on joints of compliance c; a tie of stiffness k and prestress P from the floor to the
// second one. The tie is born with its prestress when that block is laid, and slackens by what is laid from
// then on: by the joints below it, 2 k c (W + its own change of force) per block. Built at once it also
// slackens by what lay there before.
TEST(Construction, CarriedTieSlackensFromItsBirth) {
  const double c = 1e-9, k = 1e8, prestress = 4e4, weight = 1000.0 * testing::kG;
  for (const bool carry : {false, true}) {
    Case scene = level_case(c, carry);
    PairTie tie;
    tie.block_a = 0;
    tie.block_b = 2;
    tie.stiffness = k;
    tie.prestress = prestress;
    scene.ties.pairs = {tie};
    const Built built = build(scene, testing::stack_of_cubes(1.0, std::vector<double>(3, 1000.0)));
    ASSERT_EQ(built.frames.size(), 3u) << built.summary.message;
    EXPECT_EQ(built.frames[0].ties.size(), 0);
    ASSERT_EQ(built.frames[2].ties.size(), 1);
    const double loads = carry ? 4.0 : 5.0;  // on the joints below, times W
    EXPECT_NEAR(built.frames[2].ties.force[0], (prestress - loads * k * c * weight) / (1.0 + 2.0 * k * c),
                1.0)
        << (carry ? "carried" : "at once");
  }
}

// A beam of weight W on three supports, on joints of compliance c. The one in the middle sinks by d once the
// beam is laid: it carries (W - 2 d / c) / 3.
TEST(Construction, SupportsMoveOnceTheStructureIsComplete) {
  const double c = 1e-8, down = 2e-5;
  std::vector<testing::BoxSpec> boxes;
  for (const double x : {-2.0, 0.0, 2.0})
    boxes.push_back({.center = {x, 0, -0.5}, .size = {1, 1, 1}, .fixed = true});
  boxes.push_back({.center = {0, 0, 0.5}, .size = {5, 1, 1}, .density = 1000.0});
  for (const bool carry : {false, true}) {
    Case scene = level_case(c, carry);
    scene.supports.moves = {
        SupportMove{.region = {.blocks = {1}}, .displacement = {0, 0, -down}, .time = {}}};
    const Built built = build(scene, testing::make_boxes(boxes));
    ASSERT_EQ(built.summary.status, Status::stable) << built.summary.message;
    const double weight = 5000.0 * testing::kG;
    EXPECT_NEAR(normal_force(built.frames.back(), 1, 3), (weight - 2.0 * down / c) / 3.0, 1.0);
    EXPECT_NEAR(built.frames.back().blocks.displacement[1].z(), -down, 1e-12);
  }
}

// What stands on one support follows it as a body: a tie from there to a block keeps its force.
TEST(Construction, ASupportThatMovesWithItsColumnStrainsNoTie) {
  const auto force = [](const Vec3& shift, const Vec3& turn) {
    Case scene = level_case(1e-9, true);
    PairTie tie;
    tie.block_a = 0;
    tie.block_b = 3;
    tie.point_a = Vec3(0.5, 0.5, 0.0);
    tie.point_b = Vec3(0.2, 0.3, 2.5);
    tie.stiffness = 2e5;
    tie.prestress = 1e3;
    scene.ties.pairs = {tie};
    scene.supports.moves = {
        SupportMove{.region = {.blocks = {0}}, .displacement = shift, .rotation_deg = turn, .time = {}}};
    const Built built = build(scene, testing::stack_of_cubes(1.0, std::vector<double>(3, 1000.0)));
    EXPECT_EQ(built.summary.status, Status::stable) << built.summary.message;
    return built.frames.back().ties.force[0];
  };
  const double unmoved = force({0, 0, 0}, {0, 0, 0});
  constexpr double kSolve = 0.1;  // N: the tolerance of the solve, of the weight of 29 kN
  EXPECT_NEAR(force({0.3, 0.1, 0}, {0, 0, 0}), unmoved, kSolve);
  EXPECT_NEAR(force({0, 0, 0}, {0, 0, 5}), unmoved, kSolve);
}

// A course on a frictionless slope between uprights, with heads that nothing presses, holds by the cohesion of
// its bed, gamma h sin theta. A millionth less is enough for a verdict (1e-5), not for a state that is carried
// on to 1e-10, which has the next higher value.
TEST(Construction, CarriesOnWhatObeysTheTolerance) {
  constexpr double kTheta = 0.7, kTolerance = 1e-10;
  const testing::CourseSpec course{.bricks = 4, .length = 0.68, .uprights = true};
  const Assembly assembly = testing::make_course(course);
  Case scene = testing::course_case(kTheta, 0.0);
  scene.joints.head = testing::joint_law(0.1);
  scene.analysis.tolerance = kTolerance;
  scene.analysis.staged.least = StagedConstruction::Least::cohesion;
  Construction building(scene, assembly, [](const std::string&) {});
  building.lay({1}, testing::kFirstCourse);
  building.accept(building.solve(Construction::Need::forces));
  building.lay({2, 3, 4, 5}, testing::kFirstCourse);
  const double least = testing::kGamma * course.height * std::sin(kTheta);
  Bracket bracket;
  bracket.stable.value = (1.0 - 1e-6) * least;
  bracket.moving.value = (1.0 - 1e-5) * least;
  const StaticSolution verdict = building.solve(bracket.stable.value);
  ASSERT_EQ(verdict.outcome, StaticOutcome::equilibrium) << verdict.message;
  ASSERT_GT(verdict.balance.residual, kTolerance);
  const StaticSolution carried = building.solve_least(bracket);
  ASSERT_EQ(carried.outcome, StaticOutcome::equilibrium) << carried.message;
  EXPECT_LE(carried.balance.residual, kTolerance);
}

// Joints so soft that each cube sinks by 0.2 m: forces are still those of the geometry as built.
TEST(Construction, SaysThatDisplacementsAreLarge) {
  for (const double sinks : {0.02, 0.2}) {
    const Assembly column = testing::stack_of_cubes(1.0, {1000.0});
    const Summary summary = build(level_case(sinks / (1000.0 * testing::kG), true), column).summary;
    ASSERT_EQ(summary.status, Status::stable) << summary.message;
    ASSERT_EQ(summary.warnings.size(), sinks > 0.1 ? 1u : 0u);
    for (const std::string& warning : summary.warnings)
      EXPECT_TRUE(warning.starts_with("the largest displacement of 0.2 m is not small")) << warning;
  }
}

}  // namespace
}  // namespace cupola::carried_test
