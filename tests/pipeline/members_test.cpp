// Members side by side: what each stack carries, and its thrust lines.

#include <cmath>

#include <gtest/gtest.h>

#include "tests/pipeline/static_run.hpp"

namespace cupola::members_test {
namespace {

Member arch(const std::string& name, const Eigen::Vector3d& origin, double rotate_deg) {
  ArchSurface surface;
  surface.span = 6.0;
  surface.thickness = 0.8;
  Member member;
  member.name = name;
  member.at = Place{origin, rotate_deg};
  member.surface = surface;
  member.bond = StackBond{11, 1, 1, {}};
  return member;
}

Case two_arches() {
  Case scene;
  scene.geometry.members = {arch("here", Vec3::Zero(), 0.0), arch("there", {20.0, 3.0, 2.0}, 90.0)};
  scene.geometry.has_shell = false;
  scene.joints.friction = 0.7;
  scene.joints.compliance = Compliance::default_per(Compliance::Per::area);
  scene.analysis.tolerance = 1e-10;
  return scene;
}

// Two equal arches carry the same forces wherever they stand.
TEST(MembersSideBySide, CarryTheirOwnLoads) {
  const ProgramFolder folder;
  const Evaluation e = solve_and_evaluate(two_arches(), folder);
  ASSERT_EQ(e.rings.size(), 22u);
  constexpr double kBalance =
      1e-7;  // 1000 times the tolerance of the balance of a block, of which 11 are summed
  for (int k = 0; k < 11; ++k) {
    const RingSum &here = e.rings[k], &there = e.rings[11 + k];
    EXPECT_NEAR(there.load_above.z() / here.load_above.z(), 1.0, 1e-12) << k;
    EXPECT_NEAR(there.joint_force.z(), here.joint_force.z(), kBalance * here.load_above.norm()) << k;
    EXPECT_NEAR(there.radial_thrust, here.radial_thrust, kBalance * e.rings[0].load_above.norm()) << k;
    EXPECT_NEAR(there.height - here.height, 2.0, 1e-12) << k;
  }
  EXPECT_GT(e.rings[0].radial_thrust, 0.0);
  ASSERT_EQ(e.reactions.size(), 4u);
  for (const Reaction& reaction : e.reactions)
    EXPECT_NEAR(reaction.outward / e.reactions[0].outward, 1.0, 1e-6);
}

TEST(MembersSideBySide, HaveThrustLinesOfTheirOwn) {
  const ProgramFolder folder;
  const Evaluation e = solve_and_evaluate(two_arches(), folder);
  ASSERT_EQ(e.meridians.size(), 2u);
  EXPECT_EQ(e.meridians[0].thrust.name, "here");
  EXPECT_EQ(e.meridians[1].thrust.name, "there");
  ASSERT_GE(e.meridians[0].thrust.points.size(), 11u);
  for (int k = 0; k < 11; ++k) {
    const ThrustPoint &here = e.meridians[0].thrust.points[k], &there = e.meridians[1].thrust.points[k];
    EXPECT_EQ(here.bed, k);
    EXPECT_EQ(there.bed, 11 + k);
    EXPECT_NEAR(there.r / here.r, 1.0, 1e-6);
    EXPECT_NEAR(there.position, here.position, 1e-6);
  }
}

}  // namespace
}  // namespace cupola::members_test
