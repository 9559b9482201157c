#include "postproc/mechanics/joint_wrenches.hpp"

#include <gtest/gtest.h>

#include "tests/postproc/models.hpp"

namespace cupola::joint_wrenches_test {
namespace {

/// The joints of the support with a stone and of that with a second one, both upright: their normals lie along
/// x but for rounding.
JointWrenches upright(double rounding, int ring_of_second) {
  Assembly a = test::column(2);
  a.blocks[2].ring = ring_of_second;
  ContactTable c = test::column_at_rest(a, 9.81, 0.0, 0.6, 0.4).contacts;
  for (int i = 0; i < c.size(); ++i) {
    c.point[i] = {0.0, c.point[i].y(), c.point[i].x()};
    c.normal[i] = {1.0, 0.0, rounding};
  }
  return joint_wrenches(a, c, shell_of(test::column(2), Vec3::UnitZ()));
}

TEST(JointWrenches, AnUprightSupportCarriesTheStone) {
  for (const double rounding : {-1e-12, -1e-16, 0.0, 1e-16, 1e-12})  // of a model 1 km from the origin
    for (const int ring : {0, 1}) {
      for (const JointWrench& joint : upright(rounding, ring).wrenches) {
        if (joint.block_a == 0) {
          EXPECT_EQ(joint.carried, 1) << rounding;
          EXPECT_EQ(joint.lower, 0) << rounding;
        } else {
          EXPECT_EQ(joint.carried, ring == 1 ? 2 : -1) << "stones of one course lean on each other";
          EXPECT_EQ(joint.upper, joint.carried) << rounding;
        }
      }
    }
}

}  // namespace
}  // namespace cupola::joint_wrenches_test
