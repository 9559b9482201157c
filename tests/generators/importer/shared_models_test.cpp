// Models from other projects, if available.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "generators/generate.hpp"
#include "generators/importer/mesh_repair.hpp"
#include "generators/importer/readers.hpp"
#include "tests/generators/shared_data.hpp"

namespace cupola::import_test {
namespace {

struct SharedModel {
  const char* file;
  std::vector<std::pair<int, double>> volumes;  // block, m3
};

class SharedCompas : public testing::TestWithParam<SharedModel> {};

TEST_P(SharedCompas, HasThePublishedVolumes) {
  if (shared_data().empty()) GTEST_SKIP() << "no shared data";
  ImportedBlocks source;
  source.path = shared_data() + "/compas_cra/" + GetParam().file;
  ImportReport report;
  const Assembly model = import_blocks(source, 1.0, &report);
  for (const auto& [block, volume] : GetParam().volumes)
    EXPECT_NEAR(model.blocks.at(static_cast<size_t>(block)).volume, volume, 1.1e-6 * volume + 6e-6) << block;
  EXPECT_LT(report.largest_volume_error, 1e-6);
  EXPECT_EQ(report.by_nef, 0) << to_text(report);
}

// Volumes computed independently by the divergence theorem, six decimals.
INSTANTIATE_TEST_SUITE_P(
    Files, SharedCompas,
    testing::Values(SharedModel{"H.json", {{0, 0.48}, {1, 0.48}, {2, 1.44}}},
                    SharedModel{"A.json", {{0, 0.58}, {1, 0.58}, {2, 1.478017}}},
                    SharedModel{"cubes.json", {{0, 0.77}, {1, 3.606302}, {2, 2.989669}}},
                    SharedModel{"type-a.json", {{0, 2.76669}, {1, 2.76669}, {2, 0.69646}}},
                    SharedModel{"type-b.json", {{2, 2.13646}}},
                    SharedModel{"type-c.json", {{0, 1.866025}, {1, 1.866025}, {2, 3.09889}}},
                    SharedModel{"type-d.json", {{2, 0.69889}}},
                    SharedModel{"concave-long.json", {{0, 0.206}, {1, 0.228}}},
                    SharedModel{"concave-short.json", {{0, 0.206}, {1, 0.168}}},
                    SharedModel{"bridge.json", {}}, SharedModel{"shelf-stable.json", {{0, 0.194336}}},
                    SharedModel{"snake.json", {{1, 5.274240}}}),
    [](const auto& param_info) {
      std::string name = param_info.param.file;
      std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
      return name;
    });

double total_volume(const std::string& file) {
  ImportedBlocks source;
  source.path = shared_data() + "/" + file;
  double sum = 0.0;
  for (const Block& b : import_blocks(source, 1.0).blocks) sum += b.volume;
  return sum;
}

TEST(SharedData, HasThePublishedTotalVolumes) {
  if (shared_data().empty()) GTEST_SKIP() << "no shared data";
  EXPECT_NEAR(total_volume("compas_cra/shelf-stable.json"), 0.325699, 1e-6);
  EXPECT_NEAR(total_volume("compas_cra/bridge.json"), 0.911787, 1e-6);
  EXPECT_NEAR(total_volume("compas_cra/snake.json"), 19.441669, 2e-5);
}

TEST(SharedData, WallAndBricksPassTheChecks) {
  if (shared_data().empty()) GTEST_SKIP() << "no shared data";
  for (const auto& [file, blocks] : {std::pair("obj/wall.obj", 38),
                                     {"masonry/wall_brickfile.txt", 321},  // rows without comments
                                     {"masonry/colonnade_brickfile.txt", 31}}) {
    Case c;
    c.geometry.imported.emplace();
    c.geometry.imported->path = shared_data() + "/" + file;
    const bool bricks = std::string(file).ends_with(".txt");
    if (bricks) c.geometry.imported->up = ImportedBlocks::UpAxis::y;
    c.contact.margin = 0.03;  // the blocks of the OBJ file are 25 mm apart
    GenerateReport report;
    const Assembly model = generate(c, &report);
    EXPECT_EQ(static_cast<int>(model.blocks.size()), blocks) << file;
    EXPECT_EQ(report.import->by_nef, 0) << file;
  }
}

// The file has 322 rows, one of which (#994, before the beam seats) is commented out. The anchors 997 and 998
// are 0.3 m away from the wall; only a rod connects each of them to a beam seat.
TEST(SharedData, RodsConnectTheWallOfBricks) {
  if (shared_data().empty()) GTEST_SKIP() << "no shared data";
  Case c;
  c.geometry.imported.emplace();
  c.geometry.imported->path = shared_data() + "/masonry/wall_brickfile.txt";
  c.geometry.imported->up = ImportedBlocks::UpAxis::y;
  GenerateReport report;
  Assembly wall = generate(c, &report);
  ASSERT_EQ(wall.blocks.size(), 321u);
  EXPECT_EQ(report.model.num_supports, 3);  // the anchors and the ground
  EXPECT_EQ(report.model.islands, 3);
  ASSERT_EQ(report.model.blocks_without_joint.size(), 2u);
  for (int i : {0, 1}) {
    const int block = report.model.blocks_without_joint[static_cast<size_t>(i)];
    EXPECT_EQ(report.import->origins[static_cast<size_t>(block)].name, i == 0 ? "997" : "998");
    EXPECT_TRUE(wall.blocks[static_cast<size_t>(block)].fixed);
  }
  for (const Block& block : wall.blocks) {
    if (!block.fixed) {
      EXPECT_TRUE(block.density == 1800.0 || block.density == 2500.0 || block.density == 11904.0);
    }
  }
  c.geometry.imported->rods = shared_data() + "/masonry/wall_rigidrodfile.txt";
  generate(c, &report);
  EXPECT_EQ(report.model.islands, 1);
  EXPECT_TRUE(report.model.blocks_without_joint.empty());
}

// The faces are warped quads. The published volume is that of fans from their first vertices; other triangles
// of a warped quad change it by a third of the warp times the area.
TEST(SharedData, SplitsWarpedFacesIntoTriangles) {
  if (shared_data().empty()) GTEST_SKIP() << "no shared data";
  double volume = 0.0;
  for (const RawBlock& block : read_compas(shared_data() + "/compas_cra/curve-3-blocks.json"))
    volume += mesh_volume(repair_mesh(block, 1e-6));
  EXPECT_NEAR(volume, 4.269792, 1e-3);  // warps of up to 1.1e-3 m, to both sides, over about 3 m2
}

TEST(SharedData, SpringsAndRodsConnectTheirBlocks) {
  if (shared_data().empty()) GTEST_SKIP() << "no shared data";
  ImportedBlocks source;
  source.path = shared_data() + "/masonry/wall_brickfile.txt";
  source.springs = shared_data() + "/masonry/wall_springfile.txt";
  source.rods = shared_data() + "/masonry/wall_rigidrodfile.txt";
  source.up = ImportedBlocks::UpAxis::y;
  const Assembly model = import_blocks(source, 1.0);
  ASSERT_EQ(model.ties.size(), 4u);
  EXPECT_DOUBLE_EQ(model.ties[0].stiffness, 57265199.0);
  EXPECT_NEAR((model.ties[0].point_a - Vec3(0.79, 0.25, 2.77)).norm(), 0.0, 1e-15);
  // Block 995 is the beam seat at x = 0.79, 996 its mirror image.
  EXPECT_NEAR(model.blocks.at(static_cast<size_t>(model.ties[0].block_a)).centroid.x(), 0.78, 0.02);
  EXPECT_NEAR(model.blocks.at(static_cast<size_t>(model.ties[0].block_b)).centroid.x(), -0.78, 0.02);
  EXPECT_TRUE(model.ties[2].pushes);
  EXPECT_NEAR(model.ties[2].length, 0.7625, 1e-12);
}

}  // namespace
}  // namespace cupola::import_test
