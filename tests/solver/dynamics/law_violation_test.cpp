#include "solver/dynamics/law_violation.hpp"

#include <gtest/gtest.h>

namespace cupola::law_violation_test {
namespace {

/// Two contacts in each of four joints.
ContactSet four_joints() {
  ContactSet contacts;
  contacts.patches.resize(4);
  for (int i = 0; i < 8; ++i) {
    contacts.points.emplace_back();
    contacts.points.back().patch = i / 2;
  }
  return contacts;
}

// Joints of 1000, 1000, 1 and 0 N s: the mean of the loaded ones is 667, of which 1 % is 6.67.
TEST(LawViolation, IsRelativeToTheForceOfTheJointAndSmallJointsToOnePercentOfTheMean) {
  VecX gamma = VecX::Zero(24);
  for (const int i : {0, 1, 2, 3}) gamma[3 * i] = 500.0;
  gamma[3 * 4 + 1] = -1.0;
  const double smallest = 0.01 * 2001.0 / 3.0;
  const std::vector<double> v =
      law_violations(four_joints(), gamma, (VecX(8) << 0.0, 1.0, 0.0, 880.0, 0.5, 0.0, 0.0, 2.0).finished());
  EXPECT_EQ(v[0], 0.0);
  EXPECT_DOUBLE_EQ(v[1], 1e-3);
  EXPECT_DOUBLE_EQ(v[3], 0.88);
  EXPECT_DOUBLE_EQ(v[4], 0.5 / smallest);
  EXPECT_DOUBLE_EQ(v[7], 2.0 / smallest);
}

TEST(LawViolation, IsOneWhereAForceIsMissingEverywhere) {
  const VecX errors = VecX::Constant(8, 3.0);
  EXPECT_EQ(law_violations(four_joints(), VecX::Zero(24), errors), std::vector<double>(8, 1.0));
  EXPECT_EQ(law_violations(four_joints(), VecX::Zero(24), VecX::Zero(8)), std::vector<double>(8, 0.0));
}

}  // namespace
}  // namespace cupola::law_violation_test
