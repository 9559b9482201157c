#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/files/content_hash.hpp"
#include "generators/generate.hpp"
#include "tests/generators/models.hpp"

namespace cupola::wall_test {
namespace {

struct WallCount {
  int rings, blocks_per_ring, blocks;
};

class PaperWall : public testing::TestWithParam<WallCount> {};

TEST_P(PaperWall, HasTheExpectedCountAndVolumeWithOnePartPerBlock) {
  ModelReport report;
  const Assembly wall = check_and_report(wall_case(GetParam().rings, GetParam().blocks_per_ring), &report);
  EXPECT_EQ(report.num_blocks, GetParam().blocks);
  EXPECT_EQ(report.num_parts, GetParam().blocks);
  EXPECT_NEAR(report.volume, 72.0, 72.0 * 1e-12);  // 12 x 6 x 1 m, rounding of up to 5050 volumes
  const double whole = 72.0 / GetParam().rings / GetParam().blocks_per_ring;
  EXPECT_NEAR(report.largest_block, whole, whole * 1e-12);
  EXPECT_NEAR(report.smallest_block, whole / 2, whole * 1e-12);
  EXPECT_EQ(report.islands, 1);
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, PaperWall, testing::Values(WallCount{4, 2, 10}, WallCount{20, 10, 210}, WallCount{100, 50, 5050}),
    [](const auto& param_info) {
      return fmt::format("{}x{}", param_info.param.rings, param_info.param.blocks_per_ring);
    });

// With n blocks per course there are n joints at the base, 2 n between two courses, and n - 1 or n heads in a
// course.
TEST(Wall, RunningBondHasTheExpectedJoints) {
  ModelReport report;
  check_and_report(wall_case(4, 2), &report);
  const int base = 2, beds = 3 * 4, heads = 2 * 1 + 2 * 2;
  EXPECT_EQ(report.num_joints, base + beds + heads);
}

TEST(Wall, FacesHaveTheExpectedKinds) {
  const Assembly wall = generate(wall_case(3, 2));
  const Part& corner_block = wall.parts[1];
  ASSERT_EQ(corner_block.num_faces, 6);
  for (int f = corner_block.face_start; f < corner_block.face_start + 6; ++f) {
    const Vec3 n = polygon_plane(face_points(wall, f)).normal;
    FaceKind expected = FaceKind::bed;            // below and above
    if (n.x() < -0.5) expected = FaceKind::free;  // end of the wall
    if (n.x() > 0.5) expected = FaceKind::head;   // towards the neighbour
    if (n.y() > 0.5) expected = FaceKind::intrados;
    if (n.y() < -0.5) expected = FaceKind::extrados;
    EXPECT_EQ(wall.face_kinds[f], expected) << "normal " << n.transpose();
  }
}

TEST(Wall, GenerationIsDeterministic) {
  EXPECT_EQ(content_hash(generate(wall_case(10, 5))), content_hash(generate(wall_case(10, 5))));
}

}  // namespace
}  // namespace cupola::wall_test
