// Several members: on each other, beside each other, and what is refused.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "tests/generators/models.hpp"

namespace cupola::members_test {
namespace {

Member tower(const std::string& name, double span) {
  VaultSurface wall;
  wall.profile.kind = Profile::Kind::straight;
  wall.profile.span = span;
  wall.profile.height = 4.0;
  wall.thickness = 1.0;
  Member member;
  member.name = name;
  member.surface = wall;
  member.bond = RunningBond{4, 16, 2};
  return member;
}

Case members_case(std::vector<Member> members) {
  Case c;
  c.geometry.members = std::move(members);
  c.geometry.has_shell = false;
  return c;
}

TEST(Members, StandOnEachOther) {
  Member low = tower("low", 10.0), high = tower("high", 10.4);
  low.at = Place{{3.0, -2.0, 5.0}, 20.0};
  high.on = "low";
  high.bond = RunningBond{3, 11, 2};  // joints that do not match
  ModelReport report;
  const Assembly assembly = check_and_report(members_case({low, high}), &report);
  EXPECT_EQ(report.islands, 1);
  EXPECT_EQ(report.num_supports, 1);
  EXPECT_LT(report.max_joint_gap, 1e-14);
  ASSERT_EQ(assembly.sheets.size(), 2u);
  EXPECT_FALSE(assembly.sheets[0].on_previous);
  EXPECT_TRUE(assembly.sheets[1].on_previous);
  EXPECT_EQ(assembly.stack_of(6), std::pair(0, 7));
  EXPECT_LT((assembly.sheets[1].origin - Vec3(3.0, -2.0, 9.0)).norm(), 1e-14);
  EXPECT_NEAR(assembly.sheets[1].turn, 20.0 * std::numbers::pi / 180.0, 1e-15);
  for (const Block& block : assembly.blocks)
    EXPECT_EQ(block.centroid.z() > 9.0, block.ring >= 4) << "the upper one begins at 5 + 4 m";
}

// A motion of the whole changes no volume and no number.
TEST(Members, MayStandAnywhere) {
  Member moved = tower("moved", 10.0);
  const Case at_origin = members_case({moved});
  moved.at = Place{{100.0, 50.0, -3.0}, 33.0};
  ModelReport here, there;
  const Assembly a = check_and_report(at_origin, &here), b = check_and_report(members_case({moved}), &there);
  EXPECT_EQ(here.num_joints, there.num_joints);
  EXPECT_NEAR(here.volume / there.volume, 1.0, 1e-13);  // rounding of coordinates of 100 m
  const Vec3 moved_first =
      Eigen::AngleAxisd(33.0 * std::numbers::pi / 180.0, Vec3::UnitZ()) * a.blocks.back().centroid +
      Vec3(100.0, 50.0, -3.0);
  EXPECT_LT((b.blocks.back().centroid - moved_first).norm(), 1e-12);
}

TEST(Members, SideBySideAreStacksOfTheirOwn) {
  Member east = tower("east", 6.0), west = tower("west", 6.0);
  west.at = Place{{-11.0, 0.0, 0.0}, 0.0};
  ModelReport report;
  const Assembly assembly = check_and_report(members_case({east, west}), &report);
  EXPECT_EQ(report.islands, 2);
  EXPECT_EQ(assembly.stack_of(3), std::pair(0, 4));
  EXPECT_EQ(assembly.stack_of(4), std::pair(4, 8));
  EXPECT_LT((assembly.outward(5, Vec3(-14.0, 0.0, 1.0)) + Vec3::UnitX()).norm(), 1e-15);
  EXPECT_LT((assembly.outward(1, Vec3(3.0, 0.0, 1.0)) - Vec3::UnitX()).norm(), 1e-15);
}

// A pier and what stands on it, four times round a point; a row of three.
TEST(Members, HaveCopies) {
  Member pier = tower("pier", 3.0), top = tower("top", 3.2);
  pier.at = Place{{6.0, 0.0, 0.0}, 0.0};
  top.on = "pier";
  ModelReport one, four, row;
  check_and_report(members_case({pier, top}), &one);
  pier.copies = Copies{.count = 4, .about = Vec3(-3.0, 0.0, 0.0)};
  const Assembly assembly = check_and_report(members_case({pier, top}), &four);
  EXPECT_NEAR(four.volume / one.volume, 4.0, 1e-13);
  EXPECT_EQ(four.num_joints, 4 * one.num_joints);
  EXPECT_EQ(four.islands, 4);
  ASSERT_EQ(assembly.sheets.size(), 8u);
  EXPECT_EQ(assembly.sheets[2].name, "pier 2");
  EXPECT_EQ(assembly.sheets[3].name, "top 2");
  EXPECT_TRUE(assembly.sheets[3].on_previous);
  EXPECT_EQ(assembly.sheets[2].first_ring, 8);
  EXPECT_LT((assembly.sheets[4].origin - Vec3(-12.0, 0.0, 0.0)).norm(), 1e-14) << "half round";
  EXPECT_EQ(assembly.members, (std::vector<std::string>{"pier", "top", "pier 2", "top 2", "pier 3", "top 3",
                                                        "pier 4", "top 4"}));
  pier.copies = Copies{.count = 3, .by = Vec3(0.0, 7.0, 1.0)};
  const Assembly steps = check_and_report(members_case({pier, top}), &row);
  EXPECT_LT((steps.sheets[4].origin - Vec3(6.0, 14.0, 2.0)).norm(), 1e-14);
}

std::string message_of(const Case& c) {
  try {
    generate(c);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Members, AreRefusedWithTheirNames) {
  Member low = tower("low", 10.0), wide = tower("wide", 20.0), beside = tower("beside", 10.0);
  wide.on = "low";
  EXPECT_NE(message_of(members_case({low, wide})).find("the member wide floats"), std::string::npos);
  beside.at = Place{{8.0, 0.0, 0.0}, 0.0};
  EXPECT_NE(message_of(members_case({low, beside})).find("geometry.members: move one"), std::string::npos);
  Member cap = tower("cap", 10.0);
  cap.on = "low";
  VaultSurface segment;
  segment.profile.kind = Profile::Kind::segmental;
  segment.profile.rise = 2.0;
  segment.thickness = 0.5;
  segment.eye = 1.0;
  cap.surface = segment;
  EXPECT_NE(message_of(members_case({low, cap})).find("the first bed of cap is not level"),
            std::string::npos);
}

}  // namespace
}  // namespace cupola::members_test
