// Chains by level: where their bars end, in which blocks, and how stiff they are.

#include "generators/chains.hpp"

#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "tests/generators/models.hpp"

namespace cupola::chains_test {
namespace {

using std::numbers::pi;

constexpr double kRounding = 1e-12;  // m, of coordinates of 50 m

/// Hemisphere of 5 m inner radius, 1 m thick, six courses of twelve blocks up to 60 degrees.
Case hemisphere(const Chain& chain) {
  Case c;
  DomeSurface dome;
  dome.span = 10.0;
  dome.radius_ratio = 0.5;
  dome.thickness = 1.0;
  c.geometry.surface = dome;
  c.geometry.bond = StackBond{6, 12, 4};
  c.geometry.chains = {chain};
  return c;
}

Case octagon(const Chain& chain) {
  Case c;
  c.geometry.surface = OctagonalVault{};
  c.geometry.bond = RunningBond{};
  c.geometry.chains = {chain};
  return c;
}

double azimuth(const Vec3& p) {
  return std::atan2(p.y(), p.x());
}

/// m, negative inside: the largest distance of a point from the faces of the nearest part of a block.
double distance_outside(const Assembly& assembly, int block, const Vec3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const Part& part : assembly.parts) {
    if (part.block != block) continue;
    double largest = -std::numeric_limits<double>::infinity();
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      const Plane plane = polygon_plane(face_points(assembly, f));
      largest = std::max(largest, plane.normal.dot(point) - plane.offset);
    }
    least = std::min(least, largest);
  }
  return least;
}

TEST(Chain, LinksTheMiddlesOfTheBlocksOfACourse) {
  Chain chain;
  chain.course = 2;
  chain.place = 0.25;
  chain.axial_stiffness = 3e8;
  chain.yield_force = 2e6;
  const Assembly assembly = generate(hemisphere(chain));
  ASSERT_EQ(assembly.ties.size(), 12u);
  ASSERT_EQ(assembly.chains.size(), 1u);
  const double t = 2.5 / 6.0 * pi / 3.0, r = 5.25, rho = r * std::cos(t), L = 2.0 * rho * std::sin(pi / 12.0);
  EXPECT_NEAR(assembly.chains[0].height, r * std::sin(t), kRounding);
  for (size_t i = 0; i < 12; ++i) {
    const BuiltTie& tie = assembly.ties[i];
    EXPECT_NEAR(tie.point_a.head<2>().norm(), rho, kRounding);
    EXPECT_NEAR(tie.point_a.z(), r * std::sin(t), kRounding);
    EXPECT_NEAR(std::remainder(azimuth(tie.point_a) - (i + 0.5) * pi / 6.0, 2.0 * pi), 0.0, 1e-13);
    EXPECT_LT((tie.point_b - assembly.ties[(i + 1) % 12].point_a).norm(), kRounding);
    EXPECT_EQ(tie.block_b, assembly.ties[(i + 1) % 12].block_a);
    EXPECT_EQ(assembly.blocks[tie.block_a].ring, 2);
    EXPECT_LT(distance_outside(assembly, tie.block_a, tie.point_a), 0.0);
    EXPECT_NEAR(tie.length, L, kRounding);
    EXPECT_NEAR(tie.stiffness, 3e8 / L, 3e8 / L * 1e-12);
    EXPECT_EQ(tie.yield_force, 2e6);
    EXPECT_EQ(tie.chain, 0);
  }
}

TEST(Chain, OfAHeightIsLevelAndHasItsCornersAtThoseOfTheVault) {
  Chain chain;
  chain.height = 7.7;
  chain.links = 24;
  const Assembly assembly = generate(octagon(chain));
  ASSERT_EQ(assembly.ties.size(), 24u);
  int corners = 0;
  for (const BuiltTie& tie : assembly.ties) {
    EXPECT_NEAR(tie.point_a.z(), 7.7, 1e-9);
    // At a corner an anchor lies between the two parts of its block.
    EXPECT_LT(distance_outside(assembly, tie.block_a, tie.point_a), 1e-9);
    EXPECT_LT(distance_outside(assembly, tie.block_b, tie.point_b), 1e-9);
    EXPECT_NEAR(std::remainder(azimuth(tie.point_a), pi / 12.0), 0.0, 1e-12);
    corners += std::abs(std::remainder(azimuth(tie.point_a), pi / 4.0)) < 1e-9 ? 1 : 0;
  }
  EXPECT_EQ(corners, 8);
  EXPECT_NEAR(assembly.chains[0].height, 7.7, 1e-9);
}

// On plane beds abscissae are shares of the sides, and an affine map moves azimuths: 18.43 and 26.57 degrees
// in place of 30.
TEST(Chain, IsEqualInAzimuthOnPlaneBedsAndAfterAnAffineMap) {
  Chain chain;
  chain.course = 2;
  chain.links = 12;
  for (const double scale : {1.0, 1.5}) {
    Case c = octagon(chain);
    auto& vault = std::get<OctagonalVault>(c.geometry.surface);
    vault.sails = 4;
    vault.construction = OctagonalVault::Construction::planar_radial;
    if (scale != 1.0) c.geometry.affine = Affine{.scale = {scale, 1.0, 1.0}};
    const Assembly assembly = generate(c);
    ASSERT_EQ(assembly.ties.size(), 12u);
    for (int i = 0; i < 12; ++i)
      EXPECT_NEAR(std::remainder(azimuth(assembly.ties[i].point_a) - i * pi / 6.0, 2.0 * pi), 0.0, 1e-12)
          << scale << " " << i;
  }
}

TEST(Chain, SlackLengthensAndPrestressShortensItsBars) {
  Chain chain;
  chain.course = 0;
  const double L = generate(hemisphere(chain)).ties[0].length;
  chain.slack = 0.01;
  EXPECT_NEAR(generate(hemisphere(chain)).ties[0].length, L + 0.01, kRounding);
  chain.slack = 0.0;
  chain.prestress = 1e6;
  chain.axial_stiffness = 5e8;
  EXPECT_NEAR(generate(hemisphere(chain)).ties[0].length, L - 1e6 * L / 5e8, kRounding);
}

TEST(Clamps, CrossTheHeadJointsOfTheirCourse) {
  Chain chain;
  chain.type = Chain::Type::clamps;
  chain.course = 3;
  chain.clamp_length = 0.4;
  const Assembly assembly = generate(octagon(chain));
  ASSERT_EQ(assembly.ties.size(), 32u);
  std::set<std::pair<int, int>> pairs;
  for (const BuiltTie& tie : assembly.ties) {
    pairs.insert(std::minmax(tie.block_a, tie.block_b));
    EXPECT_EQ(assembly.blocks[tie.block_a].ring, 3);
    EXPECT_EQ(assembly.blocks[tie.block_b].ring, 3);
    // Half on each side; the curvature of the course in plan shortens the chord by less than a thousandth.
    EXPECT_NEAR((tie.point_b - tie.point_a).norm(), 0.4, 4e-4);
    // From the radial plane of the joint, to which the wall is inclined by up to 22.5 degrees.
    for (const double depth : {-distance_outside(assembly, tie.block_a, tie.point_a),
                               -distance_outside(assembly, tie.block_b, tie.point_b)}) {
      EXPECT_LT(depth, 0.2 + 1e-6);
      EXPECT_GT(depth, 0.2 * std::cos(pi / 8.0) - 1e-6);
    }
  }
  EXPECT_EQ(pairs.size(), 32u);
}

// A course of 16 long blocks among courses of 32: two in each sail meet at mid-sail, and eight turn the
// corners.
TEST(LongBlocks, ReplaceTheBondInTheirCourse) {
  Chain chain;
  chain.type = Chain::Type::clamps;
  chain.course = 5;
  chain.long_blocks = 16;
  ModelReport report, plain;
  const Assembly assembly = check_and_report(octagon(chain), &report);
  Case without = octagon(chain);
  without.geometry.chains.clear();
  check_and_report(without, &plain);
  int in_course = 0, corners = 0;
  for (const Block& block : assembly.blocks) {
    in_course += block.ring == 5 ? 1 : 0;
    corners += block.ring == 5 && block.rib ? 1 : 0;
  }
  EXPECT_EQ(in_course, 16);
  EXPECT_EQ(corners, 8);
  EXPECT_EQ(assembly.ties.size(), 16u);
  EXPECT_EQ(report.num_blocks, plain.num_blocks - 16);
  EXPECT_NEAR(report.volume / plain.volume, 1.0, 1e-13);
  EXPECT_LT(report.max_overlap, 1e-9);
  EXPECT_EQ(report.islands, 1);
}

TEST(Chain, OfACourseAboveTheStageIsLeftOut) {
  Chain chain;
  chain.course = 4;
  Case c = hemisphere(chain);
  c.geometry.stage = Stage{4};
  EXPECT_TRUE(generate(c).ties.empty());
  c.geometry.stage = Stage{5};
  EXPECT_EQ(generate(c).ties.size(), 12u);
}

void expect_refused(const Case& c, const char* phrase) {
  try {
    generate(c);
    FAIL() << "accepted: " << phrase;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(phrase), std::string::npos) << error.what();
  }
}

/// A semicircular barrel of 8 m, 1 m thick and 4 m long, in courses of four blocks.
Case barrel(const Chain& chain) {
  Case c;
  VaultSurface surface;
  surface.plan.kind = Plan::Kind::line;
  surface.plan.length = 4.0;
  surface.profile.span = 8.0;
  c.geometry.surface = surface;
  c.geometry.bond = StackBond{15, 4, 1};
  c.geometry.chains = {chain};
  return c;
}

TEST(Rods, CrossABarrelAtTheirHeight) {
  Chain chain;
  chain.type = Chain::Type::rods;
  chain.height = 1.5;
  chain.place = 0.25;
  chain.at = {0.5, 2.7};
  chain.axial_stiffness = 2e8;
  const Assembly assembly = generate(barrel(chain));
  ASSERT_EQ(assembly.ties.size(), 2u);
  // 5 m is the outer radius. The stones are polygons; the points of one bed lie on a straight line, in the
  // middle of a course up to 0.02 m inside the circle of 4.25 m: 4.25 (1 - cos(pi / 30)).
  const double x = std::sqrt(4.25 * 4.25 - 1.5 * 1.5);
  for (size_t i = 0; i < 2; ++i) {
    const BuiltTie& tie = assembly.ties[i];
    EXPECT_NEAR(tie.point_a.x(), x, 0.03);
    EXPECT_NEAR(tie.point_b.x(), -tie.point_a.x(), kRounding);
    for (const Vec3& end : {tie.point_a, tie.point_b}) {
      EXPECT_NEAR(end.y(), chain.at[i], kRounding);
      EXPECT_NEAR(end.z(), 1.5, kRounding);
    }
    EXPECT_NE(tie.block_a, tie.block_b);
    EXPECT_LT(distance_outside(assembly, tie.block_a, tie.point_a), 0.0);
    EXPECT_LT(distance_outside(assembly, tie.block_b, tie.point_b), 0.0);
    EXPECT_NEAR(tie.stiffness * tie.length, 2e8, 1.0);
  }
}

TEST(Rods, LieInTheMemberThatTheyName) {
  Chain chain;
  chain.type = Chain::Type::rods;
  chain.height = 1.5;
  const Case alone = barrel(chain);
  Case both = alone;
  Member first = alone.geometry, second = alone.geometry;
  first.name = "first";
  first.at = Place{{100.0, 0.0, 2.0}, 0.0};
  first.copies = Copies{.count = 2, .by = Vec3(0.0, 50.0, 0.0)};
  both.geometry.members = {first};
  both.geometry.chains[0].member = "first 2";
  const Assembly here = generate(alone), there = generate(both);
  ASSERT_EQ(there.ties.size(), 1u);
  EXPECT_LT((there.ties[0].point_a - here.ties[0].point_a - Vec3(100.0, 50.0, 2.0)).norm(), kRounding);
  EXPECT_EQ(there.blocks[there.ties[0].block_a].member, 1) << "of first and first 2, which lay the courses";
}

TEST(Chain, LiesOnTheExtradosAtPlaceOne) {
  Chain chain;
  chain.height = 2.0;
  chain.place = 1.0;
  const Assembly assembly = generate(hemisphere(chain));
  ASSERT_EQ(assembly.ties.size(), 12u);
  for (const BuiltTie& tie : assembly.ties) EXPECT_NEAR(tie.point_a.norm(), 6.0, kRounding);
}

TEST(Chain, RefusesWhatDoesNotFitTheMasonry) {
  Chain rod;
  rod.type = Chain::Type::rods;
  rod.height = 6.0;
  expect_refused(barrel(rod), "geometry.chains[0].height = 6: must lie between 0 and ");
  rod.height = 1.5;
  rod.at = {5.0};
  expect_refused(barrel(rod), "geometry.chains[0].at = 5: the barrel is 4 m long");
  Chain high;
  high.height = 40.0;
  expect_refused(octagon(high), "geometry.chains[0].height = 40: must lie between 0 and ");
  Chain fine;
  fine.height = 5.0;
  fine.links = 1000;
  expect_refused(octagon(fine), "give fewer links");
  Chain clamped;
  clamped.type = Chain::Type::clamps;
  clamped.course = 3;
  clamped.clamp_length = 20.0;
  expect_refused(octagon(clamped), "clamp_length = 20: half of it must be below the length of a block");
  clamped.clamp_length = 0.3;
  clamped.long_blocks = 500;
  expect_refused(octagon(clamped), "long_blocks = 500: the bond has only ");
  clamped.long_blocks = 16;
  Case uprights = octagon(clamped);
  uprights.geometry.bond = HerringboneBond{};
  expect_refused(uprights, "uprights stand in the course");
}

}  // namespace
}  // namespace cupola::chains_test
