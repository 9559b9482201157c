#include "postproc/mechanics/reactions.hpp"

#include <gtest/gtest.h>

#include "postproc/mechanics/chain_forces.hpp"
#include "postproc/report/report.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::reactions_test {
namespace {

using test::kGravity;

constexpr double kRounding = 1e-12;  // m and m2: sums of four numbers near 1

// The support bears a wythe 0.8 m thick, half of the shell, on 0.96 m2. Beside a cavity these are 1.2 m of
// support; beside another wythe on 0.96 m2 each is half of 1.2 m.
TEST(Reactions, LengthOfSupportIsThatOfAllWythesWithoutCavities) {
  const Assembly a = test::column_with_wythes();
  Shell shell = shell_of(a, Vec3::UnitZ());
  const Frame frame = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4);
  const JointWrenches joints = joint_wrenches(a, frame.contacts, shell);
  ASSERT_EQ(support_reactions(a, joints, shell).size(), 1u);
  EXPECT_NEAR(support_reactions(a, joints, shell)[0].length, 1.2, kRounding);
  BedFacet beside = shell.beds[0].at(0);
  for (Vec3* corner : {&beside.intrados_a, &beside.intrados_b, &beside.extrados_a, &beside.extrados_b})
    corner->y() += 0.8;
  beside.from = 0.5;
  beside.to = 1.0;
  shell.beds[0].push_back(beside);
  EXPECT_NEAR(support_reactions(a, joints, shell)[0].length, 0.6, kRounding);
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

// The joint of the last course of a rib with its support lies on no bed, near the first one of the next
// member, four times as thick.
TEST(Reactions, LengthIsThatOnTheBedsOfTheMemberItself) {
  Assembly a = test::column(3);
  Shell shell = shell_of(a, Vec3::UnitZ());
  const Frame frame = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4);
  const JointWrenches joints = joint_wrenches(a, frame.contacts, shell);
  const double length = support_reactions(a, joints, shell).at(0).length;
  a.sheets = {{.name = "rib", .num_rings = 1}, {.name = "web", .first_ring = 1, .num_rings = 2}};
  shell = shell_of(a, Vec3::UnitZ());
  for (BedFacet& facet : shell.beds[0])
    for (Vec3* corner : {&facet.intrados_a, &facet.intrados_b, &facet.extrados_a, &facet.extrados_b})
      corner->z() -= 10.0;
  for (BedFacet& facet : shell.beds[1]) {
    facet.extrados_a += 3.0 * (facet.extrados_a - facet.intrados_a);
    facet.extrados_b += 3.0 * (facet.extrados_b - facet.intrados_b);
  }
  EXPECT_NEAR(support_reactions(a, joints, shell).at(0).length, length, kRounding);
}

// The back of the last course of a rib is cut along the web, so that the shell has no facet on its bed: the
// thickness is that at the end of the course, of a shell of one wythe and of several.
TEST(Reactions, LengthIsThatAtTheEndOfACutCourse) {
  for (Assembly a : {test::column(3), test::column_with_wythes()}) {
    Shell shell = shell_of(a, Vec3::UnitZ());
    const Frame frame = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4);
    const JointWrenches joints = joint_wrenches(a, frame.contacts, shell);
    const double length = support_reactions(a, joints, shell).at(0).length;
    a.sheets = {{.name = "rib", .num_rings = 1}, {.name = "web", .first_ring = 1, .num_rings = 2}};
    shell = shell_of(a, Vec3::UnitZ());
    shell.beds[0].clear();
    EXPECT_NEAR(support_reactions(a, joints, shell).at(0).length, length, kRounding);
  }
}

// The thrust of a pier between two equal spans is what rounding leaves of two that cancel.
TEST(Reactions, OutwardForcesOfRoundingAreNone) {
  Assembly a = test::column(3);
  a.sheets = {{"vault", 0, 3, true, Sheet::ThrustLines::by_azimuth}};
  const Shell shell = shell_of(a, Vec3::UnitZ());
  const auto outward = [&](double push) {  // N, of each corner away from the axis at the origin
    ContactTable contacts = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4).contacts;
    for (Vec3& force : contacts.force) force -= push * Vec3(0.6, 0.4, 0.0).normalized();
    return support_reactions(a, joint_wrenches(a, contacts, shell), shell).at(0).outward;
  };
  EXPECT_EQ(outward(1e-12), 0.0);
  EXPECT_NEAR(outward(1e3), 4e3, 1e-9) << "rounding of sums";
}

// A tie of 1 kN from block 2 down to the support pulls it up, and another, from block 3 to an anchor without
// joints, pulls that; a restraint, which follows the ties, pushes on the ground.
TEST(Reactions, CountTheTiesOfTheSupports) {
  Assembly a = test::column(3);
  a.blocks.push_back(a.blocks[0]);
  const Shell shell = shell_of(a, Vec3::UnitZ());
  const Frame frame = test::column_at_rest(test::column(3), kGravity, 0.0, 0.6, 0.4);
  TieTable ties;
  ties.block_a = {0, 3, 0};
  ties.block_b = {2, 4, 1};
  ties.point_a = {Vec3(0.6, 0.4, 0.0), Vec3(0.6, 0.4, 1.25), Vec3(-1.0, 0.4, 0.25)};
  ties.point_b = {Vec3(0.6, 0.4, 0.75), Vec3(5.0, 0.4, 1.25), Vec3(0.0, 0.4, 0.25)};
  ties.force = {1e3, 2e3, 4e3};
  ties.strut = {0, 0, 0};
  const std::vector<Reaction> reactions =
      support_reactions(a, joint_wrenches(a, frame.contacts, shell), shell, ties, 2);
  ASSERT_EQ(reactions.size(), 2u);
  const double weight = free_weight(a, kGravity);
  EXPECT_LT((reactions[0].force - Vec3(0, 0, 1e3 - weight)).norm(), 1e-12 * weight) << "rounding of sums";
  EXPECT_EQ(reactions[1].block, 4);
  EXPECT_EQ(reactions[1].force, Vec3(-2e3, 0, 0));
  EXPECT_EQ(reactions[1].length, 0.0);
}

// One bar is at its yield force, as far as the solver rounds; two have elongated before.
TEST(Chains, YieldWhereTheyPullWithTheirYieldForce) {
  TieTable ties;
  ties.chain = {0, 0, 0};
  ties.point_a.assign(3, Vec3::Zero());
  ties.point_b.assign(3, Vec3::UnitX());
  ties.force = {30e3 * (1.0 - 1e-8), 16e3, 0.0};
  ties.yield_force.assign(3, 30e3);
  ties.yielded = {0.0, 0.01, 0.02};
  ties.strut = {0, 0, 0};
  std::vector<BuiltChain> chains(1);
  chains[0].name = "rod";
  Evaluation e = test::column_evaluation(0.6, 0.4);
  const auto says = [&](const char* text) {
    e.chains = chain_forces(chains, ties);
    return std::ranges::any_of(finding_sentences(e),
                               [&](const std::string& s) { return s.find(text) != std::string::npos; });
  };
  EXPECT_TRUE(says("; 1 of 3 bars yields; plastic elongation 30 mm in total."));
  ASSERT_EQ(e.chains[0].yielding, 1);
  ties.force.assign(3, 0.0);
  EXPECT_TRUE(says("is slack all round; plastic elongation 30 mm in total."));
  EXPECT_EQ(e.chains[0].yielding, 0);
}

TEST(Reactions, TiesConnectPartsAsJointsDo) {
  const Assembly a = test::column(3);
  EXPECT_EQ(connected_parts(a, {}, {}), (std::vector{-1, 0, 1, 2}));
  EXPECT_EQ(connected_parts(a, {}, test::column_with_a_tie(a).ties), (std::vector{-1, 0, 1, 0}));
}

}  // namespace
}  // namespace cupola::reactions_test
