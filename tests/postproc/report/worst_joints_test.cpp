// Which joints a run without equilibrium names, and under which heading.

#include "postproc/report/worst_joints.hpp"

#include <gtest/gtest.h>

#include "postproc/report/report.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::worst_joints_test {
namespace {

// A column in motion, one joint of which has opened by 10 mm.
TEST(WorstJoints, GiveWayOnlyIfItFalls) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.last.frame.role = FrameRole::step;
  e.last.joints.wrenches[0].opening = 0.01;
  e.summary.max_speed_m_per_s = 0.1;
  const auto html = [&e](Status status) {
    e.summary.status = status;
    return worst_joints_html(e);
  };
  const std::string goes_on = html(Status::moving), fallen = html(Status::collapsed);
  EXPECT_NE(goes_on.find("<strong>Joints that moved most</strong>"), std::string::npos) << goes_on;
  EXPECT_EQ(goes_on.find("gives way"), std::string::npos) << goes_on;
  EXPECT_NE(fallen.find("<strong>Where it gives way</strong>"), std::string::npos) << fallen;
  EXPECT_NE(goes_on.find("is open the widest"), std::string::npos) << goes_on;
  e.last.joints.wrenches[0].touches = false;
  EXPECT_EQ(html(Status::moving).find("is open the widest"), std::string::npos) << "of those that touch";
}

// The blocks of a column touch each other along the edge x = 1.2 m of one bed only.
TEST(WorstJoints, ALineThatCarriesIsAHinge) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  const JointWrench bed = e.last.joints.wrenches.back();
  for (int i = bed.contact_start; i < bed.contact_start + bed.num_contacts; ++i)
    e.last.frame.contacts.point[e.last.joints.contacts[i]].x() = 1.2;
  e.last.joints = joint_wrenches(e.assembly, e.last.frame.contacts, e.shell);
  EXPECT_TRUE(std::isnan(e.last.joints.wrenches.back().kern));
  EXPECT_EQ(e.last.joints.wrenches.back().edge_distance, 0.0);
  const std::string html = worst_joints_html(e);
  EXPECT_NE(html.find("2 and 3</a> is the nearest to opening as a hinge: its force of"), std::string::npos)
      << html;
  EXPECT_NE(html.find("acts on the edge.<"), std::string::npos) << html;
}

// Two corners of every bed pull with a seventh of what the others press: the force is 0.2 m beyond their edge.
TEST(WorstJoints, AForceBeyondTheEdgeUnloadsNoJointThatPulls) {
  const Assembly a = test::column(3);
  const auto html = [&a](double pull) {
    Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.0, 0.4);
    ContactTable& contacts = frame.contacts;
    if (pull > 0.0)
      contacts.friction_limit = contacts.strength_use = contacts.damage = contacts.crack_opening =
          contacts.gap;
    for (int i = 0; i < contacts.size(); ++i) {
      if (contacts.normal_force[i] != 0.0) continue;
      contacts.normal_force[i] = -pull * contacts.normal_force[i ^ 1];
      contacts.force[i] = contacts.normal_force[i] * contacts.normal[i];
    }
    const Evaluation e = test::evaluated(a, {frame}, test::column_summary(a), test::column_case(),
                                         test::fresh_folder("results"));
    return worst_joints_html(e);
  };
  const std::string dry = html(0.0), pulled = html(1.0 / 7.0);
  EXPECT_NE(dry.find("acts on the edge, outside the kern, so that a part of the joint is unloaded."),
            std::string::npos)
      << dry;
  EXPECT_NE(
      pulled.find("acts 200 mm beyond the edge, outside the kern, so that a part of the joint is unloaded "
                  "or pulls."),
      std::string::npos)
      << pulled;
}

// The force of a long joint may be near its edge and central: a third of the kern of a strip of 1 m by 0.1 m.
// That at three quarters of half the width of a square is farther from the edge, and outside the kern.
TEST(WorstJoints, AreNearAHingeByTheKern) {
  JointWrenches joints;
  const auto add = [&joints](double area, double edge_distance, double kern) {
    JointWrench joint;
    joint.wrench.force.z() = joint.normal_force = 1e3;
    joint.patch.area = area;
    joint.edge_distance = edge_distance;
    joint.kern = kern;
    joints.wrenches.push_back(joint);
  };
  add(0.1, 0.044, 1.0 / 3.0);
  add(1.0, 0.125, 2.25);
  EXPECT_EQ(worst_joints(joints).edge, 1u);
}

// The lower corners of the beds push to and fro, so that the upper block only turns: their resultant is
// central and normal.
TEST(WorstJoints, FrictionThatOnlyResistsTurningIsUsed) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  const auto says = [&e](const char* text) {
    std::string all = worst_joints_html(e);
    for (const std::string& sentence : finding_sentences(e)) all += sentence;
    return all.find(text) != std::string::npos;
  };
  EXPECT_TRUE(says("every force is normal to its joint") && says("Friction is not used"));
  const JointWrench& bed = e.last.joints.wrenches.back();
  for (const int k : {0, 1}) {
    Vec3& force = e.last.frame.contacts.force[e.last.joints.contacts[bed.contact_start + k]];
    force.y() += (k == 0 ? 1e-3 : -1e-3) * bed.normal_force;
  }
  e.last.joints = joint_wrenches(e.assembly, e.last.frame.contacts, e.shell);
  ASSERT_EQ(e.last.joints.wrenches.back().friction_use, 0.0);
  EXPECT_FALSE(says("every force is normal to its joint"));
  EXPECT_FALSE(says("Friction is not used"));
  EXPECT_TRUE(says("the resultants of all joints are normal to them"));
}

}  // namespace
}  // namespace cupola::worst_joints_test
