#include "postproc/mechanics/joint_speeds.hpp"

#include <gtest/gtest.h>

#include "tests/postproc/scene.hpp"

namespace cupola::joint_speeds_test {
namespace {

/// The two upper blocks of a column that stands `moved` from where it was built turn with it about the edge
/// x = 1.2 m, z = 0.5 m of the bed below them.
std::vector<JointSpeeds> speeds_of_column(const Vec3& moved) {
  const Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.6, 0.4);
  for (Vec3& point : frame.contacts.point) point += moved;
  for (const Block& block : a.blocks) frame.blocks.contact_position.push_back(block.centroid + moved);
  for (const size_t b : {2u, 3u}) {
    frame.blocks.velocity[b] = Vec3::UnitY().cross(a.blocks[b].centroid - Vec3(1.2, 0.4, 0.5));
    frame.blocks.angular_velocity[b] = Vec3::UnitY();
  }
  return joint_speeds(a, frame, joint_wrenches(a, frame.contacts, {}));
}

// A limit of supports that spread finds its mechanism in the moved geometry.
TEST(JointSpeeds, AreThoseOfBlocksWhereTheirContactsWereFound) {
  const std::vector<JointSpeeds> built = speeds_of_column(Vec3::Zero()),
                                 moved = speeds_of_column({0.5, -1.0, 0.25});
  ASSERT_EQ(built.size(), 3u);
  int hinges = 0;
  for (size_t j = 0; j < built.size(); ++j) {
    EXPECT_NEAR(moved[j].opening, built[j].opening, 1e-14);
    EXPECT_NEAR(moved[j].sliding, built[j].sliding, 1e-14);
    hinges += moved[j].motion() == JointMotion::hinging;
    EXPECT_NE(moved[j].motion(), JointMotion::sliding);
  }
  EXPECT_EQ(hinges, 1);
}

// The height of what moves is that of its joints: a course may stand on two beds at different heights, as the
// last one of an arch.
TEST(JointSpeeds, GiveTheHeightOfTheJointsThatMove) {
  const Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.6, 0.4);
  for (const size_t b : {2u, 3u}) frame.blocks.velocity[b] = Vec3::UnitX();
  const MechanismMotion motion = mechanism_motion(a, frame, joint_wrenches(a, frame.contacts, {}));
  ASSERT_EQ(motion.by_course.size(), 1u);
  EXPECT_NEAR(motion.by_course.begin()->second.height, 0.5, 1e-12);
}

// The last course of an arch stands on a bed and springs from a support: here the column reaches up to one.
TEST(JointSpeeds, OfTheLastCourseOfAnArchAreThoseOfItsBedAndItsSpringing) {
  const Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.6, 0.4);
  ContactTable& c = frame.contacts;
  const int count = c.size();
  for (int i = 0; i < count; ++i) {
    if (c.block_a[i] != 0) continue;
    c.joint.push_back(3);
    c.block_a.push_back(0);
    c.block_b.push_back(3);
    c.kind.push_back(JointKind::base);
    c.ring.push_back(2);
    c.point.push_back(c.point[i] + Vec3(0, 0, 1.5));
    c.normal.push_back(-c.normal[i]);
    c.force.push_back(-c.force[i]);
    for (std::vector<double>* values :
         {&c.gap, &c.normal_force, &c.friction_use, &c.area, &c.slip, &c.law_violation})
      values->push_back(double((*values)[i]));
  }
  frame.blocks.velocity[3] = Vec3::UnitX();
  const MechanismMotion motion = mechanism_motion(a, frame, joint_wrenches(a, frame.contacts, {}));
  ASSERT_EQ(motion.by_course.size(), 2u);
  const CourseMotion &bed = motion.by_course.at({2, false}), &springing = motion.by_course.at({2, true});
  EXPECT_NEAR(bed.height, 1.0, 1e-12);
  EXPECT_EQ(bed.on, 1);
  EXPECT_NEAR(springing.height, 1.5, 1e-12);
  EXPECT_EQ(springing.on, -1);
}

}  // namespace
}  // namespace cupola::joint_speeds_test
