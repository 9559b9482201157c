#include "postproc/mechanics/reactions.hpp"

#include <gtest/gtest.h>

#include "tests/postproc/scene.hpp"

namespace cupola::reactions_test {
namespace {

using test::kGravity;

constexpr double kRounding = 1e-12;  // m and m2: sums of four numbers near 1

// The support bears a wythe 0.8 m thick, half of the shell: 0.96 m2 of 1.6 m are 0.6 m of support.
TEST(Reactions, LengthOfSupportIsThatOfTheWholeShell) {
  const Assembly a = test::column_with_wythes();
  const Shell shell = shell_of(a, Vec3::UnitZ());
  const Frame frame = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4);
  const std::vector<Reaction> reactions =
      support_reactions(a, joint_wrenches(a, frame.contacts, shell), shell);
  ASSERT_EQ(reactions.size(), 1u);
  EXPECT_NEAR(reactions[0].length, 0.6, kRounding);
}

// The column stands on two feet that cover half of the bed's outline: 0.48 m2, on 0.6 m of a shell of 0.8 m.
TEST(Reactions, AreasAreThoseOfTheContactsNotOfTheirHull) {
  const Assembly a = test::column(3);
  const Shell shell = shell_of(a, Vec3::UnitZ());
  Frame frame = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4);
  for (double& area : frame.contacts.area) area = 0.12;
  const JointWrenches joints = joint_wrenches(a, frame.contacts, shell);
  for (const JointWrench& joint : joints.wrenches) EXPECT_NEAR(joint.area, 0.48, kRounding);
  EXPECT_NEAR(support_reactions(a, joints, shell).at(0).length, 0.6, kRounding);
}

}  // namespace
}  // namespace cupola::reactions_test
