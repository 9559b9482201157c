// Vaults and arches that stand on several copies of a member: bays and arcades.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "assembly/files/assembly_file.hpp"
#include "generators/generate.hpp"
#include "tests/fresh_folder.hpp"
#include "tests/generators/models.hpp"

namespace cupola::on_copies_test {
namespace {

Member pier(const Place& at) {
  Member member;
  member.name = "pier";
  member.at = at;
  member.surface = WallSurface{1.0, 3.0, 1.0};
  member.bond = StackBond{3, 1, 1, {}};
  return member;
}

/// A groin vault over a square of 6 m, 4 m wide along y, on piers whose corners lie on its axis by 2 and 3 m.
Case bay() {
  constexpr double kHalfX = 3.0, kHalfY = 2.0, kInside = 0.5;
  Case c;
  VaultSurface groin;
  groin.plan.kind = Plan::Kind::groin;
  groin.plan.sides = 4;
  groin.plan.springers = 2;
  groin.profile.span = 2.0 * kHalfX;
  groin.thickness = 0.3;
  c.geometry.surface = groin;
  c.geometry.bond = RunningBond{14, 6, 2};
  c.geometry.affine = Affine{.scale = {1.0, kHalfY / kHalfX, 1.0}};
  Member piers = pier(Place{{kHalfX - kInside, kHalfY - kInside, 0.0}});
  piers.affine = Affine{};
  piers.copies.emplace();
  for (const auto& [x, y, turn] : {std::array{-kHalfX + kInside, kHalfY - kInside, 90.0},
                                   {-kHalfX + kInside, -kHalfY + kInside, 180.0},
                                   {kHalfX - kInside, -kHalfY + kInside, 270.0}})
    piers.copies->at.push_back({{x, y, 0.0}, turn});
  c.geometry.members = {piers};
  c.geometry.on = "pier";
  return c;
}

/// Three half circles of 3 m and 0.5 m thick, between four piers at distances of 4 m.
Case arcade() {
  Case c;
  Member piers = pier(Place{{-0.5, 0.0, 0.0}});
  piers.copies = Copies{.count = 4, .by = {4.0, 0.0, 0.0}};
  c.geometry.members = {piers};
  VaultSurface arch;
  arch.plan.kind = Plan::Kind::line;
  arch.plan.length = 1.0;
  arch.profile.span = 3.0;
  arch.thickness = 0.5;
  c.geometry.surface = arch;
  c.geometry.bond = StackBond{15, 1, 1, {}};
  c.geometry.on = "pier";
  c.geometry.at = Place{{2.0, 0.0, 0.0}};
  c.geometry.copies = Copies{.count = 3, .by = {4.0, 0.0, 0.0}};
  return c;
}

// The vault has the volume of that over the square, by the scale; the piers keep theirs.
TEST(OnCopies, BaysMayBeRectangles) {
  Case square;
  square.geometry.surface = bay().geometry.surface;
  square.geometry.bond = bay().geometry.bond;
  ModelReport alone, report;
  check_and_report(square, &alone);
  const Assembly assembly = check_and_report(bay(), &report);
  EXPECT_NEAR(report.volume, alone.volume * 2.0 / 3.0 + 4.0 * 3.0, 1e-13 * report.volume) << "rounding";
  EXPECT_EQ(report.num_supports, 4);
  EXPECT_EQ(report.islands, 1);
  EXPECT_TRUE(report.hanging_corners.empty());
  ASSERT_EQ(assembly.sheets.size(), 5u);
  EXPECT_LT((assembly.sheets[4].origin.head<2>()).norm(), 1e-15) << "the mean of the places of the piers";
}

TEST(OnCopies, BaysMayShareTheirPiers) {
  Case two = bay();
  two.geometry.at = Place{};
  two.geometry.copies = Copies{.count = 2, .by = {0.0, 4.0, 0.0}};
  Copies& piers = *two.geometry.members[0].copies;
  for (const auto& [x, turn] : {std::pair(2.5, 0.0), {-2.5, 90.0}}) piers.at.push_back({{x, 5.5, 0.0}, turn});
  two.geometry.members[0].surface = WallSurface{1.0, 3.0, 1.0};
  ModelReport one, report;
  check_and_report(bay(), &one);
  const Assembly assembly = check_and_report(two, &report);
  EXPECT_NEAR(report.volume, 2.0 * one.volume - 2.0 * 3.0, 1e-13 * report.volume) << "six piers, not eight";
  EXPECT_EQ(report.num_supports, 6);
  EXPECT_EQ(report.islands, 1);
  EXPECT_TRUE(report.hanging_corners.empty());
  EXPECT_EQ(assembly.sheets.back().name, "shell 2");
  EXPECT_GT(report.num_joints, 2 * one.num_joints - 8) << "and the bays touch each other";
}

TEST(OnCopies, ArchesMayShareThem) {
  ModelReport report;
  const Assembly assembly = check_and_report(arcade(), &report);
  EXPECT_EQ(report.num_blocks, 4 * 3 + 3 * 15);
  EXPECT_EQ(report.num_supports, 4);
  EXPECT_EQ(report.islands, 1);
  // 2 in each pier, 14 in each arch, 6 under feet, 4 under piers, and the feet of two arches touch in none.
  EXPECT_EQ(report.num_joints, 4 * 2 + 3 * 14 + 6 + 4);
  const double ring = 0.5 * std::numbers::pi * (2.0 * 2.0 - 1.5 * 1.5),
               chords = std::sin(std::numbers::pi / 15);
  EXPECT_NEAR(report.volume, 4.0 * 3.0 + 3.0 * ring * chords * 15 / std::numbers::pi, 1e-12);
  for (const Sheet& sheet : assembly.sheets) EXPECT_FALSE(sheet.on_previous) << sheet.name;
}

// Four piers at the corners of a square, two arches between them along x and two along y.
TEST(OnCopies, SeveralMembersMayShareThem) {
  Case square;
  Member piers = pier(Place{{-0.5, -0.5, 0.0}});
  piers.copies.emplace();
  for (const auto& [x, y] : {std::pair(3.5, -0.5), {-0.5, 3.5}, {3.5, 3.5}})
    piers.copies->at.push_back({{x, y, 0.0}});
  VaultSurface arch;
  arch.plan.kind = Plan::Kind::line;
  arch.plan.length = 0.4;
  arch.profile.span = 3.2;
  arch.thickness = 0.4;
  Member along;
  along.name = "along";
  along.on = "pier";
  along.surface = arch;
  along.bond = StackBond{15, 1, 1, {}};
  along.at = Place{{2.0, -0.4, 0.0}};
  along.copies = Copies{.count = 2, .by = {0.0, 4.4, 0.0}};
  Member across = along;
  across.name = "across";
  across.at = Place{{0.0, 2.0, 0.0}, 90.0};
  across.copies->by = {4.4, 0.0, 0.0};
  square.geometry.members = {piers, along, across};
  square.geometry.has_shell = false;
  ModelReport report;
  check_and_report(square, &report);
  EXPECT_EQ(report.num_blocks, 4 * 3 + 4 * 15);
  EXPECT_EQ(report.num_joints, 4 * (1 + 2) + 4 * (14 + 2));
  EXPECT_EQ(report.islands, 1);
}

// Two arches apart on two piers each, the second across the first: all piers come before both in the list.
TEST(OnCopies, APierPushesAsTheArchOnIt) {
  Case two = arcade();
  Copies& piers = *two.geometry.members[0].copies;
  piers.count = 1;
  for (const auto& [x, y] : {std::pair(3.5, 0.0), {20.0, 0.0}, {20.0, 4.0}})
    piers.at.push_back({{x, y, 0.0}});
  two.geometry.copies = Copies{.at = {{{20.5, 2.5, 0.0}, 90.0}}};
  const Assembly assembly = generate(two);
  ASSERT_EQ(assembly.sheets.size(), 6u);
  for (const int pier : {0, 1}) {
    EXPECT_EQ(assembly.vault_of(3 * pier), &assembly.sheets[4]) << pier;
    EXPECT_EQ(assembly.vault_of(3 * (pier + 2)), &assembly.sheets[5]) << pier;
  }
  const Vec3 foot(20.5, 0.5, 0.0);
  EXPECT_LT((assembly.outward(6, foot) + Vec3::UnitY()).norm(), 1e-15) << "rounding of 90 degrees";
  const std::string path = test::fresh_folder("on_copies") + "/assembly.vtu";
  write_assembly(path, assembly);
  EXPECT_EQ(read_assembly(path).sheets, assembly.sheets);
}

TEST(OnCopies, WhatHangsIsRefused) {
  Case far = arcade(), one = arcade(), lone = arcade();
  far.geometry.copies->count = 4;  // the last foot lies where a fifth pier would stand
  EXPECT_NE(refusal_of(far).find("geometry.at: nothing stands under the foot of shell 4 at (15.5, 0, 3) m"),
            std::string::npos)
      << refusal_of(far);
  lone.geometry.members[0].copies.reset();
  lone.geometry.copies.reset();
  EXPECT_NE(refusal_of(lone).find("geometry.at: nothing stands under the foot of shell at (3.5, 0, 3) m"),
            std::string::npos)
      << refusal_of(lone);
  one.geometry.surface = WallSurface{1.0, 1.0, 1.0};
  EXPECT_NE(refusal_of(one).find("geometry.at: a member that stands on pier lies on its axis"),
            std::string::npos)
      << refusal_of(one);
}

Case case_of(std::vector<Member> members) {
  Case c;
  c.geometry.members = std::move(members);
  c.geometry.has_shell = false;
  return c;
}

/// A wall from x, 0.8 m long.
Member wall_from(const std::string& name, double x) {
  Member wall;
  wall.name = name;
  wall.at = Place{{x, 0.0, 0.0}, 0.0};
  wall.surface = WallSurface{.length = 0.8, .height = 3.0, .thickness = 0.6};
  wall.bond = StackBond{4, 1, 1, {}};
  return wall;
}

// Each message names a cure, which works.
TEST(OnCopies, ErrorsOfMembersOnTwoBearersNameACure) {
  Member left = wall_from("left", -1.6), lintel = wall_from("lintel", 0.0);
  lintel.on = "left";
  lintel.at.reset();
  std::get<WallSurface>(lintel.surface).length = 3.2;
  left.mirror = Mirror{};
  EXPECT_NE(refusal_of(case_of({left, lintel})).find("list the others as a member after it"),
            std::string::npos);
  left.mirror.reset();
  ModelReport report;
  check_and_report(case_of({left, lintel, wall_from("right", 0.8)}), &report);
  EXPECT_EQ(report.islands, 1);

  VaultSurface horseshoe;
  horseshoe.plan.kind = Plan::Kind::line;
  horseshoe.plan.length = 0.6;
  horseshoe.profile.kind = Profile::Kind::horseshoe;
  horseshoe.profile.span = 2.0;
  horseshoe.profile.below_deg = 25.0;
  horseshoe.thickness = 0.3;
  horseshoe.beds = VaultSurface::Beds::given;
  horseshoe.bed_angles_deg = {0.0, 90.0};
  Member arch;
  arch.name = "arch";
  arch.on = "left";
  arch.surface = horseshoe;
  arch.bond = StackBond{11, 1, 1, {}};
  left.mirror = Mirror{};
  EXPECT_NE(refusal_of(case_of({left, arch})).find("here {origin: [0, 0, 0]}"), std::string::npos);
  arch.at = Place{};
  check_and_report(case_of({left, arch}), &report);
  EXPECT_EQ(report.islands, 1);
}

}  // namespace
}  // namespace cupola::on_copies_test
