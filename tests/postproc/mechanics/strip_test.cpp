// The strip of a thrust line across the bed under a key stone, in which every stone of the ring below pushes
// towards the axis: these horizontal forces cancel in the key stone, but not in the strip.

#include "postproc/mechanics/strip.hpp"

#include <gtest/gtest.h>

#include "tests/postproc/mechanics/key_stone.hpp"

namespace cupola::strip_test {
namespace {

// As wide as one of the eight stones, wherever it lies: on a stone, between two, and where azimuths jump.
TEST(Strip, UnderAKeyStoneIsPushedByTheStonesInIt) {
  const test::KeyStone dome(0.0);
  const Shell shell = shell_of(dome.assembly, Vec3::UnitZ());
  const JointWrenches joints = joint_wrenches(dome.assembly, dome.contacts, shell);
  const ThrustInput input{
      &dome.assembly, &shell, &dome.contacts, &joints, wrenches_from_below(dome.assembly, joints),
      Vec3::Zero()};
  for (const double azimuth : {0.0, 22.5, 90.0, 157.5, 180.0, -157.5, -22.5}) {
    const ThrustLine line = thrust_line(input, "m", azimuth);
    ASSERT_EQ(line.points.size(), 1u) << azimuth << ": the wedges rest on nothing";
    const ThrustPoint& p = line.points[0];
    EXPECT_EQ(p.bed, 1);
    EXPECT_EQ(p.blocks, 1);
    constexpr double kRounding = 1e-9;  // of shares of a width, some of which are 1e-9 off to be robust
    EXPECT_NEAR(p.v, test::kPush.z(), kRounding) << azimuth;
    EXPECT_NEAR(p.r, test::kPush.norm(), kRounding) << azimuth;
    EXPECT_NEAR(p.position, 0.5, kRounding) << azimuth;
    EXPECT_NEAR(p.compressed_to - p.compressed_from, 1.0, kRounding) << azimuth;
  }
}

}  // namespace
}  // namespace cupola::strip_test
