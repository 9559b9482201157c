#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "generators/generate.hpp"
#include "tests/generators/models.hpp"

namespace cupola::arch_test {
namespace {

using std::numbers::pi;

/// Semicircular arch with a centreline radius of 1 m.
Case arch_case(int voussoirs, double thickness, int segments) {
  Case c;
  ArchSurface arch;
  arch.span = 2.0 - thickness;
  arch.thickness = thickness;
  arch.voussoir_segments = segments;
  c.geometry.surface = arch;
  c.geometry.bond = StackBond{voussoirs, 1, 1, {}};
  return c;
}

// n trapezia with corners at R +- t/2 have the area
//     sin(pi/n) / 2 ((R + t/2)^2 - (R - t/2)^2) = t R sin(pi/n)  each.
TEST(Arch, PolygonalVoussoirsHaveTheExactVolume) {
  ModelReport report;
  const Assembly arch = check_and_report(arch_case(27, 0.15, 1), &report);
  EXPECT_EQ(report.num_blocks, 27);
  EXPECT_EQ(report.num_parts, 27);
  EXPECT_EQ(report.num_supports, 2);
  EXPECT_EQ(report.num_joints, 28);
  EXPECT_NEAR(report.volume, 27 * 0.15 * std::sin(pi / 27), 1e-13);
  EXPECT_NEAR(*report.shell_volume, 0.15 * pi, 1e-13);
  for (int b = 1; b <= 27; ++b)
    for (const Part& part : arch.parts) {
      if (part.block != b) continue;
      for (int f = part.face_start; f < part.face_start + 2; ++f)  // joints are radial
        EXPECT_NEAR(polygon_plane(face_points(arch, f)).offset, 0.0, 1e-14);
    }
}

TEST(Arch, SectorsApproachTheExactVolume) {
  ModelReport report;
  const Assembly arch = check_and_report(arch_case(7, 0.25, 16), &report);
  EXPECT_EQ(report.num_blocks, 7);
  EXPECT_EQ(report.num_parts, 7 * 16);
  const double angle = pi / 7 / 16;
  EXPECT_NEAR(report.volume / (0.25 * pi), 1.0 - angle * angle / 6, 1e-6);  // next term angle^4 / 120
  for (const Block& b : arch.blocks)
    if (!b.fixed) {
      EXPECT_EQ(b.num_rings, 1);
    }
}

TEST(Arch, PointedArchHasAJointAtTheCrown) {
  Case c;
  ArchSurface arch;
  arch.span = 10.0;
  arch.radius_ratio = 0.8;
  arch.thickness = 0.5;
  c.geometry.surface = arch;
  c.geometry.bond = StackBond{20, 1, 1, {}};
  ModelReport report;
  const Assembly model = check_and_report(c, &report);
  EXPECT_EQ(report.num_joints, 21);
  EXPECT_LT(report.volume, *report.shell_volume);
  EXPECT_NEAR(report.volume, *report.shell_volume, 4e-3 * *report.shell_volume);
  // Chords of 6.8 deg reduce the volume by theta^2 / 6 = 2.3e-3, the longer last chord of the extrados by
  // 1.4e-3 more.
  double crown = 0.0;
  for (const Vec3& v : model.vertices) crown = std::max(crown, v.z());
  EXPECT_NEAR(crown, std::sqrt(8.5 * 8.5 - 3.0 * 3.0), 1e-12);
  c.geometry.bond = StackBond{21, 1, 1, {}};
  EXPECT_THROW(generate(c), InputError);
}

TEST(Arch, SegmentalAndHorseshoeArchesHaveRadialSpringings) {
  for (double half_embrace : {30.0, 60.0, 110.0}) {
    Case c = arch_case(15, 0.1, 1);
    std::get<ArchSurface>(c.geometry.surface).half_embrace_deg = half_embrace;
    ModelReport report;
    check_and_report(c, &report);
    EXPECT_NEAR(report.volume, 15 * 0.1 * std::sin(half_embrace * pi / 180 * 2 / 15), 1e-13);
    EXPECT_EQ(report.num_joints, 16);
    EXPECT_EQ(report.islands, 1);
  }
}

// At 1.57 degrees, meant in radians, and near the full circle there is no opening to vault over.
TEST(Arch, RefusesAnglesThatMakeNoVault) {
  for (double half_embrace : {0.5, 179.0}) {
    Case c = arch_case(15, 0.1, 1);
    std::get<ArchSurface>(c.geometry.surface).half_embrace_deg = half_embrace;
    try {
      generate(c);
      FAIL() << half_embrace;
    } catch (const InputError& error) {
      EXPECT_NE(
          std::string(error.what()).find("which is no vault. The angle counts at the centre of each arc"),
          std::string::npos)
          << error.what();
    }
  }
}

TEST(Arch, BarrelHasARunningBondAlongItsAxis) {
  Case c = arch_case(9, 0.2, 1);
  std::get<ArchSurface>(c.geometry.surface).width = 3.0;
  c.geometry.bond = RunningBond{9, 3, 2, {}};
  ModelReport report;
  check_and_report(c, &report);
  EXPECT_EQ(report.num_blocks, 5 * 3 + 4 * 4);
  EXPECT_NEAR(report.volume, 3.0 * 9 * 0.2 * std::sin(pi / 9), 1e-12);
}

}  // namespace
}  // namespace cupola::arch_test
