// Bodies cut from members: volumes against closed forms, which pieces become blocks, and what is refused.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/model/loaded_faces.hpp"
#include "generators/stereotomy/cut_blocks.hpp"
#include "tests/generators/models.hpp"
#include "tests/generators/stereotomy/cut_wall.hpp"

namespace cupola::cut_bodies_test {
namespace {

using test::barrel;
using test::kHeight;
using test::kInner;
using test::kLength;
using test::kThickness;
using test::plane;
using test::volume_of;
using test::wall;

Cut prism(std::vector<double> y, std::vector<double> z) {
  Cut cut;
  cut.kind = Cut::Kind::prism;
  cut.axis = Cut::Axis::x;
  cut.u = std::move(y);
  cut.v = std::move(z);
  return cut;
}

constexpr double kWhole = kLength * kHeight * kThickness;

TEST(CutBodies, APlaneLeavesOneSide) {
  ModelReport report;
  // Half of the wall: the plane passes through the middle, inclined.
  const Case c = wall({plane({0.0, kLength / 2, kHeight / 2}, {0.0, 1.0, 0.7})});
  EXPECT_NEAR(volume_of(c, &report), kWhole / 2, 1e-13);
  EXPECT_EQ(report.islands, 1);
}

TEST(CutBodies, ADoorIsAPrism) {
  ModelReport report;
  const Case c = wall({prism({1.3, 2.1, 2.1, 1.7, 1.3}, {-1.0, -1.0, 1.6, 2.0, 1.6})});
  const double door = 0.8 * 1.6 + 0.5 * 0.8 * 0.4;
  EXPECT_NEAR(volume_of(c, &report), kWhole - door * kThickness, 1e-13);
}

// The ends of a wall and the reveals of its window. Pieces of a stone between the corners of the window lie on
// each other with parts of their faces.
TEST(CutBodies, LoadsActOnTheRevealsAlone) {
  const std::vector<double> x{1.1, 2.3, 2.45, 1.7, 1.0}, z{0.9, 0.8, 1.7, 2.2, 1.6};
  Cut window = prism(x, z);
  window.axis = Cut::Axis::y;
  Case c = wall_case(10, 8);
  c.geometry.surface = WallSurface{.length = kLength, .height = kHeight, .thickness = kThickness};
  c.geometry.cuts = {window};
  double area = 2.0 * kHeight;
  for (size_t i = 0; i < x.size(); ++i)
    area += std::hypot(x[(i + 1) % x.size()] - x[i], z[(i + 1) % x.size()] - z[i]);
  double loaded = 0.0;
  for (const LoadedFace& face : faces_of_kind(generate(c), std::array{FaceKind::free}, 0, kLastRing, ""))
    loaded += face.area;
  EXPECT_NEAR(loaded, kThickness * area, 1e-13) << "rounding of sums of areas";
}

TEST(CutBodies, ARoundWindowIsAPolygon) {
  Cut round;
  round.kind = Cut::Kind::cylinder;
  round.axis = Cut::Axis::x;
  round.centre_u = 2.1;
  round.centre_v = 1.4;
  round.radius = 0.6;
  round.sides = 12;
  ModelReport report;
  const double polygon = 0.5 * 12 * std::sin(2.0 * std::numbers::pi / 12) * 0.36;
  EXPECT_NEAR(volume_of(wall({round}), &report), kWhole - polygon * kThickness, 1e-13);
  EXPECT_EQ(report.islands, 1);
  round.from = kInner + 0.2;  // a niche from outside
  EXPECT_NEAR(volume_of(wall({round}), &report), kWhole - polygon * (kThickness - 0.2), 1e-13);
}

TEST(CutBodies, WhatIsSeparatedBecomesABlock) {
  // A slot of 0.2 m in the first course, through the middle of a block of 1 m, which both halves survive.
  ModelReport whole, cut;
  volume_of(wall({}), &whole);
  volume_of(wall({prism({1.4, 1.6, 1.6, 1.4}, {-1.0, -1.0, 0.5, 0.5})}), &cut);
  EXPECT_EQ(cut.num_blocks, whole.num_blocks + 1);
  EXPECT_EQ(cut.islands, 1);
}

TEST(CutBodies, SmallRestsJoinTheirNeighbours) {
  // Blocks are 1 m long and 0.5 m high: the plane leaves 0.05 m of those at 3 m.
  ModelReport report;
  const Case c = wall({plane({0.0, 3.05, 0.0}, {0.0, 1.0, 0.0})});
  volume_of(c, &report);
  EXPECT_GT(report.smallest_block, 0.2 * 1.0 * 0.5 * kThickness);
}

// Planes at 0.6 m and 3.4 m leave 0.1 m of the stones of 1 m in odd courses, but for rounding: not less than a
// tenth, so that all twelve parted stones are two.
TEST(CutBodies, ATenthOfAStoneStaysWhateverTheRounding) {
  for (const double scale : {1.0, 7.3, 1e-3}) {
    std::vector<Cut> cuts;
    for (const double y : {0.6, 3.4}) cuts.push_back(plane({0, scale * y, 0}, {0, 1, 0}, Cut::As::joint));
    Case c = wall(cuts);
    VaultSurface& surface = std::get<VaultSurface>(c.geometry.surface);
    for (double* length :
         {&surface.plan.length, &surface.profile.height, &surface.profile.span, &surface.thickness})
      *length *= scale;
    EXPECT_EQ(std::ranges::count(cut_assembly(c).blocks, false, &Block::fixed), 3 * 4 + 3 * 5 + 12) << scale;
  }
}

/// A wall of uprights of three courses between flat stones, with a window whose top is z (m). An upright from
/// 0.5 m to 2 m high and 1/3 m wide ends at its right side; the window takes what is below z of it.
Assembly above_a_window(double z) {
  Case c;
  c.geometry.surface = WallSurface{.length = 4.0, .height = 3.0, .thickness = 0.5};
  HerringboneBond bond;
  bond.rings = 6;
  bond.blocks_per_ring = 4;
  bond.spirals = 1;
  bond.rings_per_vertical = bond.verticals_per_block = 3;
  bond.path = HerringboneBond::Path::meridian;
  c.geometry.bond = bond;
  Cut window = prism({0.6, 1.3, 1.3, 0.6}, {0.9, 0.9, z, z});
  window.axis = Cut::Axis::y;
  c.geometry.cuts = {window};
  return generate(c);
}

// 0.1 m of the upright of 1.5 m touch stones that begin two courses above its own first one.
TEST(CutBodies, ARestOfAnUprightJoinsANeighbourOfAnyOfItsCourses) {
  for (const Block& block : above_a_window(2.4).blocks) EXPECT_GT(block.volume, 0.1 * 0.25);
}

// 0.3 m of it are a stone in the course from 2 m to 2.5 m, between its neighbours there; all blocks have the
// courses that their parts have.
TEST(CutBodies, BlocksLieInTheCoursesThatTheCutsLeave) {
  const Assembly assembly = above_a_window(2.2);
  const auto top = std::ranges::find_if(assembly.blocks, [](const Block& block) {
    return !block.fixed && std::abs(block.centroid.x() - 2.5 / 3) < 1e-12 && block.centroid.z() > 2.2;
  });
  ASSERT_NE(top, assembly.blocks.end());
  EXPECT_NEAR(top->centroid.z(), 2.35, 1e-12);
  EXPECT_EQ(std::pair(top->ring, top->num_rings), std::pair(4, 1));
  EXPECT_EQ(std::pair((top - 1)->ring, (top + 1)->ring), std::pair(4, 4));
  EXPECT_LT((top - 1)->centroid.x(), top->centroid.x());
  EXPECT_GT((top + 1)->centroid.x(), top->centroid.x());
  EXPECT_EQ(top->slot, (top - 1)->slot + 1);
  Case level = wall({plane({0, 0, 1.04}, {0, 0, 1})});  // 4 cm of the third course join the second
  for (const Assembly& cut : {assembly, generate(level)})
    for (const Part& part : cut.parts) {
      const Block& block = cut.blocks[part.block];
      EXPECT_TRUE(part.ring >= block.ring && part.ring < block.ring + block.num_rings);
    }
}

// The stones lie off the supports, and the rests off their neighbours, by up to half a gap and a gap.
TEST(CutBodies, GapsChangeNeitherSupportsNorBlocks) {
  for (const auto profile : {Profile::Kind::straight, Profile::Kind::semicircle}) {
    Case c = wall({plane({0.0, 3.05, 0.0}, {0.0, 1.0, 0.0})});
    std::get<VaultSurface>(c.geometry.surface).profile.kind = profile;
    ModelReport tight, open;
    check_and_report(c, &tight);
    c.geometry.imperfections = Imperfections{};
    c.geometry.imperfections->gap = 2e-3;  // m, less than the margin of joints, 1 % of a block
    check_and_report(c, &open);
    EXPECT_EQ(open.num_supports, tight.num_supports);
    EXPECT_EQ(open.num_blocks, tight.num_blocks);
    EXPECT_EQ(open.islands, 1);
    EXPECT_GT(open.smallest_block, 0.9 * tight.smallest_block);
    c.contact.margin = 1e-4;
    try {
      check_and_report(c, &open);
      ADD_FAILURE();
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("imperfections.gap = 0.002 m is wider than contact.margin"),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(CutBodies, AHeldCutHasASupport) {
  ModelReport report;
  const Case c = wall({plane({0.0, 3.3, 0.0}, {0.0, 1.0, 0.0}, Cut::As::held)});
  const Assembly assembly = check_and_report(c, &report);
  EXPECT_EQ(report.num_supports, 2);
  ASSERT_TRUE(assembly.blocks.back().fixed);
  EXPECT_NEAR(assembly.blocks.back().volume, kThickness * kHeight * 1.0, 1e-13) << "support_width is 1 m";
  EXPECT_GT(assembly.blocks.back().centroid.y(), 3.3);
}

// A hemisphere over a square: the volume between two spheres inside the square, by quadrature over the
// square.
TEST(CutBodies, ASailVaultStandsOverASquare) {
  VaultSurface dome;
  dome.profile.span = 14.0;
  dome.thickness = 0.5;
  dome.eye = 0.6;
  dome.key_stone = true;
  Case c;
  c.geometry.surface = dome;
  c.geometry.bond = RunningBond{48, 96, 2};
  for (const double x : {1.0, -1.0}) {
    c.geometry.cuts.push_back(plane({5.15 * x, 0.0, 0.0}, {x, 0.0, 0.0}));
    c.geometry.cuts.push_back(plane({0.0, 5.15 * x, 0.0}, {0.0, x, 0.0}));
  }
  ModelReport report;
  const Assembly assembly = check_and_report(c, &report);
  EXPECT_EQ(report.islands, 1);
  for (const Block& block : assembly.blocks)
    EXPECT_LT(block.centroid.head<2>().lpNorm<Eigen::Infinity>(), 5.15);
  double expected = 0.0;
  constexpr int n = 2000;
  const auto height = [](double square) { return square > 0.0 ? std::sqrt(square) : 0.0; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = 5.15 * (i + 0.5) / n, y = 5.15 * (j + 0.5) / n, rr = x * x + y * y;
      expected += 4.0 * 5.15 * 5.15 / (n * n) * (height(7.5 * 7.5 - rr) - height(7.0 * 7.0 - rr));
    }
  // The facets of 48 courses and 192 slices, and the level crown of the key stone: below (pi / 96)^2 / 2.
  EXPECT_NEAR(report.volume / expected, 1.0, 2e-3);
}

// A rest in a corner touches other rests alone: it joins the stone of which one of them has become a part.
// Four rests of 0.4 cm3 were left.
TEST(CutBodies, RestsBetweenRestsJoinTheirStones) {
  VaultSurface dome;
  dome.profile.span = 7.8;
  dome.thickness = 0.25;
  dome.eye = 0.4;
  dome.key_stone = true;
  Case c;
  c.geometry.surface = dome;
  c.geometry.bond = RunningBond{20, 40, 2};
  for (const double x : {1.0, -1.0}) {
    c.geometry.cuts.push_back(plane({2.5 * x, 0.0, 0.0}, {x, 0.0, 0.0}));
    c.geometry.cuts.push_back(plane({0.0, 2.5 * x, 0.0}, {0.0, x, 0.0}));
  }
  for (Cut& cut : c.geometry.cuts) cut.as = Cut::As::held;
  ModelReport report;
  check_and_report(c, &report);
  // A tenth of a stone near the crown, which are the smallest.
  EXPECT_GT(report.smallest_block, 1e-4);
}

// A plane across the wall parts the blocks that it meets, and takes nothing.
TEST(CutBodies, AJointPartsBlocks) {
  ModelReport whole, parted;
  volume_of(wall({}), &whole);
  const Case c = wall({plane({0.0, 1.45, 0.0}, {0.0, 1.0, 0.0}, Cut::As::joint)});
  EXPECT_NEAR(volume_of(c, &parted), kWhole, 1e-13);
  // In even courses the plane passes through the second block, and in odd ones 0.05 m before its end.
  EXPECT_EQ(parted.num_blocks, whole.num_blocks + 3)
      << "in odd courses the rest joins its neighbour on its side";
  EXPECT_EQ(parted.islands, 1);
  const Assembly assembly = cut_assembly(c);
  for (const Part& part : assembly.parts) {
    if (assembly.blocks[part.block].fixed) continue;
    double low = 1e9, high = -1e9;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      for (const Vec3& p : face_points(assembly, f)) {
        low = std::min(low, p.y());
        high = std::max(high, p.y());
      }
    EXPECT_TRUE(high < 1.45 + 1e-12 || low > 1.45 - 1e-12);
  }
}

/// x > 0 of a polygonal semicircle with n courses at a height.
double half_width(double radius, int n, double z) {
  for (int k = 0; 2 * k < n; ++k) {
    const double a = std::numbers::pi * k / n, b = std::numbers::pi * (k + 1) / n;
    if (z > radius * std::sin(b)) continue;
    const double share = (z / radius - std::sin(a)) / (std::sin(b) - std::sin(a));
    return radius * ((1.0 - share) * std::cos(a) + share * std::cos(b));
  }
  return 0.0;
}

// A barrel along y and a smaller one along x that meets its side: both volumes by slices at equal height, in
// which all is rectangles with sides linear in z between the beds, so that Simpson's rule is exact there.
TEST(CutBodies, ALunetteIsCutUnderTheOtherBarrel) {
  constexpr int n = 12, m = 10;  // courses, even: a joint in the crown
  constexpr double kMain = 4.0, kSmall = 1.5, kThick = 0.6, kThin = 0.4, kEnd = 6.0, kLong = 8.0;
  Member main, lunette;
  main.name = "main";
  main.surface = barrel(2 * kMain, kThick, kLong);
  main.bond = RunningBond{n, 8, 2};
  main.cuts.emplace_back().kind = Cut::Kind::under;
  main.cuts[0].member = "lunette";
  lunette.name = "lunette";
  lunette.surface = barrel(2 * kSmall, kThin, kEnd);
  lunette.bond = RunningBond{m, 6, 2};
  lunette.at = Place{{0.0, kLong / 2, 0.0}, -90.0};  // its y axis becomes x
  lunette.cuts.emplace_back().kind = Cut::Kind::under;
  lunette.cuts[0].member = "main";
  lunette.cuts[0].face = Cut::Face::intrados;
  Case c;
  c.geometry.members = {main, lunette};
  c.geometry.has_shell = false;
  ModelReport report;
  const double volume = volume_of(c, &report);
  EXPECT_EQ(report.islands, 1);
  std::vector<double> levels{0.0};
  for (const auto& [radius, courses] :
       {std::pair(kMain, n), {kMain + kThick, n}, {kSmall, m}, {kSmall + kThin, m}})
    for (int k = 1; 2 * k <= courses; ++k)
      levels.push_back(radius * std::sin(std::numbers::pi * k / courses));
  std::ranges::sort(levels);
  const auto slice = [&](double z) {
    const double xi = half_width(kMain, n, z), xe = half_width(kMain + kThick, n, z),
                 yi = half_width(kSmall, m, z), ye = half_width(kSmall + kThin, m, z);
    const double whole = 2.0 * (xe - xi) * kLong, opening = 2.0 * ye * (xe - xi);
    return whole - opening + 2.0 * (ye - yi) * (kEnd - xi);
  };
  double expected = 0.0;
  for (size_t i = 0; i + 1 < levels.size(); ++i) {
    const double a = levels[i], b = levels[i + 1], inset = 1e-12;
    expected += (b - a) / 6.0 * (slice(a + inset) + 4.0 * slice(0.5 * (a + b)) + slice(b - inset));
  }
  EXPECT_NEAR(volume / expected, 1.0, 1e-10);  // of the inset
}

TEST(CutBodies, AreRefusedIfTheyTakeNothingOrAll) {
  EXPECT_NE(refusal_of(wall({plane({0, 9, 0}, {0, 1, 0})})).find("geometry.cuts[0]: the cut takes nothing"),
            std::string::npos);
  EXPECT_NE(
      refusal_of(wall({plane({0, -9, 0}, {0, 1, 0})})).find("geometry.cuts[0]: the cut takes all blocks"),
      std::string::npos);
  EXPECT_NE(refusal_of(wall({plane({0, 9, 0}, {0, 1, 0}, Cut::As::joint)}))
                .find("geometry.cuts[0]: the plane parts no block"),
            std::string::npos);
  // The support under the wall reaches 1 m beyond its end.
  EXPECT_NE(refusal_of(wall({plane({0, kLength + 0.5, 0}, {0, 1, 0}, Cut::As::held)}))
                .find("geometry.cuts[0].as = held: the plane meets a support only"),
            std::string::npos);
  Cut under;
  under.kind = Cut::Kind::under;
  under.member = "nave";
  EXPECT_NE(refusal_of(wall({under})).find("geometry.cuts[0].member = nave: must be another member"),
            std::string::npos);
  EXPECT_NE(refusal_of(wall({prism({-1, 5, 5, -1}, {1.2, 1.2, 1.3, 1.3})})).find("shell floats"),
            std::string::npos);
}

// They were dropped as slivers of a cut that does not meet them, without a word.
TEST(CutBodies, StonesTurnedInsideOutAreRefusedWithAndWithoutCuts) {
  for (const std::vector<Cut>& cuts : {std::vector<Cut>{}, {plane({0, kLength - 0.5, 0}, {0, 1, 0})}}) {
    std::vector<Storey> storeys = make_storeys(wall(cuts).geometry);
    storeys[0].surface.at = [at = storeys[0].surface.at](double bed, double abscissa, double depth) -> Vec3 {
      return at(bed, abscissa, bed > 3.5 ? -depth : depth);
    };
    try {
      cut_blocks(storeys, {});
      ADD_FAILURE() << "laid with " << cuts.size() << " cuts";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("geometry.surface: block "), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace cupola::cut_bodies_test
