// Assemblies whose blocks stand where a run has left them.
#include "assembly/export/placed_assembly.hpp"

#include <gtest/gtest.h>

#include "tests/assembly/scene.hpp"

namespace cupola {
namespace {

// A block of two parts that is turned about its centroid and moved keeps its mass and its place in the bond;
// its inertia and the tie that holds it turn with it, the block below stays. Rounding: 1e-14 of 1 m.
TEST(PlacedAssembly, MovesBlocksAndTies) {
  Assembly built = test::two_block_assembly();
  compute_mass_properties(&built);
  BuiltTie tie;
  tie.block_a = 0, tie.block_b = 1;
  tie.point_a = {0.1, 0.2, 0.3}, tie.point_b = {0.2, 0.3, 1.1};
  tie.stiffness = 1e6, tie.length = 0.8;
  built.ties = {tie};
  BlockTable blocks;
  for (const Block& block : built.blocks) {
    blocks.position.push_back(block.centroid);
    blocks.quaternion_wxyz.emplace_back(1, 0, 0, 0);
  }
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.3, Vec3(1, 2, 2) / 3.0));
  blocks.position[1] += Vec3(0.01, 0.02, 0.03);
  blocks.quaternion_wxyz[1] = {turn.w(), turn.x(), turn.y(), turn.z()};
  const Assembly placed = placed_assembly({built, poses_of(built, blocks), {}});
  ASSERT_EQ(placed.blocks.size(), built.blocks.size());
  for (size_t b = 0; b < built.blocks.size(); ++b) {
    const Mat3 R = b == 1 ? turn.toRotationMatrix() : Mat3::Identity();
    const Block &before = built.blocks[b], &after = placed.blocks[b];
    EXPECT_NEAR(after.mass, before.mass, 1e-12 * before.mass);
    EXPECT_NEAR((after.centroid - blocks.position[b]).norm(), 0.0, 1e-14);
    const Mat3 inertia = R * before.inertia * R.transpose();
    EXPECT_NEAR((after.inertia - inertia).norm(), 0.0, 1e-12 * inertia.norm());
    EXPECT_EQ(after.ring, before.ring);
    EXPECT_EQ(after.fixed, before.fixed);
  }
  const Vec3 end = blocks.position[1] + turn * (tie.point_b - built.blocks[1].centroid);
  EXPECT_NEAR((placed.ties[0].point_b - end).norm(), 0.0, 1e-14);
  EXPECT_NEAR((placed.ties[0].point_a - tie.point_a).norm(), 0.0, 1e-14);
  EXPECT_EQ(placed.ties[0].length, tie.length);
}

// In a frame the ties of the case come first, then those of the assembly, a rod as a bar and a strut, then
// restraints. Each tie of the assembly has grown by what its own bar has yielded.
TEST(PlacedAssembly, TiesKeepTheirPlasticElongation) {
  Assembly built = test::two_block_assembly();
  BuiltTie tie;
  tie.block_a = 0, tie.block_b = 1;
  tie.point_b = {0.2, 0.3, 1.1};
  tie.stiffness = 1e6, tie.length = 0.8;
  built.ties = {tie, tie, tie};
  built.ties[1].pushes = true;
  TieTable ties;
  ties.yielded = {0.5, 0.01, 0.02, 0.0, 0.04, 0.0, 0.0};
  ties.strut = {0, 0, 0, 1, 0, 0, 1};
  ExportModel model{built, std::vector(built.blocks.size(), Eigen::Isometry3d::Identity()), {}};
  model.yielded = yielded_of(built, ties, 1);
  const Assembly placed = placed_assembly(model);
  EXPECT_EQ(placed.ties[0].length, 0.8 + 0.01);
  EXPECT_EQ(placed.ties[1].length, 0.8 + 0.02);
  EXPECT_EQ(placed.ties[2].length, 0.8 + 0.04);
}

}  // namespace
}  // namespace cupola
