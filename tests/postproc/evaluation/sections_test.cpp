#include "postproc/evaluation/sections.hpp"

#include <gtest/gtest.h>

#include "tests/postproc/scene.hpp"

namespace cupola::sections_test {
namespace {

using test::kGravity;

const double kBlockWeight = 0.48 * 1800.0 * kGravity;

TEST(Sections, CutTheBlocks) {
  const Evaluation e = test::column_evaluation(0.6, 0.4);
  ASSERT_EQ(e.sections.size(), 1u);
  EXPECT_EQ(e.sections[0].beds, std::vector{2}) << "the bed at 1 m is nearer to 0.8 m than the one at 0.5 m";
  ASSERT_EQ(e.sections[0].polygons.size(), 1u);
  EXPECT_EQ(e.sections[0].polygons[0].block, 2);
  EXPECT_NEAR(polygon_area(e.sections[0].polygons[0].outline), 0.96, 1e-12);
}

// Gravity leans by 45 degrees: points stay at the height of the bed, 1 m.
TEST(Sections, HaveTheirPointsAtTheHeightOfTheBed) {
  const Assembly a = test::column(3);
  Case scene = test::column_case();
  scene.loads.gravity = Vec3(kGravity, 0.0, -kGravity);
  const Evaluation e = test::evaluated(a, {test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4)},
                                       test::column_summary(a), scene, test::fresh_folder("results"));
  ASSERT_EQ(e.sections.at(0).resultants.size(), 1u);
  EXPECT_NEAR((e.sections[0].resultants[0].point - Vec3(0.6, 0.4, 1.0)).norm(), 0.0, 1e-12);
}

// On a path the column stands 0.3 m aside: so do the outlines of sections and planes, as their resultants do.
TEST(Sections, CutTheBlocksWhereTheyStand) {
  const Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4);
  const Vec3 aside(0.3, 0.0, 0.0);
  for (Vec3& point : frame.contacts.point) point += aside;
  for (Vec3& position : frame.blocks.position) position += aside;
  for (Vec3& displacement : frame.blocks.displacement) displacement = aside;
  const Evaluation e = test::evaluated_path(a, frame);
  ASSERT_EQ(e.sections.size(), 1u);
  ASSERT_EQ(e.planes.size(), 1u);
  for (const std::vector<CutPolygon>& cut : {e.sections[0].polygons, e.planes[0].polygons}) {
    ASSERT_EQ(cut.size(), 1u);
    EXPECT_NEAR((polygon_centroid(cut[0].outline) - Vec3(0.9, 0.4, 0.8)).norm(), 0.0, 1e-12);
  }
  for (const BedResultant& r : e.sections[0].resultants) EXPECT_NEAR(r.point.x(), 0.9, 1e-12);
}

/// Two columns of three blocks at rest, the second 5 m aside and `higher` above, with courses of its own.
Evaluation two_columns(double higher, const std::vector<double>& heights) {
  Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4);
  a.num_rings = 6;
  a.sheets.push_back({.name = "second", .first_ring = 3, .num_rings = 3});
  for (int k = 0; k < 3; ++k) {
    Block block = a.blocks[k + 1];
    block.ring = k + 3;
    a.blocks.push_back(block);
    const Vec3 low(5.0, 0.0, higher + 0.5 * k);
    test::add_box(&a, k + 4, k + 3, low, low + Vec3(1.2, 0.8, 0.5), k == 2 ? FaceKind::top : FaceKind::bed);
    frame.blocks.position.push_back(low + Vec3(0.6, 0.4, 0.25));
    frame.blocks.quaternion_wxyz.push_back(frame.blocks.quaternion_wxyz[0]);
    for (auto* v : {&frame.blocks.velocity, &frame.blocks.angular_velocity, &frame.blocks.displacement})
      v->push_back(Vec3::Zero());
  }
  compute_mass_properties(&a);
  ContactTable& c = frame.contacts;
  for (int i = 0, n = c.size(); i < n; ++i) {
    c.joint.push_back(c.joint[i] + 3);
    c.block_a.push_back(c.block_a[i] > 0 ? c.block_a[i] + 3 : 0);
    c.block_b.push_back(c.block_b[i] + 3);
    c.kind.push_back(c.kind[i]);
    c.ring.push_back(c.ring[i] + 3);
    c.point.push_back(c.point[i] + Vec3(5.0, 0.0, higher));
    c.normal.push_back(c.normal[i]);
    c.force.push_back(c.force[i]);
    for (auto* v : {&c.gap, &c.normal_force, &c.friction_use, &c.area, &c.slip, &c.law_violation})
      v->push_back((*v)[i]);
  }
  Case scene = test::column_case();
  scene.postproc.sections = heights;
  return test::evaluated(a, {frame}, test::column_summary(a), scene, test::fresh_folder("results"));
}

// Each column carries the weight of its upper block across the bed at 1 m.
TEST(Sections, HaveTheNearestBedOfEveryStack) {
  const Evaluation e = two_columns(0.0, {0.8});
  ASSERT_EQ(e.sections.at(0).beds, (std::vector{2, 5}));
  ASSERT_EQ(e.sections[0].resultants.size(), 2u);
  for (const BedResultant& r : e.sections[0].resultants)
    EXPECT_NEAR(r.wrench.force.z(), kBlockWeight, 1e-9 * kBlockWeight);
  EXPECT_EQ(beds_text(e.shell, e.sections[0], "course"), "courses 2, 5");
}

// The second column stands where the first one ends: there, and above, the bed is one of its own. Above both
// nothing is cut.
TEST(Sections, LeaveOutStacksAtOtherHeights) {
  const Evaluation e = two_columns(1.5, {0.8, 1.5, 2.4, 4.0});
  ASSERT_EQ(e.sections.size(), 3u);
  const std::vector<int> expected{2, 3, 5};
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(e.sections[i].beds, std::vector{expected[i]});
}

// Blocks that a cut has left without intrados and extrados carry what the others do.
TEST(Sections, HaveTheForcesOfBlocksWithoutSkins) {
  Assembly a = test::column(3);
  for (FaceKind& kind : a.face_kinds)
    if (kind == FaceKind::intrados || kind == FaceKind::extrados) kind = FaceKind::free;
  const Evaluation e =
      test::evaluated(a, {test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4)}, test::column_summary(a),
                      test::column_case(), test::fresh_folder("results"));
  ASSERT_EQ(e.sections.at(0).resultants.size(), 1u);
  EXPECT_NEAR(e.sections[0].resultants[0].wrench.force.z(), kBlockWeight, 1e-9 * kBlockWeight);  // rounding
}

// 5 cm below the top of the support.
TEST(Sections, LeaveOutHeightsThatCutSupportsOnly) {
  Case scene = test::column_case();
  scene.postproc.sections = {-0.05, 0.8, 0.8};
  const Assembly a = test::column(3);
  const Evaluation e = test::evaluated(a, {test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4)},
                                       test::column_summary(a), scene, test::fresh_folder("results"));
  ASSERT_EQ(e.sections.size(), 1u);
  EXPECT_EQ(e.sections[0].height, 0.8);
}

}  // namespace
}  // namespace cupola::sections_test
