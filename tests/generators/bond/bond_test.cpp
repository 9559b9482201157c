#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "generators/bond/courses.hpp"
#include "generators/bond/fill.hpp"
#include "generators/bond/herringbone.hpp"
#include "generators/bond/make_bond.hpp"
#include "generators/generate.hpp"
#include "tests/generators/models.hpp"
#include "tests/test_names.hpp"

namespace cupola::bond_test {
namespace {

using std::numbers::pi;

BondGrid octagon_grid(int rings) {
  BondGrid grid{rings, true, 2 * pi, {}};
  for (int i = 0; i < 8; ++i) grid.corners.push_back(i * pi / 4);
  return grid;
}

/// Abscissae of the head joints of a ring, in [0, extent).
std::vector<double> joints_of_ring(const BondPattern& bond, int ring, double extent) {
  std::vector<double> joints;
  for (int s = 0; s < bond.num_slices(); ++s) {
    const int left = (s + bond.num_slices() - 1) % bond.num_slices();
    if (bond.at(ring, s) != bond.at(ring, left)) joints.push_back(std::fmod(bond.cuts[s], extent));
  }
  return joints;
}

/// Width of each block of a ring.
std::map<int, double> widths_in_ring(const BondPattern& bond, int ring) {
  std::map<int, double> widths;
  for (int s = 0; s < bond.num_slices(); ++s) widths[bond.at(ring, s)] += bond.cuts[s + 1] - bond.cuts[s];
  return widths;
}

double distance_to_corner(const BondGrid& grid, double joint) {
  double nearest = grid.extent;
  for (double corner : grid.corners)
    nearest = std::min(nearest, std::abs(std::remainder(joint - corner, grid.extent)));
  return nearest;
}

class OctagonBond : public testing::TestWithParam<Bond> {};

// With 32 blocks per ring a quarter of a block is 2.8 deg and a sixth 1.9 deg.
TEST_P(OctagonBond, HasNoJointOnACorner) {
  const BondGrid grid = octagon_grid(40);
  const BondPattern bond = make_bond(GetParam(), grid);
  const double width = 2 * pi / 32;
  for (int ring = 0; ring < 40; ++ring)
    for (double joint : joints_of_ring(bond, ring, grid.extent))
      EXPECT_GT(distance_to_corner(grid, joint), width / 6 - 1e-12) << "ring " << ring;
}

HerringboneBond left_herringbone() {
  HerringboneBond bond;
  bond.chirality = HerringboneBond::Chirality::left;
  return bond;
}

INSTANTIATE_TEST_SUITE_P(Bonds, OctagonBond,
                         testing::Values(RunningBond{}, StackBond{}, HerringboneBond{}, left_herringbone(),
                                         FillBond{}),
                         test_names({"running", "stack", "herringbone", "left_herringbone", "fill"}));

TEST(RunningBond, OverlapsByHalfABlockAndKeepsAQuarterFromCorners) {
  const BondGrid grid = octagon_grid(2);
  const BondPattern bond = running_bond(RunningBond{2, 32, 4}, grid);
  const double width = 2 * pi / 32;
  const auto even = joints_of_ring(bond, 0, grid.extent), odd = joints_of_ring(bond, 1, grid.extent);
  ASSERT_EQ(even.size(), 32u);
  ASSERT_EQ(odd.size(), 32u);
  for (double joint : even) {
    double nearest = width;
    for (double other : odd) nearest = std::min(nearest, std::abs(std::remainder(joint - other, 2 * pi)));
    EXPECT_NEAR(nearest, width / 2, 1e-12);
    EXPECT_GT(distance_to_corner(grid, joint), width / 4 - 1e-12);
  }
}

// A window may be one block wide: its courses are whole, or two halves.
TEST(RunningBond, BreaksJointsInAWindowOfOneBlock) {
  BondGrid grid{2, false, 1.0, {}};
  grid.window = true;
  const BondPattern bond = make_bond(RunningBond{2, 1, 2}, grid);
  EXPECT_EQ(bond.block_of, (std::vector<int>{0, 0, 1, 2}));
}

// Each ring has three verticals of width w/3 per spiral. All other blocks are whole; there are no slivers.
TEST(Herringbone, HasThreeVerticalsPerSpiralInEveryRing) {
  const BondGrid grid{40, true, 2 * pi, {}};
  const BondPattern bond = herringbone_bond(HerringboneBond{}, grid);
  EXPECT_EQ(bond.blocks.size(), 1296u);
  const double width = 2 * pi / 32;
  for (int ring = 0; ring < 40; ++ring) {
    std::map<int, double> spiral_width;
    int whole = 0;
    for (const auto& [block, w] : widths_in_ring(bond, ring)) {
      if (bond.blocks[block].kind == BlockKind::herringbone) {
        EXPECT_NEAR(w, width / 3, 1e-12);
        spiral_width[bond.blocks[block].spiral] += w;
      } else {
        EXPECT_NEAR(w, width, 1e-12);
        ++whole;
      }
    }
    EXPECT_EQ(whole, 24);
    ASSERT_EQ(spiral_width.size(), 8u);
    for (const auto& [spiral, w] : spiral_width) EXPECT_NEAR(w, width, 1e-12);
  }
}

// The joints between flat blocks lie on meridians one block width apart; in half bond every other ring is
// shifted by half a block. Blocks cut by the spirals are at least half a block wide.
TEST(Herringbone, PutsJointsOfFlatBlocksInHalfBondOrOnMeridians) {
  const double width = 2 * pi / 32;
  for (const auto beside : {HerringboneBond::Beside::half, HerringboneBond::Beside::aligned}) {
    HerringboneBond spec;
    spec.beside = beside;
    spec.slices_per_vertical = 2;
    const BondPattern bond = herringbone_bond(spec, BondGrid{40, true, 2 * pi, {}});
    for (int ring = 0; ring < 40; ++ring) {
      const bool shifted = beside == HerringboneBond::Beside::half && ring % 2 != 0;
      for (int s = 0; s < bond.num_slices(); ++s) {
        const int left = bond.at(ring, (s + bond.num_slices() - 1) % bond.num_slices());
        const int right = bond.at(ring, s);
        if (left == right || bond.blocks[left].kind == BlockKind::herringbone ||
            bond.blocks[right].kind == BlockKind::herringbone)
          continue;
        EXPECT_NEAR(std::remainder(bond.cuts[s] - (shifted ? width / 2 : 0.0), width), 0.0, 1e-9)
            << "ring " << ring;
      }
      for (const auto& [block, w] : widths_in_ring(bond, ring)) {
        if (bond.blocks[block].kind == BlockKind::herringbone) continue;
        EXPECT_GT(w, width / 2 - 1e-9);
        EXPECT_LT(w, 2 * width - 1e-9);
      }
    }
  }
}

TEST(Herringbone, KeepsAndMarksTruncatedVerticals) {
  const BondPattern bond = herringbone_bond(HerringboneBond{}, BondGrid{40, true, 2 * pi, {}});
  int verticals = 0, truncated = 0;
  for (const BondBlock& block : bond.blocks) {
    verticals += block.kind == BlockKind::herringbone ? 1 : 0;
    truncated += block.truncated ? 1 : 0;
  }
  EXPECT_EQ(verticals, 8 * 42);
  EXPECT_EQ(truncated, 32);  // two at the base and two at the crown of each spiral
}

// A spiral advances by w/3 = 3.75 deg per ring, i.e. 150 deg in 40 rings, counter-clockwise if right-handed.
TEST(Herringbone, TurnsSpiralsBy150DegreesInTheDirectionOfTheirChirality) {
  Case c;
  c.geometry.bond = HerringboneBond{};
  const Assembly right = cut_assembly(c);
  c.geometry.bond = left_herringbone();
  const Assembly left = cut_assembly(c);
  const auto azimuths = [](const Assembly& a) {
    std::vector<double> of_ring(40, 0.0);
    for (const Block& b : a.blocks)
      if (b.spiral == 0 && !b.truncated) of_ring[b.ring] = std::atan2(b.centroid.y(), b.centroid.x());
    return of_ring;
  };
  const auto r = azimuths(right), l = azimuths(left);
  for (int ring = 1; ring < 38; ++ring) {
    EXPECT_NEAR(std::remainder(r[ring] - r[ring - 1], 2 * pi), 3.75 * pi / 180, 1e-12);
    EXPECT_NEAR(std::remainder(l[ring] - l[ring - 1], 2 * pi), -3.75 * pi / 180, 1e-12);
  }
  double right_volume = 0.0, left_volume = 0.0;
  for (const Block& b : right.blocks) right_volume += b.volume;
  for (const Block& b : left.blocks) left_volume += b.volume;
  EXPECT_NEAR(left_volume, right_volume, 1e-12 * right_volume);
}

TEST(Herringbone, KeepsMeridianStripsAtConstantAzimuth) {
  HerringboneBond strip;
  strip.path = HerringboneBond::Path::meridian;
  strip.spirals = 4;
  const BondPattern bond = herringbone_bond(strip, BondGrid{40, true, 2 * pi, {}});
  const double width = 2 * pi / 32;
  for (int ring = 0; ring < 40; ++ring)
    for (int s = 0; s < bond.num_slices(); ++s) {
      const double from_strip = std::fmod(bond.cuts[s] + 1e-9, 2 * pi / 4);
      const bool vertical = bond.blocks[bond.at(ring, s)].kind == BlockKind::herringbone;
      EXPECT_EQ(vertical, from_strip < width - 1e-6) << "ring " << ring << " slice " << s;
    }
}

TEST(Herringbone, FillsTheRingsForOtherNumbersOfSpiralsAndVerticals) {
  for (int spirals : {1, 3, 5, 7})
    for (int verticals : {2, 3, 4})
      for (int height : {2, 3, 5}) {
        HerringboneBond bond;
        bond.spirals = spirals;
        bond.verticals_per_block = verticals;
        bond.rings_per_vertical = height;
        const BondPattern pattern = herringbone_bond(bond, BondGrid{20, true, 2 * pi, {}});
        const double width = 2 * pi / 32;
        for (int ring = 0; ring < 20; ++ring)
          for (const auto& [block, w] : widths_in_ring(pattern, ring)) {
            ASSERT_GE(block, 0);
            if (pattern.blocks[block].kind == BlockKind::herringbone) continue;
            EXPECT_GT(w, width / 2 - 1e-9) << spirals << " " << verticals << " " << height;
            EXPECT_LT(w, 1.5 * width + 1e-9);
          }
      }
}

TEST(Herringbone, RejectsSpiralsThatDoNotFit) {
  HerringboneBond bond;
  bond.spirals = 33;
  EXPECT_THROW(herringbone_bond(bond, BondGrid{4, true, 2 * pi, {}}), InputError);
}

// 32 x 24 x 2.4 m, blocks of 4 x 2.4 x 1 m, verticals of 4/3 x 3 m along the diagonal: 24 verticals, 171 flat
// blocks.
TEST(WallHerringbone, HasTheExpectedBlocksAndOneDiagonal) {
  Case c;
  c.geometry.surface = WallSurface{32.0, 24.0, 2.4};
  HerringboneBond bond;
  bond.rings = 24;
  bond.blocks_per_ring = 8;
  bond.spirals = 1;
  c.geometry.bond = bond;
  ModelReport report;
  const Assembly wall = check_and_report(c, &report);
  EXPECT_EQ(report.num_blocks, 195);
  EXPECT_EQ(report.num_parts, 195);
  EXPECT_NEAR(report.volume, 32 * 24 * 2.4, 1e-11 * 32 * 24 * 2.4);
  EXPECT_NEAR(report.smallest_block, 4.0 / 3 * 2.4, 1e-12);  // a vertical truncated to one ring
  EXPECT_EQ(report.islands, 1);
  for (const Block& b : wall.blocks) {
    if (b.kind != BlockKind::herringbone) continue;
    EXPECT_NEAR(b.centroid.x(), (b.ring + 0.5) * 4.0 / 3, 1e-12);
    if (!b.truncated) {
      EXPECT_NEAR(b.centroid.z(), b.ring + 1.5, 1e-12);
    }
  }
}

TEST(FillBond, KeepsWidthsWithinBoundsAndJointsApart) {
  const BondGrid grid = octagon_grid(40);
  const BondPattern bond = fill_bond(FillBond{}, grid);
  const double width = 2 * pi / 32;
  std::set<int> distinct_widths;
  for (int ring = 0; ring < 40; ++ring) {
    for (const auto& [block, w] : widths_in_ring(bond, ring)) {
      EXPECT_GE(w, 0.75 * width - 1e-9);
      EXPECT_LE(w, 1.25 * width + 1e-9);
      distinct_widths.insert(static_cast<int>(std::lround(8 * w / width)));
    }
    for (double joint : joints_of_ring(bond, ring, 2 * pi))
      EXPECT_GT(distance_to_corner(grid, joint), width / 4 - 1e-9);
    if (ring == 0) continue;
    for (double joint : joints_of_ring(bond, ring, 2 * pi))
      for (double below : joints_of_ring(bond, ring - 1, 2 * pi))
        EXPECT_GT(std::abs(std::remainder(joint - below, 2 * pi)), width / 8 - 1e-9);
  }
  EXPECT_FALSE(distinct_widths.empty());
}

TEST(FillBond, StaggersTheJointsOfAWall) {
  const BondPattern bond = fill_bond(FillBond{10, 6, 8, 0.5, 1.25}, BondGrid{10, false, 12.0, {}});
  for (int ring = 0; ring < 10; ++ring)
    for (const auto& [block, w] : widths_in_ring(bond, ring)) {
      EXPECT_GE(w, 1.0 - 1e-9);
      EXPECT_LE(w, 2.5 + 1e-9);
    }
  for (int ring = 1; ring < 10; ++ring) {
    const auto above = joints_of_ring(bond, ring, 12.0), below = joints_of_ring(bond, ring - 1, 12.0);
    for (double a : above)
      for (double b : below)
        if (a > 0.0 && b > 0.0) {
          EXPECT_GE(std::abs(a - b), 0.5 - 1e-9);
        }
  }
}

// Blocks of 1/5 turn cannot keep 1/20 turn away from corners at every 1/8 turn.
TEST(FillBond, ThrowsIfNoFillExists) {
  EXPECT_THROW(fill_bond(FillBond{2, 5, 4, 1.0, 1.0}, octagon_grid(2)), InputError);
}

TEST(StackBond, AlignsHeadJoints) {
  Case c;
  c.geometry.surface = WallSurface{};
  c.geometry.bond = StackBond{4, 2, 2, {}};
  ModelReport report;
  check_and_report(c, &report);
  EXPECT_EQ(report.num_blocks, 8);
  EXPECT_EQ(report.num_joints, 8 + 4);  // one bed under each block, one head per course
}

}  // namespace
}  // namespace cupola::bond_test
