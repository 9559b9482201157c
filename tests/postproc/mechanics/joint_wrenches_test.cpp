#include "postproc/mechanics/joint_wrenches.hpp"

#include <gtest/gtest.h>

#include "postproc/mechanics/ring_sums.hpp"
#include "tests/postproc/models.hpp"

namespace cupola::joint_wrenches_test {
namespace {

/// The joints of the support with a stone and of that with a second one, both upright: their normals lie along
/// x but for a slope.
JointWrenches upright(double slope, int ring_of_second) {
  Assembly a = test::column(2);
  a.blocks[2].ring = ring_of_second;
  ContactTable c = test::column_at_rest(a, 9.81, 0.0, 0.6, 0.4).contacts;
  for (int i = 0; i < c.size(); ++i) {
    c.point[i] = {0.0, c.point[i].y(), c.point[i].x()};
    c.normal[i] = Vec3(1.0, 0.0, slope).normalized();
  }
  return joint_wrenches(a, c, shell_of(test::column(2), Vec3::UnitZ()));
}

TEST(JointWrenches, ASupportBesideAStoneIsNeitherAboveNorBelow) {
  for (const double slope : {-0.3, -1e-12, 0.0, 1e-12, 0.3}) {  // rounding of a model 1 km from the origin
    const JointWrench joint = upright(slope, 1).wrenches.front();
    ASSERT_EQ(joint.kind, JointKind::base);
    EXPECT_EQ(joint.upper, -1) << slope;
    EXPECT_EQ(joint.lower, -1) << slope;
    EXPECT_EQ(joint.carried, -1) << slope;
  }
}

TEST(RingSums, CountTheThrustOnASupportBesideAStone) {
  Assembly a = test::column(1);
  a.sheets.front().thrust_lines = Sheet::ThrustLines::by_azimuth;
  ContactTable c = test::column_at_rest(a, 9.81, 0.0, 0.6, 0.4).contacts;
  for (int i = 0; i < c.size(); ++i) {
    c.normal[i] = -Vec3::UnitX();  // at x > 0, from the support to the stone
    c.force[i] = {-10.0, 0.0, 0.0};
    c.point[i] = {1.2, 0.0, 0.1 * i};
  }
  const Shell shell = shell_of(a, Vec3::UnitZ());
  const JointWrenches joints = joint_wrenches(a, c, shell);
  ASSERT_EQ(joints.wrenches.front().upper, -1);
  const std::vector<RingSum> rings =
      ring_sums(a, shell, joints, wrenches_from_below(a, joints), {0.0, 0.0, -9.81}, {});
  EXPECT_DOUBLE_EQ(rings.front().radial_thrust, 40.0);
}

// Beds of a vault cut on one side may lean any way.
TEST(JointWrenches, OfTwoCoursesTheHigherNumberIsAbove) {
  for (const double slope : {-0.3, -1e-12, 0.0, 1e-12, 0.3})
    EXPECT_EQ(upright(slope, 1).wrenches.back().carried, 2) << slope;
}

TEST(JointWrenches, StonesOfOneCourseLeanOnEachOther) {
  for (const double rounding : {-1e-12, 0.0, 1e-12})
    EXPECT_EQ(upright(rounding, 0).wrenches.back().upper, -1) << rounding;
}

}  // namespace
}  // namespace cupola::joint_wrenches_test
