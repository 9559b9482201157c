#include "solver/dynamics/laying_order.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/solver/course_scenes.hpp"

// The order in which teams lay the blocks of a course.

namespace cupola::laying_order_test {
namespace {

using testing::make_course;

StagedConstruction rings(int first, int last) {
  StagedConstruction staged;
  staged.first_ring = first;
  staged.last_ring = last;
  return staged;
}

TEST(LayingOrder, TeamsLayEqualArcsInTheOrderOfTheCase) {
  const Assembly course = make_course({.bricks = 7});  // blocks 2 to 8
  StagedConstruction staged;
  staged.unit = StagedConstruction::Unit::block;
  staged.first_ring = testing::kFirstCourse;
  staged.teams = 2;
  std::vector<LaidBlocks> stages = laying_order(course, staged);
  ASSERT_EQ(stages.size(), 4u);
  EXPECT_EQ(stages[0].blocks, (std::vector<int>{2, 5}));
  EXPECT_EQ(stages[2].blocks, (std::vector<int>{4, 7}));
  EXPECT_EQ(stages[3].blocks, (std::vector<int>{8}));
  EXPECT_DOUBLE_EQ(stages[1].share, 0.5);
  staged.teams = 1;
  staged.order = StagedConstruction::Order::alternating;  // it is odd
  EXPECT_EQ(laying_order(course, staged)[0].blocks, (std::vector<int>{8}));
  staged.order = StagedConstruction::Order::given;
  staged.sequence = {5, 3};
  stages = laying_order(course, staged);
  EXPECT_EQ(stages[0].blocks, (std::vector<int>{5}));
  EXPECT_EQ(stages[1].blocks, (std::vector<int>{3}));
  EXPECT_EQ(stages[2].blocks, (std::vector<int>{2}));
  EXPECT_EQ(stages.size(), 7u);
}

// Slots of a mirror image run clockwise. Here four of six sectors, 0 to 180 degrees, about an axis far away.
TEST(LayingOrder, OfAMirrorImageIsSeenFromAbove) {
  for (const bool image : {false, true}) {
    Assembly drum;
    for (int k = 0; k < 4; ++k) {
      testing::add_sector(testing::RingSpec{}.meridian(0.0, 0.5), k, 6, false, 0, &drum);
      if (image) drum.blocks.back().slot = 3 - k;
    }
    for (Vec3& vertex : drum.vertices) vertex.x() += 50.0;
    drum.num_rings = 1;
    drum.sheets = {
        {.name = "drum", .num_rings = 1, .thrust_lines = Sheet::ThrustLines::radial, .origin = {50, 0, 0}}};
    compute_mass_properties(&drum);
    StagedConstruction staged;
    staged.unit = StagedConstruction::Unit::block;
    std::vector<int> order;
    for (const LaidBlocks& stage : laying_order(drum, staged)) order.push_back(stage.blocks.at(0));
    EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3})) << "image " << image;
    staged.order = StagedConstruction::Order::clockwise;
    EXPECT_EQ(laying_order(drum, staged)[0].blocks, (std::vector<int>{3})) << "image " << image;
  }
}

// The rings of an arch run from x > 0 to x < 0. It rises from both springings, here on two courses of a wall.
TEST(LayingOrder, AnArchRisesFromBothSpringings) {
  for (const int voussoirs : {4, 5}) {
    Assembly arch = testing::make_arch({.voussoirs = voussoirs});  // blocks 1, 2, ...
    for (Block& block : arch.blocks)
      if (!block.fixed) block.ring += 2;
    arch.sheets = {
        {.name = "wall", .num_rings = 2},
        {.name = "arch", .first_ring = 2, .num_rings = voussoirs, .thrust_lines = Sheet::ThrustLines::one}};
    const std::vector<LaidBlocks> stages = laying_order(arch, rings(2, -1));
    ASSERT_EQ(static_cast<int>(stages.size()), (voussoirs + 1) / 2);
    EXPECT_EQ(stages[0].blocks, (std::vector<int>{1, voussoirs}));
    EXPECT_EQ(stages[0].ring, 2);
    EXPECT_EQ(stages[1].blocks, (std::vector<int>{2, voussoirs - 1}));
    if (voussoirs == 5) {
      EXPECT_EQ(stages[2].blocks, (std::vector<int>{3})) << "the key";
    }
  }
}

// A wall after an arch of five rings, the last of which (3, 4) are laid with the first.
TEST(LayingOrder, CoursesOfTheNextMemberFollowTheCrown) {
  Assembly assembly = testing::make_arch({.voussoirs = 5});
  assembly.sheets = {{.name = "arch", .num_rings = 5, .thrust_lines = Sheet::ThrustLines::one},
                     {.name = "wall", .first_ring = 5, .num_rings = 2}};
  for (const int ring : {5, 6}) testing::add_box({.center = {5, 0, ring - 4.5}, .ring = ring}, &assembly);
  std::vector<int> lowest, courses;
  for (const LaidBlocks& stage : laying_order(assembly, {})) {
    lowest.push_back(stage.ring);
    courses.push_back(stage.course);
  }
  EXPECT_EQ(lowest, (std::vector<int>{0, 1, 2, 5, 6}));
  EXPECT_EQ(courses, (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_TRUE(laying_order(assembly, rings(3, 4)).empty());
}

}  // namespace
}  // namespace cupola::laying_order_test
