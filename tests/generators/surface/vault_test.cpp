#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "generators/generate.hpp"
#include "generators/surface/make_surface.hpp"
#include "tests/generators/models.hpp"
#include "tests/generators/section.hpp"
#include "tests/test_names.hpp"

namespace cupola::vault_test {
namespace {

using Construction = OctagonalVault::Construction;
using Extrados = OctagonalVault::Extrados;

Case vault_case(Construction construction, Extrados extrados, const Bond& bond) {
  Case c;
  OctagonalVault vault;
  vault.construction = construction;
  vault.extrados = extrados;
  c.geometry.surface = vault;
  c.geometry.bond = bond;
  return c;
}

class VaultShell : public testing::TestWithParam<std::pair<Construction, Extrados>> {};

// The volumes themselves are rows of the verification manual.
TEST_P(VaultShell, FacetsReduceItsVolumeLittle) {
  ModelReport report;
  check_and_report(vault_case(GetParam().first, GetParam().second, RunningBond{}), &report);
  EXPECT_EQ(report.num_blocks, 1280);
  EXPECT_NEAR(report.parts_volume, report.volume, 1e-12 * report.volume);
  EXPECT_NEAR(report.volume / *report.shell_volume, 1.0, 3e-4);  // 40 rings: 1e-4 or 2e-4
}

INSTANTIATE_TEST_SUITE_P(Rules, VaultShell,
                         testing::Values(std::pair(Construction::circular, Extrados::normal),
                                         std::pair(Construction::circular, Extrados::corner),
                                         std::pair(Construction::circular, Extrados::midsail),
                                         std::pair(Construction::planar_radial, Extrados::normal),
                                         std::pair(Construction::planar_radial, Extrados::corner),
                                         std::pair(Construction::planar_horizontal, Extrados::normal),
                                         std::pair(Construction::planar_horizontal, Extrados::corner),
                                         std::pair(Construction::planar_horizontal, Extrados::bed)),
                         [](const auto& param_info) {
                           return fmt::format("{}_{}", to_string(param_info.param.first),
                                              to_string(param_info.param.second));
                         });

struct VaultCount {
  Surface surface;
  Bond bond;
  int blocks, cells;
  double smallest, largest;  // m3
  int bed_quads, head_quads, base_quads;
};

OctagonalVault vault_of(Construction construction) {
  OctagonalVault vault;
  vault.construction = construction;
  return vault;
}

class PaperModel : public testing::TestWithParam<VaultCount> {};

TEST_P(PaperModel, HasTheExpectedCountsAndPassesTheChecks) {
  const VaultCount& expected = GetParam();
  Case c;
  c.geometry.surface = expected.surface;
  c.geometry.bond = expected.bond;
  ModelReport report;
  const Assembly model = check_and_report(c, &report);
  EXPECT_EQ(report.num_blocks, expected.blocks);
  EXPECT_EQ(report.num_parts, expected.cells);
  EXPECT_NEAR(report.smallest_block, expected.smallest, 5.5e-4);  // half a unit of the table's last digit
  EXPECT_NEAR(report.largest_block, expected.largest, expected.largest > 10 ? 5.5e-3 : 5.5e-4);
  EXPECT_EQ(report.islands, 1);
  EXPECT_LT(report.max_overlap, 1e-9);
  EXPECT_LT(report.max_convexity_error, 3e-14);  // coordinates of 40 m are rounded to 7e-15 m

  int beds = 0, heads = 0, base = 0;
  for (const Part& part : model.parts) {
    if (part.ring < 0) continue;
    const FaceKind lower = model.face_kinds[part.face_start];
    (part.ring == 0 ? base : beds) += lower == FaceKind::bed ? 1 : 0;
    heads += model.face_kinds[part.face_start + 2] == FaceKind::head ? 1 : 0;
  }
  EXPECT_EQ(beds, expected.bed_quads);
  EXPECT_EQ(heads, expected.head_quads);
  EXPECT_EQ(base, expected.base_quads);
}

INSTANTIATE_TEST_SUITE_P(
    Table, PaperModel,
    testing::Values(VaultCount{DomeSurface{}, RunningBond{}, 1280, 5120, 2.295, 9.898, 4992, 1280, 128},
                    VaultCount{DomeSurface{}, HerringboneBond{}, 1296, 3840, 0.765, 9.895, 3120, 1920, 96},
                    VaultCount{vault_of(Construction::circular), RunningBond{}, 1280, 5120, 2.246, 10.18,
                               4992, 1280, 128},
                    VaultCount{vault_of(Construction::circular), HerringboneBond{}, 1296, 4160, 0.751, 10.21,
                               3376, 1920, 104}),
    test_names({"dome_running", "dome_herringbone", "vault_running", "vault_herringbone"}));

// The cells of one ring and sail merge, so a block has one part, or two if it spans a corner.
TEST(Vault, PlanarRibBlocksHaveTwoParts) {
  ModelReport report;
  const Assembly model =
      check_and_report(vault_case(Construction::planar_radial, Extrados::normal, RunningBond{}), &report);
  EXPECT_EQ(report.num_parts, 1280 + 320);
  EXPECT_NEAR(report.smallest_block, 2.151, 5.5e-4);
  EXPECT_NEAR(report.largest_block, 9.665, 5.5e-4);
  std::vector<int> parts(model.blocks.size(), 0), ribs_in_ring(40, 0);
  for (const Part& part : model.parts) ++parts[part.block];
  for (size_t b = 1; b < model.blocks.size(); ++b) {
    EXPECT_EQ(parts[b], model.blocks[b].rib ? 2 : 1);
    if (model.blocks[b].rib) ++ribs_in_ring[model.blocks[b].ring];
  }
  for (int ribs : ribs_in_ring) EXPECT_EQ(ribs, 8);
}

TEST(Vault, SailPositionsFollowTheAzimuth) {
  const Assembly model =
      cut_assembly(vault_case(Construction::circular, Extrados::normal, RunningBond{4, 32, 4, {}}));
  for (const Block& block : model.blocks) {
    if (block.fixed) continue;
    EXPECT_GE(block.sail_position, -1.0);
    EXPECT_LT(block.sail_position, 1.0);
    const double azimuth = std::atan2(block.centroid.y(), block.centroid.x());
    const double expected = (block.sail + 0.5 * (1.0 + block.sail_position)) * std::numbers::pi / 4;
    // The tolerance covers the tilt between the two legs of a rib block and the taper of the other blocks.
    EXPECT_NEAR(std::remainder(azimuth - expected, 2 * std::numbers::pi), 0.0, 0.02);
  }
}

/// Smallest and largest number of blocks on a level radial line at height z (m).
std::pair<size_t, size_t> blocks_met(const Assembly& model, double z) {
  std::pair<size_t, size_t> range{1000, 0};
  for (int i = 0; i < 720; ++i) {
    // Lines between the cuts, which lie at multiples of 1/1536 turn. A block counts if it contains more than
    // 1 mm.
    const double azimuth = (i + 0.37) * std::numbers::pi / 360;
    const size_t count = blocks_on_radial_line(model, z, azimuth, 1e-3).size();
    range = {std::min(range.first, count), std::max(range.second, count)};
  }
  return range;
}

using Range = std::pair<size_t, size_t>;

// A level radial line meets one block more than the number of beds that it crosses, which was computed
// independently from the formulas of surface and bond. An upright block may span all courses that the line
// crosses, hence 1 to 3 blocks in Brunelleschi's model.
TEST(Vault, LevelRadialLinesMeetTheExpectedNumbersOfBlocks) {
  struct Row {
    Extrados extrados;
    Bond bond;
    Range low, high;  // at 14.5 and 22.5 m
  };
  for (const Row& row : {Row{Extrados::normal, RunningBond{}, {2, 3}, {2, 3}},
                         Row{Extrados::midsail, RunningBond{}, {2, 3}, {2, 3}},
                         Row{Extrados::corner, RunningBond{}, {1, 2}, {2, 3}},
                         Row{Extrados::normal, HerringboneBond{}, {1, 3}, {1, 3}},
                         Row{Extrados::corner, HerringboneBond{}, {1, 2}, {1, 3}}}) {
    const Assembly model = cut_assembly(vault_case(Construction::circular, row.extrados, row.bond));
    EXPECT_EQ(blocks_met(model, 14.5), row.low);
    EXPECT_EQ(blocks_met(model, 22.5), row.high);
  }
  EXPECT_EQ(blocks_met(cut_assembly(Case{}), 14.5), Range(2, 2));
  const Assembly level =
      cut_assembly(vault_case(Construction::planar_horizontal, Extrados::normal, RunningBond{31, 32, 4, {}}));
  EXPECT_EQ(blocks_met(level, 14.5), Range(1, 1));
  EXPECT_EQ(blocks_met(level, 22.5), Range(1, 1));
}

// A level section meets the cone of bed k in the circle rho = z / tan t_k - e. At 22.5 m the whole circle of
// some bed lies inside the masonry: the octagon contains a circular ring.
TEST(Vault, SectionOfTheCircularVaultContainsACircularRing) {
  const Assembly model = cut_assembly(vault_case(Construction::circular, Extrados::normal, RunningBond{}));
  const double z = 22.5;
  std::map<int, std::set<int>> slices_crossed;  // bed -> slices where the cut plane crosses it
  for (const Part& part : model.parts) {
    if (part.ring < 1) continue;
    const double T = std::tan(part.ring * 1.5 * std::numbers::pi / 180);
    const std::vector<Vec3> quad = face_points(model, part.face_start);  // the lower bed
    for (const auto& [inner, outer] : {std::pair(quad[0], quad[3]), std::pair(quad[1], quad[2])}) {
      if ((inner.z() - z) * (outer.z() - z) >= 0.0) continue;
      const Vec3 crossing = inner + (z - inner.z()) / (outer.z() - inner.z()) * (outer - inner);
      EXPECT_NEAR(std::hypot(crossing.x(), crossing.y()), z / T - 13.5, 1e-12);
      slices_crossed[part.ring].insert(part.slice);
    }
  }
  size_t most = 0;
  for (const auto& [bed, slices] : slices_crossed) most = std::max(most, slices.size());
  EXPECT_EQ(most, 128u);
}

TEST(Vault, RejectsExtradosRulesThatDoNotApply) {
  EXPECT_THROW(generate(vault_case(Construction::circular, Extrados::bed, RunningBond{})), InputError);
  EXPECT_THROW(generate(vault_case(Construction::planar_radial, Extrados::bed, RunningBond{})), InputError);
}

}  // namespace
}  // namespace cupola::vault_test
