// Wythes: one of them changes nothing, several fill the shell or leave cavities, and their joints mate.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/model/loaded_faces.hpp"
#include "tests/generators/models.hpp"
#include "tests/test_names.hpp"

namespace cupola::wythe_test {
namespace {

using std::numbers::pi;

Wythe wythe(const std::string& name, double thickness, std::optional<Bond> bond) {
  return {name, {{}, {thickness}}, std::move(bond), {}};
}

/// m3 by member.
std::map<std::string, double> volumes(const Assembly& assembly) {
  std::map<std::string, double> sums;
  for (const Block& block : assembly.blocks)
    if (!block.fixed) sums[assembly.members[block.member]] += block.volume;
  return sums;
}

int count(const Assembly& assembly, const std::string& member) {
  return static_cast<int>(std::ranges::count_if(assembly.blocks, [&](const Block& block) {
    return !block.fixed && assembly.members[block.member] == member;
  }));
}

/// Two leaves of bricks 24 x 12 x 6 cm, 2.4 m long, without headers.
Case two_leaves(int rings) {
  Case c;
  c.geometry.surface = WallSurface{2.4, 0.06 * rings, 0.0};
  const RunningBond bond{rings, 10, 2};
  c.geometry.wythes = {wythe("back", 0.12, bond), wythe("front", 0.12, bond)};
  return c;
}

Bonders headers(int per_ring, double at, double width) {
  Bonders group;
  group.name = "header";
  group.from = "back";
  group.to = "front";
  group.per_ring = per_ring;
  group.at = {at};
  group.width = width;
  return group;
}

class OneWythe : public testing::TestWithParam<Surface> {};

// Layers and skins are the same points, so that nothing differs by a bit.
TEST_P(OneWythe, GivesTheShellOfThisThickness) {
  Case plain;
  plain.geometry.surface = GetParam();
  plain.geometry.bond = RunningBond{6, 16, 2};
  Case layered = plain;
  const double thickness = std::visit([](const auto& s) { return s.thickness; }, GetParam());
  std::visit([](auto& s) { s.thickness = 0.1; }, layered.geometry.surface);  // not in use
  layered.geometry.bond = StackBond{3, 8, 1};                                // not in use
  layered.geometry.wythes = {wythe("all", thickness, plain.geometry.bond)};
  const Assembly expected = cut_assembly(plain), found = cut_assembly(layered);
  EXPECT_EQ(found.face_vertices, expected.face_vertices);
  EXPECT_EQ(found.face_kinds, expected.face_kinds);
  ASSERT_EQ(found.vertices.size(), expected.vertices.size());
  for (size_t v = 0; v < found.vertices.size(); ++v) EXPECT_EQ(found.vertices[v], expected.vertices[v]);
  for (size_t b = 0; b < found.blocks.size(); ++b)
    EXPECT_EQ(found.blocks[b].volume, expected.blocks[b].volume);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, OneWythe,
                         testing::Values(Surface{DomeSurface{}}, Surface{OctagonalVault{}},
                                         Surface{ArchSurface{}}, Surface{WallSurface{}}),
                         test_names({"dome", "octagonal_vault", "arch", "wall"}));

// The front has courses of 12 cm, the back of 6: up to 0.29 m lie the middles of two of the front.
TEST(Wythes, EndBetweenTheirOwnCourses) {
  Case c = two_leaves(8);
  c.geometry.wythes[1].bond = RunningBond{4, 10, 2};
  c.geometry.wythes[1].where.to = 0.29;
  EXPECT_NEAR(volumes(generate(c)).at("front"), 2.4 * 0.12 * 0.24, 1e-12);
}

TEST(Wythes, OfAStretcherBondAreTwoWallsSideBySide) {
  ModelReport report;
  const Assembly assembly = check_and_report(two_leaves(4), &report);
  // Two courses of 10 bricks and two of 9 and two halves, in each leaf.
  EXPECT_EQ(count(assembly, "back"), 42);
  EXPECT_EQ(count(assembly, "front"), 42);
  EXPECT_NEAR(report.volume, 2.4 * 0.24 * 0.24, 1e-13);  // rounding of 84 volumes
  EXPECT_LT(report.max_overlap, 1e-9);
  EXPECT_EQ(report.num_parts, report.num_blocks);
}

// Headers half as long as stretchers in every other course, a quarter over each joint below.
TEST(Wythes, OfAnEnglishBondAlternateByCourse) {
  Case c = two_leaves(5);
  c.geometry.bonders = {headers(20, 0.0, 1.0)};
  c.geometry.bonders.front().every = 2;
  c.geometry.bonders.front().first = 1;
  ModelReport report;
  const Assembly assembly = check_and_report(c, &report);
  EXPECT_EQ(count(assembly, "back"), 30);    // three courses
  EXPECT_EQ(count(assembly, "header"), 42);  // two courses of 19 and two halves
  const auto volume = volumes(assembly);
  EXPECT_NEAR(volume.at("back"), 3 * 2.4 * 0.12 * 0.06, 1e-13);
  EXPECT_NEAR(volume.at("header"), 2 * 2.4 * 0.24 * 0.06, 1e-13);
  EXPECT_LT(report.max_overlap, 1e-9);
  EXPECT_EQ(report.islands, 1);
}

// A header takes a third of the spacing from the stretchers of both leaves, and stands over the middle of one
// below.
TEST(Wythes, OfAFlemishBondAlternateInTheCourse) {
  Case c = two_leaves(4);
  const RunningBond bond{4, 5, 2};
  c.geometry.wythes = {wythe("back", 0.12, bond), wythe("front", 0.12, bond)};
  c.geometry.bonders = {headers(5, 1.0 / 6, 1.0 / 3)};
  c.geometry.bonders.front().shift = 0.5;
  ModelReport report;
  const Assembly assembly = check_and_report(c, &report);
  EXPECT_EQ(count(assembly, "header"), 20);
  EXPECT_NEAR(volumes(assembly).at("header"), 20 * 0.16 * 0.24 * 0.06, 1e-13);
  EXPECT_NEAR(report.volume, 2.4 * 0.24 * 0.24, 1e-13);
  EXPECT_EQ(report.islands, 1);
  for (const Block& header : assembly.blocks) {
    if (header.fixed || header.ring == 0 || assembly.members[header.member] != "header") continue;
    const bool above_a_stretcher = std::ranges::any_of(assembly.blocks, [&](const Block& below) {
      return below.ring == header.ring - 1 && assembly.members[below.member] == "back" &&
             std::abs(below.centroid.x() - header.centroid.x()) < 1e-12;
    });
    EXPECT_TRUE(above_a_stretcher || header.centroid.x() < 0.1) << header.centroid.transpose();
  }
}

// A core of small stones between leaves of large ones, whose courses are three of the core.
TEST(Wythes, ShareTheBedsOfTheFinest) {
  Case c;
  c.geometry.surface = WallSurface{3.0, 1.8, 0.0};
  c.geometry.wythes = {wythe("back", 0.3, RunningBond{2, 3, 2}), wythe("core", 0.4, StackBond{6, 15, 1}),
                       wythe("front", 0.3, RunningBond{2, 3, 2})};
  ModelReport report;
  const Assembly assembly = check_and_report(c, &report);
  EXPECT_EQ(assembly.num_rings, 6);
  EXPECT_EQ(count(assembly, "core"), 90);
  EXPECT_EQ(count(assembly, "front"), 3 + 4);
  EXPECT_NEAR(volumes(assembly).at("core"), 3.0 * 1.8 * 0.4, 1e-12);
  EXPECT_LT(report.max_overlap, 1e-9);
}

/// Volume of the facets of one layer of a dome between meridian half-planes `delta` (rad) apart: between two
/// planes, the chords at radius rho are 2 rho sin(delta / 2) long and advance by cos(delta / 2) per rho, so
/// that V = S sin(delta) x the integral of rho over the section, which is made of plane quadrilaterals.
double faceted_volume(const std::vector<std::array<Eigen::Vector2d, 4>>& section, int slices) {
  double moment = 0.0;
  for (const auto& q : section)
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d &a = q[i], &b = q[(i + 1) % 4];
      moment += (a.x() * b.y() - b.x() * a.y()) * (a.x() + b.x()) / 6.0;
    }
  return slices * std::sin(2.0 * pi / slices) * std::abs(moment);
}

// Two shells of a dome that taper towards the eye, the cavity between them filled in the lowest courses and
// by eight ribs.
TEST(Wythes, OfADomeTaperAndLeaveACavity) {
  constexpr int kRings = 10, kBlocks = 16, kSlices = 32;
  Case c;
  const DomeSurface dome{};
  c.geometry.surface = dome;
  const RunningBond bond{kRings, kBlocks, 2};
  const double low = 4.0, high = 20.0;
  const auto taper = [&](const std::string& name, double from, double to, std::optional<Bond> b) {
    return Wythe{name, {{low, high}, {from, to}}, std::move(b), {}};
  };
  c.geometry.wythes = {taper("inner", 2.0, 1.5, bond), taper("cavity", 1.0, 1.2, {}),
                       taper("outer", 0.8, 0.4, bond)};
  Bonders base;
  base.name = "base";
  base.from = "inner";
  base.to = "outer";
  base.per_ring = kBlocks;
  base.where.to = 7.0;
  Bonders ribs = base;
  ribs.name = "rib";
  ribs.from = ribs.to = "cavity";
  ribs.per_ring = 8;
  ribs.at = {0.125};
  ribs.width = 0.25;  // one slice
  ribs.where = {7.0, {}};
  c.geometry.bonders = {base, ribs};
  ModelReport report;
  const Assembly assembly = check_and_report(c, &report);
  EXPECT_LT(report.max_overlap, 1e-9);
  EXPECT_EQ(report.islands, 1);

  const auto depth = [&](double h, double from, double to) {
    return from + (to - from) * std::clamp((h - low) / (high - low), 0.0, 1.0);
  };
  const auto at = [&](int bed, int layer) {
    const double t = dome.crown_angle_deg * pi / 180.0 * bed / kRings, h = dome.radius() * std::sin(t);
    double r = dome.radius();
    if (layer > 0) r += depth(h, 2.0, 1.5);
    if (layer > 1) r += depth(h, 1.0, 1.2);
    if (layer > 2) r += depth(h, 0.8, 0.4);
    return Eigen::Vector2d(r * std::cos(t) - dome.center_offset(), r * std::sin(t));
  };
  const auto section = [&](int from_layer, int to_layer, int from_bed, int to_bed) {
    std::vector<std::array<Eigen::Vector2d, 4>> quads;
    for (int k = from_bed; k < to_bed; ++k)
      quads.push_back({at(k, from_layer), at(k, to_layer), at(k + 1, to_layer), at(k + 1, from_layer)});
    return quads;
  };
  // The middles of courses 0 and 1 lie at 1.9 and 5.6 m, that of course 2 at 9.3 m.
  const auto volume = volumes(assembly);
  const double rounding = 1e-12 * report.volume;
  EXPECT_NEAR(volume.at("inner"), faceted_volume(section(0, 1, 2, kRings), kSlices), rounding);
  EXPECT_NEAR(volume.at("outer"), faceted_volume(section(2, 3, 2, kRings), kSlices), rounding);
  EXPECT_NEAR(volume.at("base"), faceted_volume(section(0, 3, 0, 2), kSlices), rounding);
  EXPECT_NEAR(volume.at("rib"), 0.25 * faceted_volume(section(1, 2, 2, kRings), kSlices), rounding);
}

/// An octagonal vault of two shells: corner ribs that reach through both in every other course, and lie in
/// the cavity in the courses between, so that warped joints between wythes occur on both sides of the cavity.
Case two_shells() {
  Case c;
  c.geometry.surface = OctagonalVault{};
  const RunningBond bond{12, 32, 4};
  c.geometry.wythes = {wythe("inner", 2.0, bond), wythe("cavity", 1.2, {}), wythe("outer", 0.8, bond)};
  Bonders through;
  through.name = "rib";
  through.from = "inner";
  through.to = "outer";
  through.per_ring = 8;
  through.at = {0.0};
  through.width = 0.25;
  through.every = 2;
  Bonders between = through;
  between.from = between.to = "cavity";
  between.first = 1;
  c.geometry.bonders = {through, between};
  return c;
}

TEST(Wythes, OfAnOctagonAreConvexAndMate) {
  ModelReport report;
  const Assembly assembly = check_and_report(two_shells(), &report);  // throws if a part is not convex
  EXPECT_LT(report.max_convexity_error, 3e-14);                       // rounding at 50 m
  EXPECT_LT(report.max_overlap, 1e-9);
  EXPECT_EQ(report.islands, 1);
  EXPECT_NEAR(report.parts_volume, report.volume, 1e-12 * report.volume);
  std::map<std::vector<int>, int> sides;
  for (int f = 0; f < assembly.num_faces(); ++f) {
    if (assembly.face_kinds[f] != FaceKind::wythe) continue;
    std::vector<int> ids(assembly.face(f).begin(), assembly.face(f).end());
    std::ranges::sort(ids);
    ++sides[ids];
  }
  EXPECT_GT(sides.size(), 100u);
  for (const auto& [ids, faces] : sides) EXPECT_EQ(faces, 2);
}

TEST(Wythes, OfAStageEndAtItsTop) {
  Case c = two_shells();
  c.geometry.stage = Stage{5};
  ModelReport report;
  const Assembly assembly = check_and_report(c, &report);
  EXPECT_EQ(report.islands, 1);
  for (const Block& block : assembly.blocks) EXPECT_LT(block.ring, 5);
}

// Bricks of a course over a sail, between held ends: two wythes with headers in every third course fill the
// sector of one.
TEST(Wythes, OfAWindowFillItsSector) {
  Case plain;
  OctagonalVault vault;
  vault.thickness = 0.68;
  plain.geometry.surface = vault;
  plain.geometry.bond = RunningBond{6, 45, 2};
  plain.geometry.window = Window{.height = 14.0, .ends = Window::Ends::held};
  plain.geometry.support_width = 0.3;
  Case layered = plain;
  layered.geometry.wythes = {wythe("back", 0.34, plain.geometry.bond),
                             wythe("front", 0.34, plain.geometry.bond)};
  layered.geometry.bonders = {headers(90, 0.0, 1.0)};
  layered.geometry.bonders.front().every = 3;
  ModelReport one, two;
  check_and_report(plain, &one);
  const Assembly assembly = check_and_report(layered, &two);
  EXPECT_NEAR(two.volume, one.volume,
              1e-12 * one.volume);  // rounding: all cuts of headers are cuts of the bond
  EXPECT_EQ(two.num_supports, 3);
  EXPECT_EQ(two.islands, 1);
  EXPECT_LT(two.max_overlap, 1e-9);
  EXPECT_GT(count(assembly, "header"), 2 * 89);
}

// The centre of an arch lies at z = 0, that of a segmental vault below its springing.
TEST(Wythes, CountHeightsFromTheSpringing) {
  const StackBond bond{15, 1, 1, {}};
  Case arch;
  arch.geometry.surface = ArchSurface{.half_embrace_deg = 45.0};
  arch.geometry.wythes = {{"ring", {{0.0, 1.4}, {1.0, 0.5}}, bond, {}}};
  Case segment = arch;
  VaultSurface same;
  same.plan.kind = Plan::Kind::line;
  same.profile.kind = Profile::Kind::segmental;
  same.profile.span = 10.0 * std::sin(pi / 4);
  same.profile.rise = 5.0 * (1.0 - std::cos(pi / 4));
  segment.geometry.surface = same;
  EXPECT_NEAR(volumes(generate(arch)).at("ring"), volumes(generate(segment)).at("ring"), 1e-12)
      << "rounding of rotated coordinates, m3";
}

// A springing below z = 0, and one below the other: no course is left out.
TEST(Wythes, BeginWithTheFirstCourse) {
  Case horseshoe;
  horseshoe.geometry.surface = ArchSurface{.half_embrace_deg = 110.0};
  VaultSurface rampant;
  rampant.plan.kind = Plan::Kind::line;
  rampant.profile.kind = Profile::Kind::chain;
  rampant.profile.points = {
      {5.0, 4.0, 0.0, -4.0, -5.0}, {0.0, 3.0, 4.0, 0.0, -4.0}, std::vector<double>(5, 0.0), {}};
  rampant.thickness = 0.5;
  Case falling = horseshoe;
  falling.geometry.surface = rampant;
  for (Case* c : {&horseshoe, &falling}) {
    c->geometry.wythes = {wythe("inner", 0.3, StackBond{20, 1, 1, {}})};
    ModelReport report;
    const Assembly assembly = check_and_report(*c, &report);
    EXPECT_EQ(count(assembly, "inner"), 20);
    EXPECT_EQ(report.islands, 1);
  }
}

/// m2, of the faces of a kind, projected on the ground.
double projected(const Assembly& assembly, FaceKind kind) {
  double sum = 0.0;
  for (const LoadedFace& face : faces_of_kind(assembly, std::array{kind}, 0, kLastRing, ""))
    sum += face.area * face.normal.z();
  return sum;
}

// A barrel of 2 m with a radius of 2 m, in 15 courses, the first three with two wythes of 0.3 m, up to 36 deg:
// the skins go on, on the only wythe, all but their steps there.
TEST(Wythes, ThatEndLeaveTheSkinToTheNext) {
  VaultSurface barrel;
  barrel.plan.kind = Plan::Kind::line;
  barrel.plan.length = 2.0;
  barrel.profile.span = 4.0;
  const double step = 0.3 * std::cos(0.2 * pi);
  for (const bool ends_outside : {true, false}) {
    Case c;
    c.geometry.surface = barrel;
    const RunningBond bond{15, 2, 2};
    c.geometry.wythes = {wythe("inner", 0.3, bond), wythe("outer", 0.3, bond)};
    c.geometry.wythes[ends_outside ? 1 : 0].where.to = 1.2;
    const Assembly assembly = generate(c);
    EXPECT_NEAR(projected(assembly, FaceKind::extrados), 4.0 * (2.6 - (ends_outside ? step : 0.0)), 1e-12);
    EXPECT_NEAR(projected(assembly, FaceKind::intrados), -4.0 * (2.0 + (ends_outside ? 0.0 : step)), 1e-12)
        << "rounding of 60 faces, m2";
  }
}

TEST(Wythes, RefuseWhatTheyDoNotSupport) {
  Case c = two_leaves(4);
  c.geometry.imperfections = Imperfections{.gap = 1e-3};
  EXPECT_THROW(cut_assembly(c), InputError);
  c = two_leaves(4);
  c.geometry.bonders = {headers(20, 0.0, 1.0)};
  c.geometry.bonders.front().first = 4;
  EXPECT_THROW(cut_assembly(c), InputError);
  c = two_leaves(4);
  for (Wythe& leaf : c.geometry.wythes) leaf.where.from = 0.1;
  EXPECT_THROW(generate(c), InputError) << "nothing below";
}

}  // namespace
}  // namespace cupola::wythe_test
