// Forces of the shell in a block, from the mean stress of its contacts, ties and loads.

#include "postproc/mechanics/block_fields.hpp"

#include <gtest/gtest.h>

#include "tests/postproc/scene.hpp"

namespace cupola::block_fields_test {
namespace {

/// The fields of a step of a path in which the column has turned as one body, with all of its forces; a tie
/// pulls at it and a load pushes on it.
std::vector<BlockFields> turned(const Eigen::Isometry3d& motion) {
  const Assembly a = test::column(3);
  Frame frame = test::column_with_a_tie(a);
  for (int i = 0; i < frame.contacts.size(); ++i) {
    frame.contacts.point[i] = motion * frame.contacts.point[i];
    frame.contacts.force[i] =
        motion.linear() * Vec3(0.1 * frame.contacts.force[i].z(), 0.0, frame.contacts.force[i].z());
  }
  for (auto* points : {&frame.ties.point_a, &frame.ties.point_b})
    for (Vec3& point : *points) point = motion * point;
  const Eigen::Quaterniond q(motion.linear());
  for (size_t b = 0; b < a.blocks.size(); ++b) {
    frame.blocks.position[b] = motion * a.blocks[b].centroid;
    frame.blocks.quaternion_wxyz[b] = {q.w(), q.x(), q.y(), q.z()};
  }
  Case scene = test::column_case();
  BlockForce& load = scene.loads.forces.emplace_back();
  load.block = 2;
  load.point = Vec3(0.3, 0.2, 0.9);
  load.force = motion.linear() * Vec3(500, 0, -3e3);
  Summary summary = test::column_summary(a);
  summary.analysis = AnalysisType::path;
  summary.steps = 1;
  return test::evaluated(a, {frame}, summary, scene, test::fresh_folder("results")).last.fields;
}

// A block that has turned by 70 degrees and gone 2 m is under the same forces, in its own axes.
TEST(BlockFields, MoveWithTheBlocks) {
  const std::vector<BlockFields> still = turned(Eigen::Isometry3d::Identity());
  const std::vector<BlockFields> moved =
      turned(Eigen::Translation3d(2, -1, 0.5) * Eigen::AngleAxisd(70.0 / kDegrees, Vec3(1, 2, 2) / 3.0));
  ASSERT_EQ(moved.size(), still.size());
  for (size_t b = 1; b < still.size(); ++b) {
    const double largest = std::abs(still[b].meridional_force);
    EXPECT_GT(largest, 1e3);
    constexpr double kRounding = 1e-12;  // of sums of forces at points some metres away
    EXPECT_NEAR(moved[b].meridional_force, still[b].meridional_force, kRounding * largest);
    EXPECT_NEAR(moved[b].hoop_force, still[b].hoop_force, kRounding * largest);
  }
}

// A second part of the stone lies under an outer wythe, the first lies bare.
TEST(BlockFields, AStoneIsAsThickWhereAWytheHidesPartOfItsSkin) {
  Assembly wall = test::column(2);
  test::add_box(&wall, 1, 0, {1.2, 0.0, 0.0}, {2.4, 0.8, 0.5}, FaceKind::bed);
  wall.face_kinds.back() = FaceKind::wythe;
  compute_mass_properties(&wall);
  const std::vector<ShellAxes> axes = shell_axes(wall, shell_of(wall, Vec3::UnitZ()));
  EXPECT_NEAR(axes[1].thickness, 0.8, 1e-15) << "rounding of the volume";
}

}  // namespace
}  // namespace cupola::block_fields_test
