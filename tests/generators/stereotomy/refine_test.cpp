// Refinement divides each course into n courses and each block into n blocks by the same rule, for every
// surface and bond.

#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "generators/bond/make_bond.hpp"
#include "generators/generate.hpp"
#include "generators/stereotomy/shell.hpp"
#include "tests/generators/models.hpp"

namespace cupola::refine_test {
namespace {

using std::numbers::pi;

template <class SomeBond>
Case case_of(const Surface& surface, SomeBond bond, int refine) {
  Case c;
  bond.refine = refine;
  c.geometry.surface = surface;
  c.geometry.bond = bond;
  return c;
}

OctagonalVault vault(OctagonalVault::Construction construction) {
  OctagonalVault v;
  v.construction = construction;
  return v;
}

HerringboneBond herringbone(int rings, int blocks_per_ring, int spirals) {
  HerringboneBond bond;
  bond.rings = rings;
  bond.blocks_per_ring = blocks_per_ring;
  bond.spirals = spirals;
  return bond;
}

struct Model {
  const char* name;
  Surface surface;
  Bond bond;
  int (*blocks)(int n);  // expected number of blocks for refinement n
};

void PrintTo(const Model& model, std::ostream* out) {
  *out << model.name;
}

class Refined : public testing::TestWithParam<std::tuple<Model, int>> {};

// With K rings of B blocks and S spirals of verticals V rings high, there are K n (B n - S n) whole blocks
// and S n (K n + V - 1) verticals.
TEST_P(Refined, HasTheExpectedBlocksFillsTheShellAndPassesTheChecks) {
  const auto& [model, n] = GetParam();
  Case c;
  c.geometry.surface = model.surface;
  c.geometry.bond = std::visit(
      [n = n](auto bond) -> Bond {
        bond.refine = n;
        return bond;
      },
      model.bond);
  GenerateReport report;
  const Assembly assembly = generate(c, &report);
  EXPECT_EQ(report.model.num_blocks, model.blocks(n));
  EXPECT_EQ(report.model.islands, 1);
  EXPECT_LT(report.model.max_overlap, 1e-9);
  EXPECT_NEAR(report.model.parts_volume, report.model.volume, 1e-12 * report.model.volume);
  // Chords over an angle a reduce the volume by a^2 / 6: 2.03e-2 for the 20 deg of nine voussoirs, less for
  // the other models, whose facets span at most 7.5 and 5.6 deg in the two directions.
  EXPECT_NEAR(report.model.volume, *report.model.shell_volume, 2.1e-2 / (n * n) * *report.model.shell_volume);
  EXPECT_EQ(assembly.num_rings, rings_of(c.geometry.bond));
}

const HerringboneBond kSmall = herringbone(8, 16, 4);

INSTANTIATE_TEST_SUITE_P(
    Models, Refined,
    testing::Combine(
        testing::Values(
            Model{"dome_running", DomeSurface{}, RunningBond{8, 16, 4}, [](int n) { return 128 * n * n; }},
            Model{"dome_stack", DomeSurface{}, StackBond{8, 16, 4}, [](int n) { return 128 * n * n; }},
            Model{"dome_herringbone", DomeSurface{}, kSmall,
                  [](int n) { return 8 * n * 12 * n + 4 * n * (8 * n + 2); }},
            Model{"octagon_circular", vault(OctagonalVault::Construction::circular), RunningBond{8, 32, 4},
                  [](int n) { return 256 * n * n; }},
            Model{"octagon_planar", vault(OctagonalVault::Construction::planar_radial), RunningBond{8, 32, 4},
                  [](int n) { return 256 * n * n; }},
            Model{"octagon_level", vault(OctagonalVault::Construction::planar_horizontal),
                  RunningBond{8, 32, 4}, [](int n) { return 256 * n * n; }},
            Model{"brunelleschi", vault(OctagonalVault::Construction::circular), herringbone(8, 32, 8),
                  [](int n) { return 8 * n * 24 * n + 8 * n * (8 * n + 2); }},
            Model{"wall", WallSurface{}, RunningBond{4, 2, 2}, [](int n) { return 4 * n * 2 * n + 2 * n; }},
            Model{"arch", ArchSurface{}, StackBond{9, 1, 1}, [](int n) { return 9 * n * n; }}),
        testing::Values(1, 2, 3)),
    [](const auto& test) {
      return fmt::format("{}_{}", std::get<0>(test.param).name, std::get<1>(test.param));
    });

/// Smallest distance of a head joint from a corner, over the width of a refined block.
double nearest_joint_to_a_corner(const Bond& bond) {
  Geometry geometry;
  geometry.surface = vault(OctagonalVault::Construction::circular);
  geometry.bond = bond;
  const auto shell = make_storeys(geometry).back();
  const SurfaceMap& surface = shell.surface;
  const BondPattern& pattern = shell.bond;
  double nearest = surface.extent;
  for (int ring = 0; ring < pattern.num_rings; ++ring)
    for (int s = 0; s < pattern.num_slices(); ++s) {
      const int left = (s + pattern.num_slices() - 1) % pattern.num_slices();
      if (pattern.at(ring, s) == pattern.at(ring, left)) continue;
      for (double corner : surface.corners)
        nearest = std::min(nearest, std::abs(std::remainder(pattern.cuts[s] - corner, surface.extent)));
    }
  return nearest / (2.0 * pi / 32 / refinement_of(bond));
}

TEST(Refinement, KeepsJointsOffTheCorners) {
  for (int n = 1; n <= 6; ++n) {
    RunningBond running{8, 32, 4};
    running.refine = n;
    EXPECT_NEAR(nearest_joint_to_a_corner(running), 0.25, 1e-9) << n;
    HerringboneBond spirals = herringbone(8, 32, 8);
    spirals.refine = n;
    EXPECT_NEAR(nearest_joint_to_a_corner(spirals), 1.0 / 6, 1e-9) << n;
  }
}

// In the first course of each unrefined ring a band of upright blocks begins and ends at the same azimuths as
// without refinement, and its width is the same in every course.
TEST(Refinement, KeepsTheBandsOfUprightBlocksInPlace) {
  const auto bands = [](int n) {
    HerringboneBond bond = herringbone(8, 16, 4);
    bond.refine = n;
    Geometry geometry;
    geometry.bond = bond;
    const BondPattern pattern = make_storeys(geometry).back().bond;
    std::map<int, std::vector<double>> edges;  // per unrefined ring: where bands begin and end
    for (int ring = 0; ring < pattern.num_rings; ++ring) {
      const auto upright = [&](int s) {
        return pattern.blocks[pattern.at(ring, s)].kind == BlockKind::herringbone;
      };
      double width = 0.0;
      for (int s = 0; s < pattern.num_slices(); ++s) {
        width += upright(s) ? pattern.cuts[s + 1] - pattern.cuts[s] : 0.0;
        const int left = (s + pattern.num_slices() - 1) % pattern.num_slices();
        if (ring % n == 0 && upright(s) != upright(left)) edges[ring / n].push_back(pattern.cuts[s]);
      }
      EXPECT_NEAR(width, 4 * 2 * pi / 16, 1e-12);
    }
    return edges;
  };
  const auto coarse = bands(1), fine = bands(3);
  ASSERT_EQ(coarse.size(), fine.size());
  for (const auto& [ring, edges] : coarse) {
    ASSERT_EQ(edges.size(), fine.at(ring).size());
    for (size_t i = 0; i < edges.size(); ++i) EXPECT_NEAR(edges[i], fine.at(ring)[i], 1e-12);
  }
}

// A stage of three rings is the same part of the shell for every refinement, up to its facets.
TEST(Refinement, CountsStagesInUnrefinedRings) {
  const auto volume = [](int n) {
    Case c = case_of(DomeSurface{}, RunningBond{8, 16, 4}, n);
    c.geometry.stage = Stage{3};
    ModelReport report;
    check_and_report(c, &report);
    EXPECT_EQ(report.num_blocks, 3 * 16 * n * n);
    return report.volume;
  };
  EXPECT_NEAR(volume(4), volume(2), 5e-3 * volume(2));
}

TEST(Refinement, KeepsTheBlockWidthsOfAFill) {
  const Case c = case_of(vault(OctagonalVault::Construction::circular), FillBond{4, 32, 8}, 2);
  ModelReport report;
  check_and_report(c, &report);
  EXPECT_GE(report.num_blocks, 8 * 64 * 4 / 5);
  EXPECT_LE(report.num_blocks, 8 * 64 * 4 / 3);
}

}  // namespace
}  // namespace cupola::refine_test
