#include "postproc/mechanics/cracks.hpp"

#include <gtest/gtest.h>

#include "postproc/report/answers.hpp"
#include "postproc/tables/post_summary.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::cracks_test {
namespace {

/// The column with the resultant on the edge x = 0: the two corners at x = 1.2 m of every bed carry nothing.
Frame hinged(double gap) {
  Frame frame = test::column_at_rest(test::column(3), test::kGravity, 0.0, 0.0, 0.4);
  for (int i = 0; i < frame.contacts.size(); ++i)
    if (frame.contacts.normal_force[i] == 0.0) frame.contacts.gap[i] = gap;
  return frame;
}

Evaluation evaluated_with(double gap) {
  const Assembly a = test::column(3);
  return test::evaluated(a, {hinged(gap)}, test::column_summary(a), test::column_case(),
                         test::fresh_folder("results"));
}

// Each of three beds is open along its edge of 0.8 m by 2 mm.
TEST(Cracks, RunAlongTheOpenEdgeOfEveryBed) {
  const Evaluation e = evaluated_with(2e-3);
  const std::vector<Crack> cracks = cracks_of(e.last.frame.contacts, e.last.joints);
  ASSERT_EQ(cracks.size(), 3u);
  for (const Crack& crack : cracks) {
    ASSERT_EQ(crack.open.outline.size(), 2u);
    EXPECT_NEAR((crack.open.outline[1] - crack.open.outline[0]).norm(), 0.8, 1e-12);
    EXPECT_EQ(crack.widest_gap, 2e-3);
  }
  const PostSummary s = post_summary(e);
  // Closed up to the edge x = 0, where its gap is 0, a bed is open over its length of 1.2 m along the wall.
  EXPECT_NEAR(s.crack_length_m.value(), 3 * 1.2, 1e-12);
  EXPECT_EQ(s.widest_crack_m.value(), 2e-3);
}

// The open corners press with what rounding leaves.
TEST(Cracks, AreOpenUpToForcesOfRounding) {
  const Assembly a = test::column(3);
  Frame frame = hinged(2e-3);
  for (double& force : frame.contacts.normal_force)
    if (force == 0.0) force = 1e-19;
  const Evaluation e = test::evaluated(a, {frame}, test::column_summary(a), test::column_case(),
                                       test::fresh_folder("results"));
  EXPECT_EQ(cracks_of(e.last.frame.contacts, e.last.joints).size(), 3u);
}

// The joints of a limit are rigid: gaps of its mechanism are no cracks, and the direct method has none.
TEST(Cracks, HaveNoLengthAndWidthInALimit) {
  const Assembly a = test::column(3);
  Summary summary = test::column_summary(a);
  summary.analysis = AnalysisType::limit;
  const Evaluation e =
      test::evaluated(a, {hinged(2e-3)}, summary, test::column_case(), test::fresh_folder("results"));
  ASSERT_TRUE(at_rest(e));
  EXPECT_FALSE(post_summary(e).crack_length_m);
  EXPECT_FALSE(post_summary(e).widest_crack_m);
}

// A block that lifts one corner: the widest crack is there, although a point has no length.
TEST(Cracks, OfASinglePointCount) {
  const Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.6, 0.4);
  frame.contacts.gap[0] = 2e-3;
  frame.contacts.normal_force[0] = 0.0;
  const Evaluation e = test::evaluated(a, {frame}, test::column_summary(a), test::column_case(),
                                       test::fresh_folder("results"));
  ASSERT_EQ(e.joint_cracks.size(), 1u);
  EXPECT_EQ(e.joint_cracks[0].open.outline.size(), 1u);
  const PostSummary s = post_summary(e);
  EXPECT_NEAR(s.crack_length_m.value(), 1.2, 1e-12) << "to the corners that are closed";
  EXPECT_EQ(s.widest_crack_m.value(), 2e-3);
}

// Rounding errors of the contact points open no joint: the floor is 1e-6 of the size of a block.
TEST(Cracks, AreWiderThanTheFloorOfLengths) {
  const Evaluation e = evaluated_with(1e-12);
  EXPECT_GT(e.last.joints.floor.length, 1e-8);
  EXPECT_TRUE(cracks_of(e.last.frame.contacts, e.last.joints).empty());
  for (const JointWrench& joint : e.last.joints.wrenches) EXPECT_EQ(joint.opening, 0.0);
}

// A joint with tensile strength that pulls has a gap but no crack: what counts is the opening beyond its
// elastic elongation.
TEST(Cracks, AreNotTheElasticElongationOfAJoint) {
  Evaluation e = evaluated_with(2e-3);
  ContactTable& contacts = e.last.frame.contacts;
  contacts.crack_opening.assign(static_cast<size_t>(contacts.size()), 0.0);
  EXPECT_TRUE(cracks_of(contacts, e.last.joints).empty());
  contacts.crack_opening = contacts.gap;
  EXPECT_EQ(cracks_of(contacts, e.last.joints).size(), 3u);
}

// Softening or plastic, a joint that is open beyond its elastic elongation is cracked while it still pulls.
TEST(Cracks, MayStillPull) {
  Frame frame = hinged(2e-3);
  ContactTable& contacts = frame.contacts;
  contacts.friction_limit = contacts.strength_use = contacts.damage = contacts.crack_opening = contacts.gap;
  for (int i = 0; i < contacts.size(); ++i)
    if (contacts.gap[i] > 0.0) contacts.normal_force[i] = -1e3;
  const Assembly a = test::column(3);
  const Evaluation e = test::evaluated(a, {frame}, test::column_summary(a), test::column_case(),
                                       test::fresh_folder("results"));
  ASSERT_EQ(e.joint_cracks.size(), 3u);
  for (const Crack& crack : e.joint_cracks) EXPECT_EQ(crack.widest_gap, 2e-3);
  for (const JointWrench& joint : e.last.joints.wrenches) EXPECT_EQ(joint.open_share, 0.0) << "it is loaded";
}

// The opening of a joint and of the blocks beside it is that of its crack: faces that were crushed by 1 mm are
// farther apart than their gap, and those of a joint that pulls closer.
TEST(Cracks, AreAsWideAsTheOpeningOfTheirJoint) {
  const Assembly a = test::column(3);
  for (const double apart : {0.0, 3e-3}) {
    Frame frame = hinged(2e-3);
    ContactTable& contacts = frame.contacts;
    contacts.friction_limit = contacts.strength_use = contacts.damage = contacts.crack_opening = contacts.gap;
    for (double& opening : contacts.crack_opening) opening = opening > 0.0 ? apart : 0.0;
    const Evaluation e = test::evaluated(a, {frame}, test::column_summary(a), test::column_case(),
                                         test::fresh_folder("results"));
    for (const JointWrench& joint : e.last.joints.wrenches) EXPECT_EQ(joint.opening, apart);
  }
}

TEST(Cracks, NeedAGap) {
  const Evaluation e = evaluated_with(0.0);
  EXPECT_TRUE(cracks_of(e.last.frame.contacts, e.last.joints).empty());
  EXPECT_EQ(post_summary(e).crack_length_m.value(), 0.0);
}

// Statics of a case whose supports move on a path: its cracks are those before the movement.
TEST(Cracks, AreNotThoseOfSupportsThatHaveNotMoved) {
  Evaluation e = evaluated_with(2e-3);
  SupportMove move;
  move.displacement.z() = -0.01;
  e.scene.supports.moves = {move};
  const std::string widest = crack_answer(e).value().value;
  EXPECT_NE(widest, "none") << "moved from the start";
  e.scene.supports.moves[0].time = RampInTime{};
  EXPECT_EQ(crack_answer(e).value().value, "not computed");
  EXPECT_FALSE(post_summary(e).widest_crack_m);
  e.last.frame.role = FrameRole::path;
  EXPECT_EQ(crack_answer(e).value().value, widest) << "of a path, which follows the movement";
}

}  // namespace
}  // namespace cupola::cracks_test
