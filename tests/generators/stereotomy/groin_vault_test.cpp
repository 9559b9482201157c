// Groin vaults: volumes against the closed form, stones across the groins counted by hand, supports, affine
// images.

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "generators/generate.hpp"
#include "generators/stereotomy/convex_clip.hpp"
#include "generators/surface/make_surface.hpp"
#include "tests/generators/models.hpp"

namespace cupola::groin_vault_test {
namespace {

using Groins = Plan::Groins;
using Kind = Profile::Kind;

VaultSurface groin_over(int sides, Kind profile = Kind::semicircle, Groins groins = Groins::bonded) {
  VaultSurface v;
  v.plan.kind = Plan::Kind::groin;
  v.plan.sides = sides;
  v.plan.groins = groins;
  v.profile.kind = profile;
  v.profile.span = 6.0;
  v.profile.rise = 2.0;
  v.thickness = 0.3;
  return v;
}

Case case_of(const VaultSurface& surface, const Bond& bond) {
  Case c;
  c.geometry.surface = surface;
  c.geometry.bond = bond;
  return c;
}

/// The part of a convex polygon (x, z) with x >= 0.
std::vector<Eigen::Vector2d> right_of_axis(const std::vector<Eigen::Vector2d>& polygon) {
  std::vector<Eigen::Vector2d> out;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (a.x() >= 0.0) out.push_back(a);
    if (a.x() * b.x() < 0.0) out.push_back(a + a.x() / (a.x() - b.x()) * (b - a));
  }
  return out;
}

/// m3: 2 n cot(pi / n) times the integral of s / 2 - x over the polygons between the beds of half a web.
double closed_form(const VaultSurface& surface, int rings) {
  const SurfaceMap web = make_surface(surface, rings);
  double integral = 0.0;
  for (int k = 0; k < rings; ++k) {
    std::vector<Eigen::Vector2d> cell;
    for (const auto& [bed, depth] :
         {std::pair(k, 0.0), {k, surface.thickness}, {k + 1, surface.thickness}, {k + 1, 0.0}}) {
      const Vec3 p = web.at(bed, 0.0, depth);
      cell.emplace_back(p.x(), p.z());
    }
    const std::vector<Eigen::Vector2d> half = right_of_axis(cell);
    double area = 0.0, moment = 0.0;
    for (size_t i = 0; i < half.size(); ++i) {
      const Eigen::Vector2d &a = half[i], &b = half[(i + 1) % half.size()];
      const double twice = a.x() * b.y() - b.x() * a.y();
      area += twice / 2.0;
      moment += twice * (a.x() + b.x()) / 6.0;
    }
    integral += std::abs(area * 0.5 * surface.profile.span - moment);
  }
  return 2.0 * surface.plan.sides / std::tan(std::numbers::pi / surface.plan.sides) * integral;
}

TEST(GroinVault, VolumeIsTheClosedForm) {
  for (const int sides : {3, 4, 5, 8})
    for (const Kind profile : {Kind::semicircle, Kind::segmental, Kind::pointed, Kind::ellipse})
      for (const Groins groins : {Groins::bonded, Groins::alternate, Groins::mitred}) {
        const int rings = 14;  // even, for the pointed one
        const VaultSurface v = groin_over(sides, profile, groins);
        ModelReport report;
        check_and_report(case_of(v, RunningBond{rings, 6, 2}),
                         &report);  // throws where blocks overlap or gape
        const double expected = closed_form(v, rings);
        EXPECT_NEAR(report.volume, expected, 1e-12 * expected) << sides << " " << static_cast<int>(profile);
        EXPECT_EQ(report.islands, 1);
        EXPECT_EQ(report.num_supports, sides);
      }
}

/// Stones per course of webs of 5 courses in one stone each, over a square: 2, 2 and 1 course a web from the
/// supports to the crown.
std::map<int, int> stones_per_course(Groins groins) {
  const Assembly assembly = generate(case_of(groin_over(4, Kind::semicircle, groins), StackBond{5, 1, 2}));
  std::map<int, int> count;
  for (const Block& block : assembly.blocks) ++count[block.ring];
  return count;
}

TEST(GroinVault, StonesAcrossTheGroinsAreThoseCountedByHand) {
  using Count = std::map<int, int>;
  EXPECT_EQ(stones_per_course(Groins::mitred), (Count{{-1, 4}, {0, 8}, {1, 8}, {2, 4}}));
  EXPECT_EQ(stones_per_course(Groins::bonded), (Count{{-1, 4}, {0, 4}, {1, 4}, {2, 1}}));
  EXPECT_EQ(stones_per_course(Groins::alternate), (Count{{-1, 4}, {0, 4}, {1, 8}, {2, 1}}));
}

TEST(GroinVault, StonesAcrossAGroinHaveTwoArms) {
  const Assembly assembly = generate(case_of(groin_over(4), RunningBond{14, 6, 2}));
  int across = 0;
  for (const Block& block : assembly.blocks) across += block.rib ? 1 : 0;
  EXPECT_EQ(across, 4 * 7);  // one a course and groin
  ASSERT_EQ(assembly.sheets.size(), 1u);
  EXPECT_EQ(assembly.sheets[0].num_rings, 7);
}

/// Blocks of parts that are not all joined to the first by faces.
std::vector<int> blocks_apart(const Assembly& assembly) {
  std::vector<int> apart;
  for (size_t begin = 0, end = 0; begin < assembly.parts.size(); begin = end) {
    while (end < assembly.parts.size() && assembly.parts[end].block == assembly.parts[begin].block) ++end;
    std::vector<size_t> reached{begin};
    for (size_t i = 0; i < reached.size(); ++i)
      for (size_t p = begin; p < end; ++p)
        if (std::ranges::find(reached, p) == reached.end() &&
            shared_width(assembly, piece_of(assembly, assembly.parts[reached[i]]),
                         piece_of(assembly, assembly.parts[p]), 1e-11) > 0.0)  // wider than 1e-8 m
          reached.push_back(p);
    if (reached.size() < end - begin) apart.push_back(assembly.parts[begin].block);
  }
  return apart;
}

// The bonds are no mirror images about the groins. The largest faces there of two webs, which need not touch,
// were one stone, of pieces up to 0.37 m apart.
TEST(GroinVault, StonesAcrossTheGroinsTouch) {
  const DrawnBond drawn{.rings = 8, .rows = {"xbby", "aaxy"}, .letter_length = 0.3, .shift = 2};
  VaultSurface pentagon = groin_over(5);
  pentagon.thickness = 0.1;
  for (const Bond& bond : {Bond{drawn}, Bond{RunningBond{12, 6, 2}}}) {
    const Assembly assembly = generate(case_of(pentagon, bond));
    EXPECT_TRUE(blocks_apart(assembly).empty()) << bond.index();
    EXPECT_TRUE(std::ranges::any_of(assembly.blocks, &Block::rib));
  }
}

TEST(GroinVault, AffineImageHasTheVolumeTimesTheDeterminant) {
  Case scene = case_of(groin_over(4), RunningBond{13, 5, 2});
  ModelReport square, oblong;
  check_and_report(scene, &square);
  scene.geometry.affine = Affine{{1.0, 1.5, 0.8}, 0.1, 0.2};
  check_and_report(scene, &oblong);
  EXPECT_NEAR(oblong.volume, 1.2 * square.volume, 1e-12 * square.volume);
  EXPECT_EQ(oblong.num_blocks, square.num_blocks);
}

TEST(GroinVault, IsLaidInWythesAndDrawnBonds) {
  Case scene =
      case_of(groin_over(4), DrawnBond{.rings = 12, .rows = {"cddc", "aabb"}, .letter_length = 0.25});
  ModelReport report;
  check_and_report(scene, &report);
  EXPECT_EQ(report.islands, 1);
  const double whole = report.volume;
  scene.geometry.wythes = {{"inner", {{}, {0.1}}, RunningBond{12, 6, 2}, {}},
                           {"outer", {{}, {0.2}}, RunningBond{12, 6, 2}, {}}};
  const Assembly assembly = check_and_report(scene, &report);
  EXPECT_NEAR(report.volume, whole, 1e-12 * whole);
  EXPECT_EQ(assembly.vertex_layers.size(), assembly.vertices.size());
}

// The first beds lie where asked, and the supports behind them have the areas of these beds.
TEST(GroinVault, FirstBedsLieAtTheHeightAsked) {
  VaultSurface v = groin_over(4);
  v.plan.from_height = 2.0;
  const Assembly assembly = generate(case_of(v, RunningBond{10, 5, 2}));
  double lowest = 1e9, bearing = 0.0;
  for (const Part& part : assembly.parts) {
    const bool fixed = assembly.blocks[part.block].fixed;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      const std::vector<Vec3> points = face_points(assembly, f);
      if (fixed && assembly.face_kinds[f] == FaceKind::bed) bearing += polygon_area(points);
      if (!fixed)
        for (const Vec3& p : points) lowest = std::min(lowest, p.z());
    }
  }
  EXPECT_NEAR(lowest, 2.0, 1e-12);
  // At the intrados r = sqrt(5) the bed is 3 - r long, on the extrados 3 - 1.1 r; eight beds 0.3 m thick.
  EXPECT_NEAR(bearing, 8 * 0.3 * (3.0 - 1.05 * std::sqrt(5.0)), 1e-12);
}

/// On vertical stilts of 2 m, with beds from 1 m on.
VaultSurface stilted(VaultSurface::Line line) {
  VaultSurface v = groin_over(4, Kind::chain);
  v.profile.points = {{3.0, 3.0, 0.0}, {0.0, 2.0, 5.0}, {0.0, 3.0}, {}};
  v.plan.from_height = 1.0;
  v.line = line;
  return v;
}

// Both first beds of a web lie in one plane there. Each support was one block with that of the next corner,
// and springers, which need no wedge, had none.
TEST(GroinVault, LevelFirstBedsHaveTheirOwnSupports) {
  for (const int springers : {0, 2}) {
    VaultSurface v = stilted(VaultSurface::Line::middle);
    v.plan.springers = springers;
    const Assembly assembly = generate(case_of(v, RunningBond{13, 5, 2}));
    EXPECT_TRUE(blocks_apart(assembly).empty()) << springers;
    // Half of the thickness lies inside the side, and the groin halves what two webs share.
    EXPECT_NEAR(assembly.blocks.front().volume, 0.15 * 0.15, 1e-12) << "m3, support_width is 1 m";
  }
}

TEST(GroinVaultErrors, NameTheKey) {
  EXPECT_NE(refusal_of(case_of(stilted(VaultSurface::Line::intrados), RunningBond{13, 5, 2}))
                .find("from_height = 1: must be above 2 m, up to where a web has no length"),
            std::string::npos);
  VaultSurface v = groin_over(4);
  v.plan.from_height = 3.1;
  EXPECT_NE(refusal_of(case_of(v, RunningBond{13, 5, 2})).find("from_height = 3.1: must be below the crown"),
            std::string::npos);
  VaultSurface thick = groin_over(4);
  thick.thickness = 6.5;
  EXPECT_NE(refusal_of(case_of(thick, RunningBond{13, 5, 2})).find("give from_height"), std::string::npos);
  Case built = case_of(groin_over(4), RunningBond{13, 5, 2});
  built.geometry.stage = Stage{2};
  EXPECT_NE(refusal_of(built).find("not available for a groin vault"), std::string::npos);
  EXPECT_NE(refusal_of(case_of(groin_over(4, Kind::pointed), RunningBond{13, 5, 2})).find("must be even"),
            std::string::npos);
}

}  // namespace
}  // namespace cupola::groin_vault_test
