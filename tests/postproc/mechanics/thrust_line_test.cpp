#include "postproc/mechanics/thrust_line.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/postproc/models.hpp"

namespace cupola::thrust_line_test {
namespace {

/// A vault of revolution in which every block receives from below one force of given meridian components at a
/// given position through the thickness of its bed's middle.
struct MeridianScene {
  Assembly assembly;
  Shell shell;
  ContactTable contacts;
  JointWrenches joints;
  std::vector<Wrench> from_below;

  MeridianScene(int rings, int blocks, double offset, double position, double outward, double upward)
      : assembly(test::ring_vault(rings, blocks, offset)), shell(shell_of(assembly, Vec3::UnitZ())) {
    from_below.resize(assembly.blocks.size());
    for (int k = 0; k < rings; ++k)
      for (const BedFacet& f : shell.beds[k]) {
        const Vec3 inner = 0.5 * (f.intrados_a + f.intrados_b), outer = 0.5 * (f.extrados_a + f.extrados_b);
        const Vec3 radial = Vec3(inner.x(), inner.y(), 0.0).normalized();
        from_below[f.block].point = assembly.blocks[f.block].centroid;
        from_below[f.block].add_force(inner + position * (outer - inner),
                                      outward * radial + upward * Vec3::UnitZ());
      }
  }
  ThrustInput input() const { return {&assembly, &shell, &contacts, &joints, from_below, {0, 0, -9.81}}; }
};

TEST(ThrustLine, FindsPositionAndResultantAtEveryAzimuth) {
  const double outward = -300.0, upward = 1000.0;
  for (const double offset : {0.0, 0.123}) {
    const MeridianScene scene(6, 16, offset, 0.3, outward, upward);
    // In the middle of blocks, on a head joint, between, and across the seam of the azimuth.
    for (const double azimuth : {0.0, 11.25, 5.0, 180.0, -180.0, 359.0}) {
      const ThrustLine line = thrust_line(scene.input(), "m", azimuth);
      ASSERT_EQ(line.points.size(), 6u) << azimuth;
      for (const ThrustPoint& p : line.points) {
        EXPECT_NEAR(p.position, 0.3, 1e-10);
        EXPECT_NEAR(p.r, std::hypot(outward, upward), 1e-8);
        EXPECT_NEAR(p.v, upward, 1e-8);
        EXPECT_NEAR(p.couple_length, 0.0, 1e-10);
        EXPECT_NEAR(p.geometric_safety, 2.5, 1e-9);  // half the thickness over 0.2 of it
        // In the meridian's half-plane, on the outer side of the axis.
        const double a = azimuth * std::numbers::pi / 180.0;
        EXPECT_NEAR(-std::sin(a) * p.point.x() + std::cos(a) * p.point.y(), 0.0, 1e-12);
        EXPECT_GT(std::cos(a) * p.point.x() + std::sin(a) * p.point.y(), 0.0);
      }
      EXPECT_TRUE(line.inside);
    }
  }
}

TEST(ThrustLine, LeavingTheThicknessIsSaid) {
  const MeridianScene scene(4, 12, 0.0, 1.1, -100.0, 1000.0);
  const ThrustLine line = thrust_line(scene.input(), "m", 0.0);
  EXPECT_FALSE(line.inside);
  // The meridian meets the even rings on a head joint, where the thickness is the full 1 m.
  EXPECT_NEAR(line.least_face_distance, -0.1, 1e-9);
}

TEST(ThrustLine, AResultantAlongTheBedHasNoPlace) {
  MeridianScene scene(4, 12, 0.0, 0.5, -100.0, 1000.0);
  for (Wrench& w : scene.from_below)  // ring 2: along the bed, 0.1 % of the others pressing on it
    if (scene.assembly.blocks[static_cast<size_t>(&w - scene.from_below.data())].ring == 2) {
      const Vec3 radial = Vec3(w.point.x(), w.point.y(), 0.0).normalized();
      w.force = 500.0 * radial + 20.0 * Vec3::UnitZ();
    }
  const ThrustLine line = thrust_line(scene.input(), "m", 0.0);
  ASSERT_EQ(line.points.size(), 4u);
  EXPECT_EQ(line.undefined, 1);
  EXPECT_FALSE(line.points[2].is_placed());
  EXPECT_TRUE(std::isnan(line.points[2].face_distance));
  EXPECT_NEAR(line.points[2].v, 20.0, 1e-9) << "the force itself is known";
  EXPECT_TRUE(line.inside) << "of the beds that have a place";
  // The meridian meets the odd rings in the middle of a facet, where the level part of the 1 m of thickness
  // is shorter by cos 15 deg; ring 1 stands on a bed that rises by 0.02 rad.
  EXPECT_NEAR(line.least_face_distance,
              0.5 * std::hypot(std::cos(0.02) * std::cos(std::numbers::pi / 12), std::sin(0.02)), 1e-9);
}

TEST(ThrustLine, ForcesThatAreRoundingHaveNoPlace) {
  MeridianScene scene(4, 12, 0.0, 0.5, -100.0, 1000.0);
  for (size_t b = 0; b < scene.from_below.size(); ++b)
    if (scene.assembly.blocks[b].ring == 3) scene.from_below[b] = 1e-7 * scene.from_below[b];
  EXPECT_EQ(thrust_line(scene.input(), "m", 0.0).undefined, 1);
  for (size_t b = 0; b < scene.from_below.size(); ++b)
    if (scene.assembly.blocks[b].ring == 3) scene.from_below[b] = 100.0 * scene.from_below[b];
  EXPECT_EQ(thrust_line(scene.input(), "m", 0.0).undefined, 0);
}

// Beside a block that presses at 0.25 of the thickness stands one that is pushed along its bed by nearly as
// much. Its own line of action meets the bed some 40 m away; with a thousandth of the pressure it moves the
// strip's resultant by about 0.04 m.
TEST(ThrustLine, APushAlongTheBedHardlyMovesTheResultant) {
  MeridianScene scene(1, 12, 0.0, 0.25, 0.0, 1000.0);
  Wrench& pushed = scene.from_below[0];
  pushed.force = Vec3::UnitZ() + 400.0 * Vec3(pushed.point.x(), pushed.point.y(), 0.0).normalized();
  pushed.moment = Vec3::Zero();
  const ThrustLine line = thrust_line(scene.input(), "m", 0.0);  // blocks 0 and 11, half of each
  ASSERT_EQ(line.points.size(), 1u);
  ASSERT_EQ(line.points[0].blocks, 2);
  EXPECT_NEAR(line.points[0].position, 0.25 - 0.04, 0.02);
}

// A bed inside a block carries what stands above it: one tall block in three courses.
TEST(ThrustLine, InnerBedsCarryThePieceAbove) {
  Assembly a = test::column(3);
  for (Part& part : a.parts) part.block = std::min(part.block, 1);
  a.blocks.resize(2);
  a.blocks[1].num_rings = 3;
  for (int f = 0; f < a.num_faces(); ++f) {  // the faces between the courses lie at z = 0.5 and 1
    const std::vector<Vec3> points = face_points(a, f);
    const double z = polygon_centroid(points).z();
    const bool horizontal = std::abs(polygon_plane(points).normal.z()) > 0.9;
    if (horizontal && z > 0.4 && z < 1.1) a.face_kinds[f] = FaceKind::internal;
  }
  compute_mass_properties(&a);
  const Frame frame = test::column_at_rest(a, 9.81, 0.0, 0.6, 0.4);
  const Shell shell = shell_of(a, Vec3::UnitZ());
  ASSERT_EQ(shell.num_rings(), 3);
  for (const auto& bed : shell.beds) ASSERT_EQ(bed.size(), 1u);
  EXPECT_FALSE(shell.beds[0][0].internal);
  EXPECT_TRUE(shell.beds[1][0].internal);
  const JointWrenches joints = joint_wrenches(a, frame.contacts, shell);
  const ThrustInput input{&a,           &shell, &frame.contacts, &joints, wrenches_from_below(a, joints),
                          {0, 0, -9.81}};
  const ThrustLine line = thrust_line(input, "m", std::nullopt);
  const double course = 0.48 * 1800.0 * 9.81;
  ASSERT_EQ(line.points.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(line.points[k].v, (3 - k) * course, 1e-9 * course);
    EXPECT_NEAR(line.points[k].position, 0.5, 1e-12);
  }
}

}  // namespace
}  // namespace cupola::thrust_line_test
