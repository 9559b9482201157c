#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "generators/generate.hpp"
#include "tests/generators/models.hpp"

namespace cupola::dome_test {
namespace {

// m3, smooth shell of the pointed fifth from 0 to 60 deg, by independent quadrature.
constexpr double kShellVolume = 9231.922780;

TEST(DomeOfRevolution, PaperModelHasTheExpectedCountsAndVolumes) {
  ModelReport report;
  const Assembly dome = check_and_report(dome_case(), &report);
  EXPECT_EQ(report.num_blocks, 1280);
  EXPECT_EQ(report.num_parts, 5120);
  EXPECT_EQ(report.num_supports, 1);
  EXPECT_EQ(report.islands, 1);
  ASSERT_TRUE(report.shell_volume.has_value());
  EXPECT_NEAR(*report.shell_volume, kShellVolume, 1e-6);  // the reference has six decimals
  EXPECT_NEAR(report.smallest_block, 2.295, 5e-4);        // half a unit of the table's last digit
  EXPECT_NEAR(report.largest_block, 9.898, 5e-4);
  EXPECT_NEAR(report.parts_volume / report.volume, 1.0, 1e-12);
  // Coordinates of 50 m are rounded to 7e-15 m; a plane through four points is accurate to a few times that.
  EXPECT_LT(report.max_convexity_error, 1e-13);
  EXPECT_LT(report.max_overlap, 1e-12);
}

// The area of a polygon with S sides is that of its circumscribed circle times sin(2 pi/S) / (2 pi/S); the
// same holds for the profile between the beds. Both errors are O(1/n^2).
TEST(DomeOfRevolution, VolumeErrorOfTheFacetsIsOfSecondOrder) {
  const auto error = [](int rings, int blocks) {
    ModelReport report;
    check_and_report(dome_case(rings, blocks, 2), &report);
    return 1.0 - report.volume / kShellVolume;
  };
  const double coarse = error(10, 16);
  const double fine = error(20, 32);
  EXPECT_GT(fine, 0.0);
  EXPECT_NEAR(coarse / fine, 4.0, 0.02);  // the next term is O(1/n^4): (2 pi/32)^2 / 20 = 0.2 %
}

TEST(DomeOfRevolution, BlocksAreNumberedRingByRingInSlotOrder) {
  const Assembly dome = cut_assembly(dome_case(6, 8, 4));
  ASSERT_EQ(dome.blocks.size(), 49u);
  EXPECT_EQ(dome.blocks[0].kind, BlockKind::support);
  EXPECT_TRUE(dome.blocks[0].fixed);
  EXPECT_EQ(dome.blocks[0].ring, -1);
  for (int b = 1; b < 49; ++b) {
    const Block& block = dome.blocks[b];
    EXPECT_EQ(block.ring, (b - 1) / 8);
    EXPECT_EQ(block.slot, (b - 1) % 8);
    // The middle of slot j lies at (j + 1/2) w in even rings and half a block further in odd rings.
    const double expected = (block.slot + (block.ring % 2 == 0 ? 0.5 : 1.0)) * std::numbers::pi / 4;
    const double azimuth = std::atan2(block.centroid.y(), block.centroid.x());
    EXPECT_NEAR(std::remainder(azimuth - expected, 2 * std::numbers::pi), 0.0, 1e-12);
  }
}

TEST(DomeOfRevolution, SupportExtendsBeyondTheBase) {
  const Assembly dome = cut_assembly(dome_case(4, 8, 4));
  double lowest = 0.0, inner = 1e9, outer = 0.0;
  for (const Part& part : dome.parts) {
    if (part.block != 0) continue;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      for (const Vec3& p : face_points(dome, f)) {
        lowest = std::min(lowest, p.z());
        EXPECT_LE(p.z(), 0.0);
        inner = std::min(inner, std::hypot(p.x(), p.y()));
        outer = std::max(outer, std::hypot(p.x(), p.y()));
      }
  }
  EXPECT_DOUBLE_EQ(lowest, -1.0);
  EXPECT_NEAR(inner, 22.5 - 1.0, 1e-13);
  EXPECT_NEAR(outer, 22.5 + 2.2 + 1.0, 1e-13);
}

TEST(DomeOfRevolution, StageHasTheBlocksOfItsRings) {
  Case stage = dome_case(40, 32, 2);
  stage.geometry.stage = Stage{16};
  const Assembly dome = generate(stage);
  EXPECT_EQ(dome.blocks.size(), 1u + 16 * 32);
  int top_faces = 0;
  for (FaceKind kind : dome.face_kinds) top_faces += kind == FaceKind::top ? 1 : 0;
  EXPECT_EQ(top_faces, 64);
  EXPECT_EQ(dome.num_rings, 40);
}

TEST(DomeOfRevolution, RejectsACrownBeyondTheAxis) {
  Case c = dome_case(4, 8, 4);
  c.geometry.surface =
      DomeSurface{45.0, 0.8, 2.2, 80.0};  // the intrados meets the axis at acos(3/8) = 68 deg
  EXPECT_THROW(generate(c), InputError);
}

}  // namespace
}  // namespace cupola::dome_test
