#include <gtest/gtest.h>

#include "solver/dynamics/joint_laws.hpp"
#include "tests/solver/accounted_simulation.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::joint_law_test {
namespace {

JointLawChange with_friction(double mu) {
  JointLawChange law;
  law.friction = mu;
  return law;
}

using testing::make_case;

struct WallLaws {
  JointLaw base, bed, head;
};

/// Laws of the joints of a two-course wall: on the floor, between the courses, within the upper course.
WallLaws laws_of(const Joints& joints, const Assembly& wall) {
  const JointTable table(joints, 2);
  ContactDetector detector(wall, {});
  WallLaws laws;
  const ContactSet& set = detector.update(initial_poses(wall));
  for (const Patch& patch : set.patches) {
    const JointLaw law = table.law(wall, patch, 2.0);
    if (patch.kind == JointKind::base) laws.base = law;
    if (patch.kind == JointKind::bed) laws.bed = law;
    if (patch.kind == JointKind::head && patch.ring == 1) laws.head = law;
  }
  return laws;
}

TEST(JointLaws, LawOfARingOverridesLawOfAClassOverridesGeneralLaw) {
  const Assembly wall = testing::running_bond_wall({1.0, 0.5, 0.3}, 3, 2);
  Joints joints;
  joints.friction = 0.4;
  joints.compliance = {1e-8, 2e-8, Compliance::Per::point};
  joints.bed = JointLawChange{};
  joints.bed->friction = 0.3;
  joints.bed->normal = 5e-8;
  joints.base = JointLawChange{};
  joints.base->friction = 0.7;
  WallLaws laws = laws_of(joints, wall);
  EXPECT_EQ(laws.base.mu, 0.7);
  EXPECT_EQ(laws.bed.mu, 0.3);
  EXPECT_EQ(laws.bed.compliance_normal, 5e-8);
  EXPECT_EQ(laws.bed.compliance_tangential, 2e-8);
  EXPECT_EQ(laws.head.mu, 0.4);

  joints.rings = {{.from = 1, .to = 1, .sort = RingJoints::Sort::all, .law = with_friction(0.2)},
                  {.from = 0, .to = 5, .sort = RingJoints::Sort::head, .law = with_friction(0.1)}};
  laws = laws_of(joints, wall);
  EXPECT_EQ(laws.base.mu, 0.7) << "ring 0";
  EXPECT_EQ(laws.bed.mu, 0.2) << "ring 1";
  EXPECT_EQ(laws.head.mu, 0.1) << "the last group that applies";
}

// A group of rings reaches each class of joint by its own kind, and only that class.
TEST(JointLaws, EveryKindOfJointCanBeChosenInARing) {
  Assembly stack = testing::stack_of_cubes(1.0, {1000.0, 1000.0});
  Patch patch;
  patch.block_a = 1;
  patch.block_b = 2;
  patch.ring = 1;
  using Sort = RingJoints::Sort;
  const auto friction_of = [&](Sort sort, JointKind kind, bool pieces) {
    stack.blocks[1].name = pieces ? "brick#1" : "";
    stack.blocks[2].name = pieces ? "brick#2" : "";
    patch.kind = kind;
    Joints joints;
    joints.rings = {{.from = 1, .to = 1, .sort = sort, .law = with_friction(0.2)}};
    return JointTable(joints, 2).law(stack, patch, 1.0).mu;
  };
  for (const Sort sort : {Sort::wythe, Sort::pieces, Sort::other}) {
    EXPECT_EQ(friction_of(sort, JointKind::wythe, false), sort == Sort::wythe ? 0.2 : 0.4);
    EXPECT_EQ(friction_of(sort, JointKind::other, true), sort == Sort::pieces ? 0.2 : 0.4);
    EXPECT_EQ(friction_of(sort, JointKind::other, false), sort == Sort::other ? 0.2 : 0.4);
    EXPECT_EQ(friction_of(sort, JointKind::bed, false), 0.4);
  }
}

TEST(JointLaws, CompliancePerAreaIsDividedByTheArea) {
  const Assembly wall = testing::running_bond_wall({1.0, 0.5, 0.3}, 3, 2);
  Joints joints;
  joints.compliance = {1e-8, 2e-8, Compliance::Per::area};
  EXPECT_EQ(laws_of(joints, wall).bed.compliance_normal, 0.5e-8);
  EXPECT_EQ(laws_of(joints, wall).bed.compliance_tangential, 1e-8);
}

TEST(JointLaws, JointsOfHerringboneBlocksAreHerringboneExceptOnSupports) {
  Assembly stack = testing::stack_of_cubes(1.0, {1000.0, 1000.0});
  stack.blocks[1].kind = BlockKind::herringbone;
  Patch patch;
  patch.block_a = 1;
  patch.block_b = 2;
  patch.kind = JointKind::bed;
  EXPECT_EQ(joint_class(stack, patch, true), JointClass::herringbone_bed);
  patch.block_a = 0;
  patch.block_b = 1;
  patch.kind = JointKind::base;
  EXPECT_EQ(joint_class(stack, patch, true), JointClass::base);
}

TEST(JointLaws, PiecesOfOneImportedBlockHaveTheirOwnLaw) {
  Assembly stack = testing::stack_of_cubes(1.0, {1000.0, 1000.0});
  Patch patch;
  patch.block_a = 1;
  patch.block_b = 2;
  patch.kind = JointKind::other;
  const auto class_of = [&](const char* a, const char* b) {
    stack.blocks[1].name = a;
    stack.blocks[2].name = b;
    return joint_class(stack, patch, true);
  };
  EXPECT_EQ(class_of("brick 7#1", "brick 7#2"), JointClass::pieces);
  EXPECT_EQ(class_of("brick 7#1", "brick 8#1"), JointClass::other);
  EXPECT_EQ(class_of("brick 7#1", "brick 77#1"), JointClass::other);
  EXPECT_EQ(class_of("brick 7", "brick 7#1"), JointClass::other);
  EXPECT_EQ(class_of("", ""), JointClass::other);
  Joints joints;
  joints.pieces.emplace();
  joints.pieces->friction = 0.9;
  class_of("a#1", "a#2");
  EXPECT_EQ(JointTable(joints, 1).law(stack, patch, 1.0).mu, 0.9);
}

// Names like "Block #1" are common: without a law of pieces, they leave a bed a bed.
TEST(JointLaws, NamesOfPiecesHaveNoMeaningWithoutTheirLaw) {
  Assembly stack = testing::stack_of_cubes(1.0, {1000.0, 1000.0});
  stack.blocks[1].name = "a#1";
  stack.blocks[2].name = "a#2";
  Patch patch;
  patch.block_a = 1;
  patch.block_b = 2;
  patch.kind = JointKind::bed;
  Joints joints;
  joints.bed.emplace().friction = 0.1;
  EXPECT_EQ(JointTable(joints, 1).law(stack, patch, 1.0).mu, 0.1);
  joints.rings.push_back({.sort = RingJoints::Sort::pieces, .law = joints.bed.value()});
  joints.rings.front().law.friction = 0.9;
  EXPECT_EQ(JointTable(joints, 1).law(stack, patch, 1.0).mu, 0.9);
}

// A block on an incline with slope tan a = 0.3 while friction falls from 0.4 to 0.2 in 1 s. It starts to
// slide when mu = 0.3, at t = 0.5 s, and then accelerates by g (sin a - mu(t) cos a).
TEST(FrictionInTime, BlockSlidesWhenFrictionFallsBelowTheSlope) {
  const Assembly assembly = testing::box_on_floor({1.0, 1.0, 0.2});
  const double h = 1e-3;
  Case scene = make_case(0.4, 1e-14, h);
  scene.loads.gravity = testing::tilted_gravity(0.3);
  scene.joints.friction_time = RampInTime{.from = 1.0, .to = 0.5, .start = 0.0, .duration = 1.0};
  testing::AccountedSimulation simulation(scene, assembly);
  for (int step = 0; step < 490; ++step) simulation.advance();
  EXPECT_LT(simulation.state().v.norm(), 1e-6);
  for (int step = 490; step < 1000; ++step) simulation.advance();
  // Integral of g cos a (0.3 - mu) from 0.5 to 1 s with mu falling by 0.2 per second. Tolerance: the scheme
  // is first order in h, and the associated law lags by A h mu^2 (see
  // Incline.SlidesAsTheClosedFormOfTheAssociatedScheme).
  const double expected = testing::kG * std::cos(std::atan(0.3)) * 0.1 * 0.25;
  EXPECT_NEAR(simulation.state().v[0], expected, 3 * testing::kG * h);
}

}  // namespace
}  // namespace cupola::joint_law_test
