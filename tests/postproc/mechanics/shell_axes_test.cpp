// Axes of stones whose skins are level, so that the direction from ring to ring runs through them.

#include <gtest/gtest.h>

#include "postproc/mechanics/block_fields.hpp"
#include "tests/postproc/mechanics/key_stone.hpp"

namespace cupola::shell_axes_test {
namespace {

/// Axes of a stone with skins normal to y, heads to x and beds to z, in a shell that climbs along y but for
/// the rounding of a model 1 km from the origin.
ShellAxes level_stone(const Vec3& rounding, FaceKind ends = FaceKind::head) {
  Assembly a = test::column(1);
  for (FaceKind& kind : a.face_kinds)
    if (kind == FaceKind::head) kind = ends;
  Shell shell = shell_of(a, Vec3::UnitZ());
  shell.progress = {(Vec3::UnitY() + rounding).normalized()};
  return shell_axes(a, shell)[1];
}

TEST(ShellAxes, OfALevelCrownStoneLieAcrossItsBarrel) {
  for (const double x : {-1e-12, 0.0, 1e-12})
    for (const double z : {-2e-12, 0.0, 1e-12}) {
      const ShellAxes axes = level_stone({x, 0.0, z});
      ASSERT_TRUE(axes.exists);
      EXPECT_FALSE(axes.pole);
      EXPECT_NEAR(std::abs(axes.m.z()), 1.0, 1e-12);
      EXPECT_NEAR(std::abs(axes.t.x()), 1.0, 1e-12);
    }
}

/// Fields of a key stone, turned about the axis, on which two opposite stones push three times as hard.
BlockFields key_stone(double turn) {
  test::KeyStone dome(turn);
  for (const int i : {0, 1, 2, 3, 16, 17, 18, 19}) dome.contacts.force[i] *= 3.0;
  const Assembly& a = dome.assembly;
  const Shell shell = shell_of(a, Vec3::UnitZ());
  Frame frame;
  frame.contacts = dome.contacts;
  for (const Block& block : a.blocks) frame.blocks.position.push_back(block.centroid);
  const JointWrenches joints = joint_wrenches(a, dome.contacts, shell);
  const std::vector<Wrench> from_below = wrenches_from_below(a, joints);
  return block_fields(a, frame, joints, from_below, {}, shell_axes(a, shell), {}).back();
}

// Beds all round: no direction is the meridian, and both forces are the mean of all.
TEST(ShellAxes, OfAKeyStoneAreAtAPole) {
  EXPECT_TRUE(level_stone(Vec3::Zero(), FaceKind::bed).pole);
  const double force = key_stone(0.0).hoop_force;
  EXPECT_GT(force, 0.1);
  for (const double turn : {0.0, 0.3, 1.1}) {  // rad
    EXPECT_NEAR(key_stone(turn).hoop_force, force, 1e-12 * force) << turn;
    EXPECT_EQ(key_stone(turn).meridional_force, key_stone(turn).hoop_force);
  }
}

// The centroids of the courses of a wall with a raking top are far apart.
TEST(Shell, OfAWallClimbs) {
  Assembly a = test::column(2);
  for (size_t v = 16; v < a.vertices.size(); ++v) a.vertices[v].x() += 10.0;  // m, of the second course
  const Shell shell = shell_of(a, Vec3::UnitZ());
  EXPECT_EQ(shell.direction(0), Vec3::UnitZ());
  ASSERT_EQ(shell.beds[1].size(), 1u);
  EXPECT_EQ(shell.beds[1].front().block, 2);
}

}  // namespace
}  // namespace cupola::shell_axes_test
