// What the members of a shell with wythes carry, on joints whose forces are given.

#include "postproc/mechanics/member_sums.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cupola::member_sums_test {
namespace {

Block block(int ring, int member, double mass) {
  Block b;
  b.ring = ring;
  b.member = member;
  b.mass = mass;
  b.fixed = ring < 0;
  return b;
}

JointWrench joint(int a, int b, const Vec3& force_on_b, const Vec3& centroid) {
  JointWrench j;
  j.block_a = a;
  j.block_b = b;
  j.wrench = {centroid, force_on_b, Vec3::Zero()};
  j.centroid = j.patch.centroid = centroid;
  return j;
}

// Two leaves on a support, the second of which ends below a header of a third member on both.
TEST(MemberSums, AddTheForcesFromBelowEachCut) {
  Assembly assembly;
  assembly.members = {"back", "front", "header"};
  assembly.blocks = {block(-1, 0, 1.0), block(0, 0, 2.0), block(0, 1, 1.0), block(1, 2, 3.0)};
  JointWrenches joints;
  joints.wrenches = {joint(0, 1, {0, 0, 45}, {1, 0, 0}), joint(0, 2, {0, 0, 15}, {2, 0, 0}),
                     joint(1, 3, {-4, 0, 20}, {1, 0, 1}), joint(2, 3, {-1, 0, 10}, {2, 0, 1}),
                     joint(1, 2, {7, 0, 0}, {1.5, 0, 0.5})};  // in the course: crosses no cut
  assembly.sheets = {{.name = "shell", .num_rings = 2, .thrust_lines = Sheet::ThrustLines::by_azimuth}};
  const std::vector<MemberSum> sums = member_sums(assembly, joints, {0, 0, -10});
  ASSERT_EQ(sums.size(), 3u);
  EXPECT_EQ(sums[0].ring, 0);
  EXPECT_EQ(sums[0].member, 0);
  EXPECT_EQ(sums[0].blocks, 1);
  EXPECT_DOUBLE_EQ(sums[0].weight, 20.0);
  EXPECT_DOUBLE_EQ(sums[0].vertical_force, 45.0);
  EXPECT_DOUBLE_EQ(sums[0].share, 0.75);
  EXPECT_DOUBLE_EQ(sums[1].share, 0.25);
  EXPECT_EQ(sums[2].ring, 1);
  EXPECT_EQ(sums[2].member, 2);
  EXPECT_DOUBLE_EQ(sums[2].vertical_force, 30.0);
  EXPECT_DOUBLE_EQ(sums[2].share, 1.0);
  EXPECT_DOUBLE_EQ(sums[2].outward_force, 5.0);  // the header pushes the leaves outwards
  assembly.sheets.front().thrust_lines = Sheet::ThrustLines::none;
  EXPECT_TRUE(std::isnan(member_sums(assembly, joints, {0, 0, -10})[2].outward_force)) << "a wall";
}

// A stage of a construction leaves out the blocks that are not laid.
TEST(MemberSums, LeaveOutBlocksThatTakeNoPart) {
  Assembly assembly;
  assembly.members = {"back"};
  assembly.blocks = {block(-1, 0, 1.0), block(0, 0, 2.0), block(0, 0, 2.0), block(1, 0, 2.0)};
  JointWrenches joints;
  joints.wrenches = {joint(0, 1, {0, 0, 20}, {1, 0, 0})};
  const std::vector<MemberSum> sums = member_sums(assembly, joints, {0, 0, -10}, {false, false, true, true});
  ASSERT_EQ(sums.size(), 1u);
  EXPECT_EQ(sums[0].blocks, 1);
  EXPECT_DOUBLE_EQ(sums[0].weight, 20.0);
}

TEST(MemberSums, AreEmptyForAShellOfOneWythe) {
  Assembly assembly;
  assembly.blocks = {block(-1, 0, 1.0), block(0, 0, 1.0)};
  JointWrenches joints;
  joints.wrenches = {joint(0, 1, {0, 0, 10}, {0, 0, 0})};
  EXPECT_TRUE(member_sums(assembly, joints, {0, 0, -10}).empty());
}

}  // namespace
}  // namespace cupola::member_sums_test
