// Profiles carried along plans: volumes against closed forms, shapes against their equations.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "generators/generate.hpp"
#include "generators/surface/make_surface.hpp"
#include "tests/generators/models.hpp"
#include "tests/generators/surface/drawn_vaults.hpp"

namespace cupola::drawn_test {
namespace {

using std::numbers::pi;
using Kind = Profile::Kind;
using test::case_of;
using test::chain_of;
using test::profile_of;
using test::vault_on;

double free_volume(const Case& scene) {
  double volume = 0.0;
  for (const Block& block : cut_assembly(scene).blocks) volume += block.fixed ? 0.0 : block.volume;
  return volume;
}

/// Area (m2) and first moment (m3) about r = 0 of the section that the courses cut out.
std::pair<double, double> section_sums(const SurfaceMap& map, const std::function<double(const Vec3&)>& r) {
  double area = 0.0, moment = 0.0;
  for (int k = 0; k < map.num_rows; ++k) {
    const auto at = [&](int bed, int layer) {
      const Vec3 p = map.point(bed, map.corners.size() > 1 ? 0.5 * map.corners[1] : 0.0, layer);
      return Eigen::Vector2d(r(p), p.z());
    };
    const std::array<Eigen::Vector2d, 4> q{at(k, 0), at(k, 1), at(k + 1, 1), at(k + 1, 0)};
    for (size_t i = 0; i < 4; ++i) {
      const Eigen::Vector2d &a = q[i], &b = q[(i + 1) % 4];
      const double twice = a.x() * b.y() - b.x() * a.y();
      area += twice / 2;
      moment += twice * (a.x() + b.x()) / 6;
    }
  }
  return {area, moment};
}

const auto kRadial = [](const Vec3& p) { return std::hypot(p.x(), p.y()); };

// Sum of the parts against the integral over the section; 1e-12: rounding of some hundred parts.
TEST(DrawnVolume, OfRevolution) {
  for (const Kind kind : {Kind::semicircle, Kind::segmental, Kind::pointed, Kind::basket, Kind::horseshoe,
                          Kind::ellipse, Kind::parabola, Kind::catenary, Kind::straight}) {
    const VaultSurface v = vault_on(Plan::Kind::circle, profile_of(kind));
    const int n = 32;  // slices
    const double expected = n * std::sin(2 * pi / n) * section_sums(make_surface(v, 8), kRadial).second;
    EXPECT_NEAR(free_volume(case_of(v)), expected, 1e-12 * expected) << static_cast<int>(kind);
  }
}

TEST(DrawnVolume, OfCloistersOverRegularPolygons) {
  for (const auto beds : {VaultSurface::Beds::normal, VaultSurface::Beds::level})
    for (const auto measured : {Plan::MeasuredAt::corner, Plan::MeasuredAt::side}) {
      VaultSurface v = vault_on(Plan::Kind::polygon, profile_of(Kind::ellipse));
      v.plan.sides = 6;
      v.plan.measured_at = measured;
      v.beds = beds;
      v.eye = 2.5;
      const double expected = 12 * std::tan(pi / 6) * section_sums(make_surface(v, 8), kRadial).second;
      EXPECT_NEAR(free_volume(case_of(v, 8, 24)), expected, 1e-12 * expected);
    }
}

// At a distance w inside the plan its circumference is P - 2 w sum tan(exterior angle / 2).
TEST(DrawnVolume, OfCloistersOverConvexPolygons) {
  const VaultSurface v = vault_on(Plan::Kind::corners, profile_of(Kind::semicircle, 8.0));
  double around = 0.0, turn = 0.0;
  const auto corner = [&](size_t i) { return Eigen::Vector2d(v.plan.x[i % 4], v.plan.y[i % 4]); };
  for (size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d a = corner(i + 1) - corner(i), b = corner(i + 2) - corner(i + 1);
    around += a.norm();
    turn += std::tan(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)) / 2);
  }
  const SurfaceMap map = make_surface(v, 8);
  const Eigen::Vector2d along = (corner(1) - corner(0)).normalized(), inwards(-along.y(), along.x());
  const auto [area, moment] =
      section_sums(map, [&](const Vec3& p) { return -inwards.dot(p.head<2>() - corner(0)); });
  const double expected = around * area + 2 * turn * moment;
  EXPECT_NEAR(free_volume(case_of(v)), expected, 1e-12 * expected);
}

TEST(DrawnVolume, OfStretchedDomesAndRakingBarrels) {
  Case dome = case_of(vault_on(Plan::Kind::circle, profile_of(Kind::ellipse)));
  const double round = free_volume(dome);
  dome.geometry.affine = Affine{{1.5, 1.0, 0.8}, 0.0};
  EXPECT_NEAR(free_volume(dome), 1.2 * round, 1e-12 * round);
  Case barrel = case_of(vault_on(Plan::Kind::line, profile_of(Kind::semicircle)));
  const double level = free_volume(barrel);
  barrel.geometry.affine = Affine{{1, 1, 1}, 0.5};
  EXPECT_NEAR(free_volume(barrel), level, 1e-12 * level);
}

// Arches that lean against a wall, which cuts them off: at a height z they are the length less lean z long.
TEST(DrawnVolume, OfArchesThatLeanAgainstAWall) {
  VaultSurface v = vault_on(Plan::Kind::line, profile_of(Kind::semicircle));
  v.plan.length = 6.0;
  const SurfaceMap map = make_surface(v, 8);
  double area = 0.0, moment = 0.0;  // m2, and m3 about z = 0
  for (int k = 0; k < map.num_rows; ++k)
    for (const auto& corners : {std::array{map.point(k, 0, 0), map.point(k, 0, 1), map.point(k + 1, 0, 1)},
                                {map.point(k, 0, 0), map.point(k + 1, 0, 1), map.point(k + 1, 0, 0)}}) {
      const double triangle = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
      area += triangle;
      moment += triangle * (corners[0].z() + corners[1].z() + corners[2].z()) / 3.0;
    }
  Case scene = case_of(v);
  scene.geometry.affine = Affine{.lean = -0.4};
  EXPECT_NEAR(free_volume(scene), 6.0 * area, 1e-12 * area);
  Cut wall;
  wall.normal = {0.0, -1.0, 0.0};
  wall.as = Cut::As::held;
  scene.geometry.cuts = {wall};
  const double expected = 6.0 * area - 0.4 * moment;
  EXPECT_NEAR(free_volume(scene), expected, 1e-12 * expected);
  ModelReport report;
  check_and_report(scene, &report);
  EXPECT_LT(report.max_overlap, 2e-11 * 10.0);
  EXPECT_LT(report.max_joint_gap, 2e-11 * 10.0);
}

// A frustum over an n-gon: h / 3 (A + B + sqrt(A B)).
TEST(DrawnVolume, OfTheKeyStone) {
  Case scene = case_of(vault_on(Plan::Kind::circle, profile_of(Kind::semicircle)));
  std::get<VaultSurface>(scene.geometry.surface).key_stone = true;
  ModelReport report;
  const Assembly assembly = check_and_report(scene, &report);
  EXPECT_EQ(report.num_blocks, 8 * 16 + 1);
  EXPECT_EQ(assembly.num_rings, 9);
  EXPECT_EQ(report.islands, 1);
  EXPECT_LT(report.max_overlap, 2e-11 * 10.0);
  const double h = 0.5 * std::sqrt(1.0 - 0.2 * 0.2), inner = 1.0, outer = 1.1;
  const double polygon = 0.5 * 32 * std::sin(2 * pi / 32);
  EXPECT_EQ(assembly.blocks.back().ring, 8);
  EXPECT_NEAR(assembly.blocks.back().volume,
              h / 3 * polygon * (inner * inner + outer * outer + inner * outer), 1e-13);
}

// Steiner: the area between a curve of length L and its parallel at t is L t + phi t^2 / 2, phi the angle by
// which the normal turns. The extrapolated volume of the barrel is exact to 1e-8.
TEST(DrawnProfile, HasTheAreaOfItsEquation) {
  const double a = 5.0, h = 4.0, t = 0.5, R = (a * a + h * h) / (2 * h);
  double c = 4.0;  // of the catenary, by Newton
  for (int i = 0; i < 50; ++i) {
    const double f = c * (std::cosh(a / c) - 1) - h;
    c -= f / (std::cosh(a / c) - 1 - a / c * std::sinh(a / c));
  }
  const double slope = 2 * h / a;
  struct Row {
    Kind kind;
    double length, turn;
  };
  const double segment = 2 * std::asin(a / R);
  for (const Row& row : {Row{Kind::semicircle, pi * a, pi}, Row{Kind::segmental, segment * R, segment},
                         Row{Kind::horseshoe, (pi + pi / 3) * a, pi + pi / 3},
                         Row{Kind::ellipse, 2 * a * std::comp_ellint_2(std::sqrt(1 - h * h / (a * a))), pi},
                         Row{Kind::parabola, a * (std::sqrt(1 + slope * slope) + std::asinh(slope) / slope),
                             2 * std::atan(slope)},
                         Row{Kind::catenary, 2 * c * std::sinh(a / c), 2 * std::atan(std::sinh(a / c))}}) {
    const SurfaceMap map = make_surface(vault_on(Plan::Kind::line, profile_of(row.kind), t), 16);
    const double expected = row.length * t + row.turn * t * t / 2;
    EXPECT_NEAR(extrapolated_shell_volume(map), expected, 1e-8 * expected) << static_cast<int>(row.kind);
    EXPECT_NEAR(map.intrados(8, 0).z(), row.kind == Kind::semicircle || row.kind == Kind::horseshoe ? a : h,
                1e-12);
    EXPECT_NEAR(map.intrados(8, 0).x(), 0.0, 1e-12);
  }
}

/// m3, of the smooth shell, without its blocks.
double smooth_volume_of(const VaultSurface& v, int rings, int blocks = 16) {
  ModelReport report;
  check_and_report(case_of(v, rings, blocks), &report);
  return report.shell_volume.value();
}

// Frusta between the bisectors of the kinks, for any number of courses: V = 2 pi sum of r dA, by Pappus, over
// the quadrilaterals of the chain. 1e-13: rounding of some ten terms.
TEST(SmoothShell, OfStraightRunsIsThatOfTheirFrusta) {
  VaultSurface v = vault_on(Plan::Kind::circle, chain_of({5, 5, 3, 1}, {0, 2, 4, 4.5}));
  v.eye = 0.0;
  for (const int rings : {16, 24, 25})
    EXPECT_NEAR(smooth_volume_of(v, rings) / 88.27738709689064, 1.0, 1e-13) << rings;
}

// The sails of an octagon under straight runs are plane, so that its blocks leave nothing out. 1e-12: rounding
// of the volumes of some hundred blocks.
TEST(SmoothShell, OfPlaneSailsIsThatOfTheBlocks) {
  for (const auto line : {VaultSurface::Line::intrados, VaultSurface::Line::middle}) {
    VaultSurface v = vault_on(Plan::Kind::polygon, chain_of({5, 5, 4, 4}, {0, 2, 3, 5}));
    v.plan.sides = 8;
    v.eye = 0.0;
    v.line = line;
    const double blocks = free_volume(case_of(v, 12));
    EXPECT_NEAR(smooth_volume_of(v, 12) / blocks, 1.0, 1e-12);
  }
}

// Half the section lies between two arcs about (-e, 0) and the axis, from which an arc of radius q cuts
// q^2 acos(e/q) / 2 - e sqrt(q^2 - e^2) / 2; the crown is a kink. 1e-13: rounding.
TEST(SmoothShell, OfAPointedBarrelReachesToTheCrown) {
  const VaultSurface v = vault_on(Plan::Kind::line, profile_of(Kind::pointed, 5.0), 0.8);
  const double R = v.profile.radius_ratio * 5.0, e = R - 2.5;
  const auto half = [&](double q) { return 0.5 * (q * q * std::acos(e / q) - e * std::sqrt(q * q - e * e)); };
  EXPECT_NEAR(smooth_volume_of(v, 6) / (2.0 * v.plan.length * (half(R + 0.8) - half(R))), 1.0, 1e-13);
}

TEST(DrawnProfile, BasketsMeetSmoothlyAndReachTheirRise) {
  Profile basket = profile_of(Kind::basket, 12.0, 4.0);
  basket.haunch_radius = 2.5;
  const SurfaceMap map = make_surface(vault_on(Plan::Kind::line, basket), 9);
  EXPECT_NEAR(map.intrados(4.5, 0).z(), 4.0, 1e-12);
  EXPECT_NEAR(map.intrados(0, 0).x(), 6.0, 1e-12);
  // Equal courses, although two radii meet: a chord is shorter than its arc s by s^3 / (24 r^2) = 0.036 m at
  // most.
  for (int k = 0; k + 1 < 9; ++k)
    EXPECT_NEAR((map.intrados(k + 1, 0) - map.intrados(k, 0)).norm(),
                (map.intrados(1, 0) - map.intrados(0, 0)).norm(), 0.036);
}

TEST(DrawnProfile, AKinkIsABedInTheBisector) {
  const SurfaceMap map = make_surface(vault_on(Plan::Kind::line, chain_of({3, 3, 0}, {0, 3, 6}), 0.4), 10);
  const Vec3 in = map.intrados(2, 0), out = map.extrados(2, 0);
  EXPECT_LT((in - Vec3(3, 0, 3)).norm(), 1e-14);
  // The normals are (1, 0) and (1, 1) / sqrt 2; the bed is 0.4 / cos(22.5 deg) wide.
  EXPECT_LT((out - in - 0.4 / std::cos(pi / 8) * Vec3(std::cos(pi / 8), 0, std::sin(pi / 8))).norm(), 1e-14);
}

// A flat arch, whose beds rise from 60 deg at the springing to the crown: a trapezoid.
TEST(DrawnBeds, StandAtTheirAngles) {
  VaultSurface flat = vault_on(Plan::Kind::line, chain_of({2, 0}, {0, 0}), 0.6);
  flat.beds = VaultSurface::Beds::given;
  flat.bed_angles_deg = {60.0, 75.0, 90.0};
  const SurfaceMap map = make_surface(flat, 9);
  const auto angle = [&](int bed) {
    const Vec3 along = map.extrados(bed, 0) - map.intrados(bed, 0);
    return std::atan2(along.z(), along.x()) * 180.0 / pi;
  };
  for (int bed = 0; bed <= 4; ++bed) {
    EXPECT_NEAR(angle(bed), 60.0 + 30.0 * bed / 4.5, 1e-12) << bed;
    EXPECT_NEAR(angle(9 - bed), 180.0 - angle(bed), 1e-12) << bed;
  }
  EXPECT_FALSE(map.smooth_beds);
  Case scene = case_of(flat, 9, 4);
  EXPECT_NEAR(free_volume(scene), 0.6 * (4.0 + 0.6 / std::tan(pi / 3)), 1e-12);
  flat.bed_angles_deg = {60.0, 80.0};
  EXPECT_THROW(make_surface(flat, 8), InputError) << "a bed at the crown that leans";
  flat.bed_angles_deg = {60.0, 90.0};
  EXPECT_NEAR(make_surface(flat, 8).extrados(4, 0).x(), 0.0, 1e-15);
}

// Normal beds given by their angles are those of the profile, also over a circle and where the profile is the
// middle line.
TEST(DrawnBeds, GivenAsTheNormalsAreNormal) {
  for (const Plan::Kind plan : {Plan::Kind::circle, Plan::Kind::line}) {
    VaultSurface normal = vault_on(plan, profile_of(Kind::semicircle), 0.8);
    normal.line = VaultSurface::Line::middle;
    normal.eye = 0.0;
    if (plan == Plan::Kind::circle) normal.eye = 5.0 * std::cos(75.0 * pi / 180.0);
    VaultSurface given = normal;
    given.beds = VaultSurface::Beds::given;
    given.bed_angles_deg = {0.0, plan == Plan::Kind::circle ? 75.0 : 90.0};
    const SurfaceMap a = make_surface(normal, 10), b = make_surface(given, 10);
    for (int bed = 0; bed <= 10; ++bed)
      for (const int layer : {0, 1})
        EXPECT_LT((a.point(bed, 0.3, layer) - b.point(bed, 0.3, layer)).norm(), 1e-13);
  }
}

// At a kink the skins behind the drawn line have a gap, which the beds that are not normal must not meet.
TEST(DrawnBeds, AtAKinkStandAtTheirAngles) {
  for (const double ratio : {0.8, 1.0})
    for (const auto line : {VaultSurface::Line::intrados, VaultSurface::Line::middle}) {
      VaultSurface pointed = vault_on(Plan::Kind::line, profile_of(Kind::pointed, 5.0), 0.3);
      pointed.profile.radius_ratio = ratio;
      pointed.line = line;
      pointed.beds = VaultSurface::Beds::given;
      pointed.bed_angles_deg = {0.0, 90.0};
      const SurfaceMap map = make_surface(pointed, 24);
      for (int bed = 0; bed <= 24; ++bed) {
        const Vec3 along = map.extrados(bed, 0) - map.intrados(bed, 0);
        EXPECT_NEAR(std::atan2(along.z(), along.x()), pi * bed / 24, 1e-12) << ratio << " " << bed;
      }
      const double e = 5.0 * ratio - 2.5,
                   back = 5.0 * ratio + (line == VaultSurface::Line::middle ? 0.15 : 0.3);
      EXPECT_NEAR(map.extrados(12, 0).z(), std::sqrt(back * back - e * e), 1e-12) << ratio;
    }
}

// A level bed through a kink meets the skin of the lower run outside the drawn line, of the upper one inside.
TEST(DrawnBeds, AtAKinkMeetTheSkinOfTheRunOnTheirSide) {
  VaultSurface level = vault_on(Plan::Kind::circle, chain_of({4, 3, 1}, {0, 3, 5}), 0.8);  // slopes 3 and 1
  level.line = VaultSurface::Line::middle;
  level.beds = VaultSurface::Beds::level;
  const SurfaceMap map = make_surface(level, 5);  // bed 3 is at the kink
  EXPECT_LT((map.extrados(3, 0) - Vec3(3 + 0.4 * std::sqrt(10) / 3, 0, 3)).norm(), 1e-13);
  EXPECT_LT((map.intrados(3, 0) - Vec3(3 - 0.4 * std::sqrt(2), 0, 3)).norm(), 1e-13);
}

// Courses by angle: the normals of an ellipse turn by the same angle from bed to bed.
TEST(DrawnBeds, CoursesByAngleTurnEqually) {
  VaultSurface oval = vault_on(Plan::Kind::line, profile_of(Kind::ellipse, 10.0, 3.0));
  oval.courses = VaultSurface::Courses::angle;
  const SurfaceMap map = make_surface(oval, 12);
  for (int bed = 0; bed <= 12; ++bed) {
    const Vec3 along = map.extrados(bed, 0) - map.intrados(bed, 0);
    EXPECT_NEAR(std::atan2(along.z(), along.x()), pi * bed / 12, 1e-12) << bed;
  }
  oval.profile = chain_of({3, 3, 0}, {0, 4, 7}, {0, 3});
  EXPECT_THROW(make_surface(oval, 12), InputError) << "a straight wall turns by nothing";
  oval.profile = profile_of(Kind::semicircle);
  oval.courses = VaultSurface::Courses::height;  // also where the profile comes down again
  const SurfaceMap level = make_surface(oval, 10);
  for (int bed = 0; bed <= 5; ++bed) EXPECT_NEAR(level.intrados(10 - bed, 0).z(), bed, 1e-12);
}

// The kinds with names are drawings: the same points to rounding.
TEST(DrawnProfile, DrawsTheNamedKinds) {
  const DomeSurface dome{10.0, 0.5, 0.6, 60.0};
  VaultSurface drawn = vault_on(Plan::Kind::circle, profile_of(Kind::semicircle), 0.6);
  drawn.eye = 2.5;
  const SurfaceMap a = make_surface(dome, 7), b = make_surface(drawn, 7);
  const OctagonalVault octagon{};
  VaultSurface sails = vault_on(Plan::Kind::polygon, profile_of(Kind::pointed, 45.0), 2.2);
  sails.beds = VaultSurface::Beds::conical;
  sails.eye = 36.0 * 0.5 - 13.5;
  const SurfaceMap c = make_surface(octagon, 7), d = make_surface(sails, 7);
  for (int bed = 0; bed <= 7; ++bed)
    for (const double azimuth : {0.0, 0.3, 2.0, 5.5})
      for (const int layer : {0, 1}) {
        EXPECT_LT((a.point(bed, azimuth, layer) - b.point(bed, azimuth, layer)).norm(), 1e-13);
        EXPECT_LT((c.point(bed, azimuth, layer) - d.point(bed, azimuth, layer)).norm(), 1e-12);
      }
}

/// m2, of upper beds that await the next course, of blocks on either side of x = 0.
std::pair<double, double> tops(const Assembly& assembly) {
  std::pair<double, double> area;
  for (const Part& part : assembly.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      if (assembly.face_kinds[f] == FaceKind::top)
        (assembly.blocks[part.block].centroid.x() < 0.0 ? area.first : area.second) +=
            polygon_area(face_points(assembly, f));
  return area;
}

TEST(DrawnStage, HasNoKeyStone) {
  Case scene = case_of(vault_on(Plan::Kind::circle, profile_of(Kind::semicircle)));
  std::get<VaultSurface>(scene.geometry.surface).key_stone = true;
  for (const int rings : {3, 8}) {
    scene.geometry.stage = Stage{rings};
    ModelReport report;
    const Assembly assembly = check_and_report(scene, &report);
    EXPECT_EQ(report.num_blocks, rings * 16);
    EXPECT_EQ(report.islands, 1);
    EXPECT_GT(tops(assembly).first, 0.0) << "the last bed is free";
  }
}

TEST(DrawnStage, OfABarrelRisesFromBothSpringings) {
  Case scene = case_of(vault_on(Plan::Kind::line, profile_of(Kind::semicircle)), 9);
  for (const int rings : {3, 5}) {
    scene.geometry.stage = Stage{rings};
    ModelReport report;
    const Assembly assembly = check_and_report(scene, &report);
    EXPECT_EQ(report.num_blocks, rings == 3 ? 4 * 16 + 2 * 17 : 5 * 16 + 4 * 17);  // half blocks in odd rings
    EXPECT_TRUE(report.blocks_without_joint.empty());
    Vec3 moment = Vec3::Zero();
    for (const Block& block : assembly.blocks)
      if (!block.fixed) moment += block.volume * block.centroid;
    EXPECT_NEAR(moment.x(), 0.0, 1e-12);  // rounding of volumes below 1 m3 at 5 m
    const auto [left, right] = tops(assembly);
    EXPECT_NEAR(left, right, 1e-12);
    EXPECT_EQ(left > 0.0, rings == 3);
  }
}

}  // namespace
}  // namespace cupola::drawn_test
