// Blocks that were exported are imported again: the same blocks come back.

#include "assembly/export/export.hpp"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "generators/generate.hpp"
#include "generators/importer/readers.hpp"
#include "tests/fresh_folder.hpp"
#include "tests/generators/meshes.hpp"
#include "tests/generators/models.hpp"

namespace cupola::export_test {
namespace {

Assembly imported(const std::string& path, const Assembly& original) {
  ImportedBlocks source;
  source.path = path;
  for (size_t b = 0; b < original.blocks.size(); ++b)
    if (original.blocks[b].fixed) source.supports.push_back(fmt::format("{}", b));
  return import_blocks(source, 1000.0);
}

/// Same order, same shape. The coordinates are the same doubles; sums over their products differ by rounding.
void expect_same_blocks(const Assembly& a, const Assembly& b) {
  constexpr double kRounding = 1e-12;
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (size_t i = 0; i < a.blocks.size(); ++i) {
    const Block &x = a.blocks[i], &y = b.blocks[i];
    EXPECT_EQ(x.fixed, y.fixed) << i;
    EXPECT_NEAR(x.volume, y.volume, kRounding * x.volume) << i;
    EXPECT_NEAR((x.centroid - y.centroid).norm(), 0.0, kRounding * x.centroid.norm()) << i;
    const Mat3 per_density = y.inertia * (x.density / y.density);
    EXPECT_NEAR((x.inertia - per_density).norm(), 0.0, 1e3 * kRounding * x.inertia.norm()) << i;
  }
}

std::vector<std::pair<std::string, Case>> models() {
  Case spirals = dome_case();
  HerringboneBond herringbone;
  herringbone.rings = 9;
  spirals.geometry.bond = herringbone;
  Case octagon = dome_case(8, 16, 2);
  octagon.geometry.surface = OctagonalVault{};
  // Stones in several parts that share no faces: a round hole, and stones with an arm in each of two webs.
  Case hole = wall_case(4, 3);
  Cut cut;
  cut.kind = Cut::Kind::cylinder;
  cut.centre_u = 5.0;
  cut.centre_v = 3.0;
  cut.radius = 1.2;
  cut.sides = 8;
  hole.geometry.cuts = {cut};
  Case groin = dome_case(5, 2, 2);
  VaultSurface webs;
  webs.plan.kind = Plan::Kind::groin;
  webs.plan.sides = 4;
  webs.thickness = 0.5;
  groin.geometry.surface = webs;
  return {{"dome", dome_case(6, 8, 2)}, {"spirals", spirals}, {"octagon", octagon},
          {"wall", wall_case(4, 3)},    {"hole", hole},       {"groin", groin}};
}

TEST(Export, ComesBackThroughObjAndCompas) {
  const std::string folder = test::fresh_folder("exported");
  for (const auto& [name, scene] : models()) {
    const Assembly original = cut_assembly(scene);
    for (const char* ending : {".obj", ".json"}) {
      SCOPED_TRACE(name + ending);
      const std::string path = folder + "/" + name + ending;
      write_export(path, {original, {}, {}});
      expect_same_blocks(original, imported(path, original));
    }
  }
}

// The faces between the convex parts of a block are no part of its surface.
TEST(Export, ClosesBlocksThatAreNotConvex) {
  const std::string folder = test::fresh_folder("exported");
  std::ofstream(folder + "/0.obj") << "o 0\nv 0 0 0\nv 2 0 0\nv 2 0 1\nv 1 0 1\nv 1 0 3\nv 0 0 3\n"
                                      "v 0 1 0\nv 2 1 0\nv 2 1 1\nv 1 1 1\nv 1 1 3\nv 0 1 3\n"
                                      "f 1 2 3 4 5 6\nf 12 11 10 9 8 7\nf 1 7 8 2\nf 2 8 9 3\nf 3 9 10 4\n"
                                      "f 4 10 11 5\nf 5 11 12 6\nf 6 12 7 1\n";
  ImportedBlocks source;
  source.path = folder + "/0.obj";
  source.supports = {"0"};
  const Assembly original = import_blocks(source, 1000.0);
  ASSERT_GT(original.parts.size(), 1u) << "an L has at least two convex parts";
  for (const char* ending : {".obj", ".json"}) {
    SCOPED_TRACE(ending);
    write_export(folder + "/again" + ending, {original, {}, {}});
    expect_same_blocks(original, imported(folder + "/again" + ending, original));
  }
}

// Two parts that lie on each other with a part of a face, and have one corner in common.
TEST(Export, UnitesPartsThatShareACorner) {
  const std::string folder = test::fresh_folder("exported");
  std::ofstream(folder + "/0.obj") << obj_of({prism(l_shape(), 1.0, "0")});
  ImportedBlocks source;
  source.path = folder + "/0.obj";
  source.supports = {"0"};
  Assembly original = import_blocks(source, 1000.0);
  ASSERT_EQ(original.parts.size(), 2u);
  std::ranges::replace(original.face_kinds, FaceKind::internal, FaceKind::free);
  const std::vector<Vec3>& corners = original.vertices;
  const auto first =
      std::ranges::find_if(corners, [&](const Vec3& p) { return std::ranges::count(corners, p) > 1; });
  ASSERT_NE(first, corners.end());
  const auto same = std::find(first + 1, corners.end(), *first);
  std::ranges::replace(original.face_vertices, static_cast<int>(same - corners.begin()),
                       static_cast<int>(first - corners.begin()));
  write_export(folder + "/again.obj", {original, {}, {}});
  expect_same_blocks(original, imported(folder + "/again.obj", original));
}

// A hook lies on a table and reaches below it on both sides, so that its centroid is lower.
TEST(Export, InterfacesLookOutOfTheirFirstBlock) {
  const std::string folder = test::fresh_folder("exported");
  const std::vector<Eigen::Vector2d> hook{{-1, -3},  {-0.2, -3}, {-0.2, 1}, {1.2, 1},
                                          {1.2, -3}, {2, -3},    {2, 1.5},  {-1, 1.5}};
  std::ofstream(folder + "/two.obj") << obj_of(
      {prism({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1.0, "0"), prism(hook, 1.0, "1")});
  ImportedBlocks source;
  source.path = folder + "/two.obj";
  source.supports = {"0"};
  const Assembly original = import_blocks(source, 1000.0);
  ASSERT_LT(original.blocks[1].centroid.z(), original.blocks[0].centroid.z());
  for (const int first : {0, 1}) {
    ExportedJoint joint;
    joint.block_a = first;
    joint.block_b = 1 - first;
    joint.outline = {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    source.path = folder + "/two.json";
    write_export(source.path, {original, {}, {joint}});
    ImportReport report;
    const Assembly again = import_blocks(source, 1000.0, &report);
    const std::string csv = contacts_csv(source, again, report);
    EXPECT_NE(csv.find(first == 0 ? "\n0,1,0,0,0,1,0,0,1,0,0.25\n" : "\n1,0,0,0,0,1,-0,-0,-1,0,0.25\n"),
              std::string::npos)
        << csv;
  }
}

// Zeros for all would come back as a wall of one course, with keys by course that this model refuses.
TEST(Export, NumbersNoCoursesThatDoNotExist) {
  const std::string path = test::fresh_folder("exported") + "/wall.json";
  Assembly wall = cut_assembly(wall_case(2, 2));
  for (const bool has_courses : {true, false}) {
    if (!has_courses) {
      wall.num_rings = 0;
      wall.sheets.clear();
      for (Block& block : wall.blocks) block.ring = 0;
    }
    write_export(path, {wall, {}, {}});
    for (const RawBlock& block : read_compas(path))
      EXPECT_EQ(block.course.has_value(), has_courses && !block.fixed) << block.name;
  }
}

// Names, supports and densities of imported blocks survive in a COMPAS file.
TEST(Export, KeepsNamesAndDensitiesInCompas) {
  const std::string folder = test::fresh_folder("exported");
  Assembly original = cut_assembly(wall_case(2, 2));
  for (size_t b = 0; b < original.blocks.size(); ++b) {
    original.blocks[b].name = fmt::format("stone \"{}\"", b);
    original.blocks[b].density = 1500.0 + static_cast<double>(b);
  }
  write_export(folder + "/wall.json", {original, {}, {}});
  ImportedBlocks source;
  source.path = folder + "/wall.json";
  const Assembly again = import_blocks(source, 1000.0);
  ASSERT_EQ(again.blocks.size(), original.blocks.size());
  for (size_t b = 0; b < original.blocks.size(); ++b) {
    EXPECT_EQ(again.blocks[b].name, original.blocks[b].name);
    EXPECT_EQ(again.blocks[b].density, original.blocks[b].density);
    EXPECT_EQ(again.blocks[b].fixed, original.blocks[b].fixed);
  }
}

}  // namespace
}  // namespace cupola::export_test
