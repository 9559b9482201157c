#include "assembly/model/joint_motion.hpp"

#include <gtest/gtest.h>

namespace cupola::joint_motion_test {
namespace {

// A joint of two points with these speeds along the normal and across it, twice the second.
JointSpeeds joint(double normal, double tangential, double second_normal) {
  JointSpeeds speeds;
  speeds.add(normal, tangential);
  speeds.add(second_normal, 2.0 * tangential);
  return speeds;
}

TEST(JointMotion, IsThatOfTheFasterOfSlidingAndOpening) {
  EXPECT_EQ(joint(0.0, 0.5e-3, 0.9e-3).motion(), JointMotion::closed);
  EXPECT_EQ(joint(0.0, 0.1, 0.15).motion(), JointMotion::sliding);
  EXPECT_EQ(joint(0.0, 0.1, 0.3).motion(), JointMotion::hinging);
  EXPECT_EQ(joint(0.3, 0.1, 0.4).motion(), JointMotion::opening) << "closed nowhere";
}

// Under the associated law all points of a joint that slides open by friction times their sliding. What one
// point opens more than another is turning.
TEST(JointMotion, DilatancyIsNoTurning) {
  const JointSpeeds slides = joint(0.6, 1.0, 0.6);
  EXPECT_EQ(slides.motion(), JointMotion::sliding);
  EXPECT_EQ(slides.turning(), 0.0);
  EXPECT_EQ(joint(0.5, 1.0, 0.75).turning(), 0.25);
  EXPECT_EQ(joint(-0.5, 0.0, 1.0).turning(), 1.0) << "the point that closes crushes";
  EXPECT_EQ(joint(0.5, 0.0, 1.0).turning(), 1.0) << "sides that part";
}

}  // namespace
}  // namespace cupola::joint_motion_test
