#include "postproc/mechanics/plane_contacts.hpp"

#include <utility>

#include <gtest/gtest.h>

#include "postproc/tables/post_summary.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::plane_contacts_test {
namespace {

/// The resultant of every bed at x = 0.9 m, 0.3 m from its middle, in the middle of its width of 0.8 m.
Frame in_space(const Assembly& a) {
  Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.9, 0.4);
  for (int i = 0; i < frame.contacts.size(); ++i)
    if (i % 2 == 0) frame.contacts.gap[i] = 2e-3;  // at x = 0
  return frame;
}

/// The same solved in the plane: both points at one x become one midway.
Frame in_plane(const Assembly& a) {
  Frame frame = in_space(a);
  ContactTable all = std::exchange(frame.contacts, {});
  ContactTable& c = frame.contacts;
  for (int i = 0; i < all.size(); ++i) {
    if (i % 4 >= 2) continue;  // at y = 0.8 m
    c.joint.push_back(all.joint[i]);
    c.block_a.push_back(all.block_a[i]);
    c.block_b.push_back(all.block_b[i]);
    c.kind.push_back(all.kind[i]);
    c.ring.push_back(all.ring[i]);
    c.point.emplace_back(all.point[i].x(), 0.4, all.point[i].z());
    c.normal.push_back(all.normal[i]);
    c.gap.push_back(all.gap[i]);
    c.force.emplace_back(2.0 * all.force[i]);
    c.normal_force.push_back(2.0 * all.normal_force[i]);
    c.friction_use.push_back(all.friction_use[i]);
    c.area.push_back(2.0 * all.area[i]);
    c.slip.push_back(all.slip[i]);
    c.law_violation.push_back(all.law_violation[i]);
  }
  return frame;
}

Evaluation evaluated(const Frame& frame, bool plane, int sectors = 1) {
  const Assembly a = test::column(3);
  Case scene = test::column_case();
  scene.analysis.plane = plane;
  Summary summary = test::column_summary(a);
  summary.unknowns = (plane ? 3 : 6) * summary.free_blocks / sectors;
  return test::evaluated(a, {frame}, summary, scene, test::fresh_folder("results"));
}

// What follows from joints does not depend on whether they were solved in the plane.
TEST(PlaneContacts, GiveTheJointsOfTheSameRunInSpace) {
  const Assembly a = test::column(3);
  const Evaluation space = evaluated(in_space(a), false), plane = evaluated(in_plane(a), true);
  ASSERT_EQ(plane.last.joints.wrenches.size(), 3u);
  for (size_t j = 0; j < 3; ++j) {
    const JointWrench &p = space.last.joints.wrenches[j], &q = plane.last.joints.wrenches[j];
    EXPECT_NEAR(q.patch.area, 0.96, 1e-12);
    EXPECT_NEAR(q.kern, 1.5, 1e-12) << "6 e / b";
    EXPECT_NEAR(q.edge_distance, p.edge_distance, 1e-12);
    EXPECT_NEAR(q.largest_pressure, p.largest_pressure, 1e-12 * p.largest_pressure);
    EXPECT_EQ(q.open_share, p.open_share);
    EXPECT_LT((q.wrench.force - p.wrench.force).norm(), 1e-12 * p.wrench.force.norm());
    EXPECT_NEAR(plane.rings[j].height, 0.5 * static_cast<double>(j), 1e-12);
  }
  EXPECT_NEAR(post_summary(plane).mean_kern_use.value(), 1.5, 1e-12);
}

// Two sectors in space leave three unknowns per block, as a run in the plane has.
TEST(PlaneContacts, AreNotThoseOfTwoSectors) {
  const Frame frame = in_space(test::column(3));
  const Evaluation one = evaluated(frame, false), two = evaluated(frame, false, 2);
  EXPECT_EQ(two.last.frame.contacts.size(), one.last.frame.contacts.size());
  EXPECT_TRUE(post_summary(two).largest_couple_length_m.has_value());
}

TEST(PlaneContacts, HaveNoCouple) {
  const Evaluation plane = evaluated(in_plane(test::column(3)), true);
  EXPECT_FALSE(post_summary(plane).largest_couple_length_m.has_value());
  EXPECT_EQ(post_summary(plane).points_per_base_joint.value(), 2.0);
}

// A single point has no length from which a width would follow.
TEST(PlaneContacts, OfASinglePointStayOnIt) {
  Frame frame = in_plane(test::column(1));
  for (Vec3& point : frame.contacts.point) point = Vec3(0.9, 0.4, 0.0);
  spread_across_plane(&frame.contacts);
  ASSERT_EQ(frame.contacts.size(), 4);
  for (const Vec3& point : frame.contacts.point) EXPECT_EQ(point.y(), 0.4);
}

}  // namespace
}  // namespace cupola::plane_contacts_test
