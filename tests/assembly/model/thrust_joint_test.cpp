// Which joints push outwards, and which way.

#include "assembly/model/thrust_joint.hpp"

#include <array>

#include <gtest/gtest.h>

namespace cupola::thrust_joint_test {
namespace {

/// Two stones of an arch between x = `low` and 4 m, in the frame of its axis, on a support at each end.
Assembly arch_from(double low) {
  Assembly a;
  a.num_rings = 2;
  a.sheets = {{.name = "arch", .num_rings = 2, .thrust_lines = Sheet::ThrustLines::one}};
  for (const int ring : {-1, 0, 1, -1}) {
    Block& block = a.blocks.emplace_back();
    block.ring = ring;
    block.fixed = ring < 0;
  }
  const double middle = 0.5 * (low + 4.0);
  a.vertices = {{4.0, 0.0, 0.0}, {middle, 0.0, 2.0}, {middle, 1.0, 2.0}, {low, 0.0, 3.0}};
  a.parts = {{.block = 1, .ring = 0}};
  a.add_face(std::array{0, 1, 2}, FaceKind::intrados);
  a.parts.push_back({.block = 2, .ring = 1, .face_start = 1});
  a.add_face(std::array{1, 2, 3}, FaceKind::intrados);
  return a;
}

// A wall that holds a half arch is its other springing, on whichever side of the axis it stands.
TEST(ThrustJoints, OfAHalfArchPushAwayFromTheMiddleOfItsStones) {
  for (const double low : {-4.0, -0.01, 0.0, 0.4}) {
    const Assembly arch = arch_from(low);
    const ThrustJoints joints(arch);
    const Vec3 wall(low, 0.0, 3.0), springing(4.0, 0.0, 0.0);
    EXPECT_EQ(joints.outward(1, wall), Vec3(-1, 0, 0)) << low;
    EXPECT_EQ(joints.outward(0, springing), Vec3(1, 0, 0)) << low;
    EXPECT_TRUE(joints.is_at_far_side(arch.sheets[0], wall)) << low;
    EXPECT_FALSE(joints.is_at_far_side(arch.sheets[0], springing)) << low;
    EXPECT_EQ(joints.bearer(arch.sheets[0], {2, 3, JointKind::base, 0}, wall, Vec3::UnitX()), 3) << low;
  }
}

// Walls have no outside, and sheets on each other push together.
TEST(ThrustJoints, AreThoseOfTheUppermostVaultOfEachStack) {
  using enum Sheet::ThrustLines;
  Assembly a;
  a.num_rings = 4;
  a.sheets = {{.name = "pier", .num_rings = 1, .thrust_lines = one},
              {.name = "arch", .first_ring = 1, .num_rings = 1, .thrust_lines = one, .on_previous = true},
              {.name = "wall", .first_ring = 2, .num_rings = 1},
              {.name = "dome", .first_ring = 3, .num_rings = 1, .thrust_lines = by_azimuth}};
  const std::vector<const Sheet*> pushing = pushing_sheets(a);
  ASSERT_EQ(pushing.size(), 2u);
  EXPECT_EQ(pushing[0]->name, "dome");
  EXPECT_EQ(pushing[1]->name, "arch");
}

}  // namespace
}  // namespace cupola::thrust_joint_test
