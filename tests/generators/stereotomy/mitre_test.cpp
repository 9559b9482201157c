// Members that meet in a mitre, and their copies.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "assembly/model/loaded_faces.hpp"
#include "generators/stereotomy/cut_blocks.hpp"
#include "tests/generators/stereotomy/cut_wall.hpp"

namespace cupola::mitre_test {
namespace {

using test::barrel;
using test::plane;
using test::volume_of;

/// A corridor that turns a corner: a barrel along y up to its mitre with one along x.
Case corridor(const Vec3& origin_of_second) {
  Member first, second;
  first.name = "first";
  first.surface = barrel(4.0, 0.4, 8.0);
  first.bond = RunningBond{9, 8, 2};
  first.cuts = {plane({0.0, 5.0, 0.0}, {1.0, 1.0, 0.0}, Cut::As::mitre)};
  first.cuts[0].member = "second";
  second.name = "second";
  second.surface = first.surface;
  second.bond = first.bond;
  second.at = Place{origin_of_second, -90.0};
  Case c;
  c.geometry.members = {first, second};
  c.geometry.has_shell = false;
  return c;
}

// Each barrel is 5 m long in its middle, and longer on one side by what it is shorter on the other. Its
// section lies between two half polygons of 18 sides.
TEST(Mitres, AMitreCutsBothMembers) {
  const Case c = corridor({-3.0, 5.0, 0.0});
  ModelReport report;
  const double section = 9.0 / 2.0 * std::sin(std::numbers::pi / 9) * (2.4 * 2.4 - 2.0 * 2.0);
  EXPECT_NEAR(volume_of(c, &report), 2.0 * 5.0 * section, 1e-12 * 10.0);
  EXPECT_EQ(report.islands, 1);
  EXPECT_LT(report.max_joint_gap, 1e-10);
  const Assembly assembly = cut_assembly(c);
  double area = 0.0;  // m2, of both sides of the mitre: the section, seen at 45 degrees
  for (const Part& part : assembly.parts) {
    if (assembly.blocks[part.block].fixed) continue;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      const std::vector<Vec3> points = face_points(assembly, f);
      if (!std::ranges::all_of(points, [](const Vec3& p) { return std::abs(p.x() + p.y() - 5.0) < 1e-12; }))
        continue;
      area += polygon_area(points);
      EXPECT_EQ(assembly.face_kinds[f], FaceKind::head);
    }
  }
  EXPECT_NEAR(area, 2.0 * std::numbers::sqrt2 * section, 1e-12);
}

// An arch springs from a wall by beds, whichever way the wall looks: at 45 degrees or more from its beds the
// mitre lies nearer to its heads, and on those of the arch all the same.
TEST(Mitres, ASkewbackIsABedOfItsArch) {
  for (const double rise_deg : {30.0, 60.0, 80.0}) {
    const double rise = rise_deg * std::numbers::pi / 180.0;
    Member pier;
    pier.name = "pier";
    pier.at = Place{{1.0, 0.0, 0.0}};
    pier.mirror = Mirror{Vec3::Zero(), Vec3::UnitX()};
    pier.surface = WallSurface{1.0, 2.6, 0.4};
    pier.bond = RunningBond{13, 2, 2};
    pier.cuts = {plane({0.0, 0.0, 2.0}, {-std::sin(rise), 0.0, std::cos(rise)}, Cut::As::mitre)};
    pier.cuts[0].member = "arch";
    Member arch;
    arch.name = "arch";
    arch.at = Place{{0.0, 0.0, 2.0}};
    VaultSurface surface = barrel(2.0, 0.3, 0.4);
    surface.profile.kind = Profile::Kind::chain;
    surface.profile.points = {{1.0, 0.0}, {0.0, 0.0}, {}, {}};
    surface.beds = VaultSurface::Beds::given;
    surface.bed_angles_deg = {rise_deg, 90.0};
    arch.surface = surface;
    arch.bond = StackBond{9, 1, 1, {}};
    Case c;
    c.geometry.members = {pier, arch};
    c.geometry.has_shell = false;
    const Assembly assembly = generate(c);
    int found = 0;
    for (const Part& part : assembly.parts)
      for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
        const Plane face = polygon_plane(face_points(assembly, f));
        if (assembly.blocks[part.block].fixed ||
            std::abs(std::abs(face.normal.dot(Vec3(std::sin(rise), 0.0, std::cos(rise)))) - 1.0) > 1e-9)
          continue;
        ++found;
        EXPECT_EQ(assembly.face_kinds[f], FaceKind::bed) << rise_deg;
      }
    EXPECT_GE(found, 2) << rise_deg;
  }
}

TEST(Mitres, AMitreIsRefusedWhereTheMembersDoNotMeet) {
  EXPECT_NE(refusal_of(corridor({-3.0, 5.0, 4.0})).find("no stone of first meets one of second on the plane"),
            std::string::npos)
      << refusal_of(corridor({-3.0, 5.0, 4.0}));
  EXPECT_NE(refusal_of(corridor({5.0, 5.0, 0.0}))
                .find("geometry.members[0].cuts[0].member = second: the cut takes nothing"),
            std::string::npos)
      << refusal_of(corridor({5.0, 5.0, 0.0}));
}

TEST(Mitres, AMitreOfACopyCutsTheCopyOfTheOtherMember) {
  const Case one = corridor({-3.0, 5.0, 0.0});
  ModelReport report;
  const double volume = volume_of(one, &report);
  Case row = one, image = one, alone = one, itself = one;
  for (Member& member : row.geometry.members) member.copies = Copies{2, std::nullopt, {0.0, 20.0, 0.0}};
  for (Member& member : image.geometry.members) member.mirror = Mirror{{0.0, -3.0, 0.0}, {0.0, 1.0, 0.0}};
  for (const Case& two : {row, image}) {
    EXPECT_NEAR(volume_of(two, &report), 2.0 * volume, 1e-11);  // rounding of coordinates up to 30 m
    EXPECT_EQ(report.islands, 2);
  }
  alone.geometry.members[0].copies = Copies{3, std::nullopt, {0.0, 20.0, 0.0}};
  alone.geometry.members[1].copies = Copies{2, std::nullopt, {0.0, 20.0, 0.0}};
  itself.geometry.members[0].copies = Copies{4, Vec3(-3.0, 5.0, 0.0), Vec3::Zero()};
  itself.geometry.members[0].cuts[0].member = "first 2";
  for (const auto& [refused, who] : {std::pair(&alone, "first 3"), std::pair(&itself, "first")})
    EXPECT_NE(refusal_of(*refused).find("that has its number, which " + std::string(who) + " does not have"),
              std::string::npos)
        << refusal_of(*refused);
}

}  // namespace
}  // namespace cupola::mitre_test
