// Courses, rings and faces of imported blocks, found from their joints alone.

#include "generators/importer/courses.hpp"

#include <array>
#include <fstream>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/case/case_reader.hpp"
#include "assembly/export/export.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/model/loaded_faces.hpp"
#include "generators/generate.hpp"
#include "tests/fresh_folder.hpp"
#include "tests/generators/importer/import_files.hpp"
#include "tests/generators/meshes.hpp"
#include "tests/generators/models.hpp"

namespace cupola::courses_test {
namespace {

using SupportRule = ImportedBlocks::SupportRule;

/// A model that comes back from a file without its names and kinds of faces, and without its courses from OBJ.
Assembly imported(const std::string& folder, const Assembly& original, SupportRule rule,
                  GenerateReport* report, const std::string& file = "model.obj") {
  Case scene;
  scene.geometry.imported.emplace();
  scene.geometry.imported->path = test::fresh_folder(folder) + "/" + file;
  scene.geometry.imported->fixed_by = rule;
  write_export(scene.geometry.imported->path, {original, {}, {}});
  return generate(scene, report);
}

/// m2, of the faces of a kind, per course of their block.
std::vector<double> areas(const Assembly& assembly, FaceKind kind) {
  std::vector<double> areas(static_cast<size_t>(assembly.num_rings), 0.0);
  for (const Part& part : assembly.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      if (!assembly.blocks[part.block].fixed && assembly.face_kinds[f] == kind)
        areas[part.ring] += polygon_area(face_points(assembly, f));
  return areas;
}

void expect_same_courses(const Assembly& original, const Assembly& found) {
  constexpr double kRounding = 1e-9;  // of sums of areas, from coordinates that were written with 17 digits
  ASSERT_EQ(found.num_rings, original.num_rings);
  ASSERT_EQ(found.sheets.size(), 1u);
  const Sheet &a = original.sheets.front(), &b = found.sheets.front();
  EXPECT_EQ(b.closed, a.closed);
  EXPECT_EQ(b.thrust_lines, a.thrust_lines);
  EXPECT_TRUE(b.is_central());
  for (size_t i = 0; i < original.blocks.size(); ++i)
    ASSERT_EQ(found.blocks[i].ring, original.blocks[i].ring) << i;
  for (const FaceKind kind : {FaceKind::bed, FaceKind::head, FaceKind::intrados, FaceKind::extrados}) {
    const std::vector<double> expected = areas(original, kind), is = areas(found, kind);
    for (size_t k = 0; k < expected.size(); ++k)
      EXPECT_NEAR(is[k], expected[k], kRounding * std::max(1.0, expected[k])) << to_string(kind) << " " << k;
  }
}

TEST(Courses, OfAnOctagonAreThoseItWasGeneratedWith) {
  const Case scene = read_case(CUPOLA_SOURCE_DIR "/cases/octagon_circular.yaml",
                               {"geometry.bond.rings=10", "geometry.bond.blocks_per_ring=16"});
  const Assembly original = cut_assembly(scene);
  GenerateReport report;
  const Assembly found = imported("octagon", original, SupportRule::lowest, &report);
  EXPECT_EQ(report.import->courses.kind, "rings about a vertical axis") << report.import->courses.refusal;
  expect_same_courses(original, found);
}

// The springings have one neighbour each, and the courses run from the first to the second.
TEST(Courses, OfAnArchRunFromOneSpringingToTheOther) {
  const Assembly original = cut_assembly(read_case(CUPOLA_SOURCE_DIR "/cases/arch.yaml", {}));
  GenerateReport report;
  const Assembly found = imported("arch", original, SupportRule::one_neighbour, &report);
  EXPECT_EQ(report.import->courses.kind, "an arch") << report.import->courses.refusal;
  expect_same_courses(original, found);
}

TEST(Courses, OfAWallAreThoseItWasGeneratedWith) {
  const Assembly original = cut_assembly(wall_case(4, 3));
  GenerateReport report;
  const Assembly found = imported("wall", original, SupportRule::lowest, &report);
  EXPECT_EQ(report.import->courses.kind, "a wall") << report.import->courses.refusal;
  ASSERT_EQ(found.num_rings, 4);
  for (size_t i = 0; i < original.blocks.size(); ++i)
    EXPECT_EQ(found.blocks[i].ring, original.blocks[i].ring) << i;
  EXPECT_FALSE(found.sheets.front().outward(Vec3(1.0, 0.0, 0.0)).has_value());
}

// The lintel is the only stone of its course: the piers below it say which way the wall runs.
TEST(Courses, OfALintelHaveBothFacesOfTheWall) {
  const Assembly portal = generate(read_case(CUPOLA_SOURCE_DIR "/cases/portal.yaml", {}));
  for (const FaceKind skin : {FaceKind::intrados, FaceKind::extrados}) {
    const std::vector<double> found = areas(portal, skin);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0], 2 * 0.6 * 3.0, 1e-12);
    EXPECT_NEAR(found[1], 4.0 * 0.5, 1e-12);
  }
}

/// Those of all extrados look the same way: the sum of their normals times their areas is as long as that of
/// their areas.
void expect_one_outside(const Assembly& assembly) {
  Vec3 sum = Vec3::Zero();
  double area = 0.0;
  for (const LoadedFace& face : faces_of_kind(assembly, std::array{FaceKind::extrados}, 0, kLastRing, "")) {
    sum += face.area * face.normal;
    area += face.area;
  }
  EXPECT_GT(area, 0.0);
  EXPECT_NEAR(sum.norm(), area, 1e-12 * area) << "rounding of sums: " << sum.transpose();
}

/// An imported tower of single stones, turned about z.
Assembly tower_of(const std::vector<RawBlock>& stones, double turn) {
  Case scene;
  scene.geometry.imported.emplace();
  scene.geometry.imported->path = test::fresh_folder("tower") + "/tower.obj";
  scene.geometry.imported->fixed_by = SupportRule::lowest;
  std::vector<RawBlock> turned = stones;
  for (RawBlock& stone : turned)
    for (Vec3& p : stone.mesh.vertices) p = Eigen::AngleAxisd(turn, Vec3::UnitZ()) * p;
  write_text_atomically(scene.geometry.imported->path, obj_of(turned));
  GenerateReport report;
  Assembly tower = generate(scene, &report);
  EXPECT_EQ(report.import->courses.kind, "a wall") << report.import->courses.refusal;
  EXPECT_EQ(tower.num_rings, 5);
  return tower;
}

// Of stones turned by a right angle from one to the next, and of those alike, whose longer side lies along x
// or, but for rounding, along y.
TEST(Courses, OfATowerOfSingleStonesHaveOneOutside) {
  for (const double other : {1.0, 1.1}) {
    std::vector<RawBlock> stones;
    for (int k = 0; k < 6; ++k) {
      const double x = k % 2 == 0 ? 1.1 : other, z = 0.5 * k;
      stones.push_back(prism({{0, z}, {x, z}, {x, z + 0.5}, {0, z + 0.5}}, 2.1 - x, std::to_string(k)));
    }
    for (int quarter = 0; quarter < 4; ++quarter) {
      SCOPED_TRACE(fmt::format("{} {}", other, quarter));
      expect_one_outside(tower_of(stones, 0.5 * std::numbers::pi * quarter));
    }
  }
}

// The upright blocks of herringbone spirals reach through several courses.
TEST(Courses, AreRefusedForHerringboneWithTheStonesThatBreakThem) {
  Case spirals = dome_case();
  HerringboneBond herringbone;
  herringbone.rings = 9;
  spirals.geometry.bond = herringbone;
  const Assembly original = cut_assembly(spirals);
  GenerateReport report;
  const Assembly found = imported("spirals", original, SupportRule::lowest, &report);
  EXPECT_EQ(report.import->courses.courses, 0);
  EXPECT_EQ(found.num_rings, 0);
  EXPECT_NE(report.import->courses.refusal.find("stones "), std::string::npos)
      << report.import->courses.refusal;
  const bool names_an_upright = std::ranges::any_of(original.blocks, [&](const Block& block) {
    const auto number = fmt::format(" {}", &block - original.blocks.data());
    return block.kind == BlockKind::herringbone &&
           report.import->courses.refusal.find(number) != std::string::npos;
  });
  EXPECT_TRUE(names_an_upright) << report.import->courses.refusal;
}

/// A wall on a footing with a step of half a stone: c stands on the ground, e beside it on the step, and d on
/// e. `numbers` of the courses of c, e, d; 0: none.
CourseReport stepped_wall(const std::array<int, 3>& numbers) {
  std::string text = import_test::obj_box("ground", 0, -1, 1) + import_test::obj_box("step", 1.1, -0.5, 9);
  const std::array<std::pair<const char*, Eigen::Vector2d>, 3> stones{
      {{"c", {0.0, 0.0}}, {"e", {1.0, 0.5}}, {"d", {1.0, 1.5}}}};
  for (size_t i = 0; i < stones.size(); ++i) {
    text += numbers[i] > 0 ? fmt::format("g course {}\n", numbers[i]) : "g\n";
    const auto& [name, at] = stones[i];
    text += import_test::obj_box(name, at.x(), at.y(), 17 + 8 * static_cast<int>(i));
  }
  Case scene;
  scene.geometry.imported.emplace();
  scene.geometry.imported->path = test::fresh_folder("stepped") + "/wall.obj";
  scene.geometry.imported->supports = {"ground", "step"};
  std::ofstream(scene.geometry.imported->path) << text;
  GenerateReport report;
  const Assembly found = generate(scene, &report);
  const CourseReport& courses = report.import->courses;
  for (size_t i = 0; i < stones.size() && courses.courses > 0; ++i) {
    EXPECT_EQ(found.blocks[2 + i].ring, i == 2 ? 1 : 0) << i;
  }
  return courses;
}

// The lower beds of c and e, neighbours in the first course, do not meet.
TEST(Courses, OfTheFileOverrideThoseFound) {
  const std::string found = stepped_wall({0, 0, 0}).refusal;
  EXPECT_NE(found.find("does not meet that of their neighbour end to end: blocks c, e"), std::string::npos)
      << found;
  const CourseReport upwards = stepped_wall({4, 4, 7}), downwards = stepped_wall({7, 7, 4});
  EXPECT_EQ(upwards.courses, 2) << upwards.refusal;
  EXPECT_EQ(downwards.courses, 2) << downwards.refusal;
  EXPECT_TRUE(upwards.of_file);
}

TEST(Courses, OfTheFileAreRefusedWithTheStonesThatBreakThem) {
  try {
    stepped_wall({1, 0, 2});
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("of other blocks, but not of block e"), std::string::npos)
        << error.what();
  }
  const std::string refusal = stepped_wall({1, 1, 1}).refusal;
  EXPECT_NE(refusal.find("stones that lie on none of a lower number, and on no support: block d"),
            std::string::npos)
      << refusal;
}

// Three footings in line define no axis: a thrust about their middle would be a number without meaning.
TEST(Courses, OfAWallOnThreeFootingsHaveNoAxis) {
  std::string text;
  for (int i = 0; i < 8; ++i)  // five boxes side by side, with a footing below the first, third and fifth
    text += import_test::obj_box(std::to_string(i), i < 5 ? i : 2 * (i - 5), i < 5 ? 1 : 0, 8 * i + 1);
  Case scene;
  scene.geometry.imported.emplace();
  scene.geometry.imported->path = test::fresh_folder("footings") + "/wall.obj";
  scene.geometry.imported->fixed_by = SupportRule::lowest;
  write_text_atomically(scene.geometry.imported->path, text);
  GenerateReport report;
  const Assembly wall = generate(scene, &report);
  EXPECT_EQ(report.model.num_supports, 3);
  EXPECT_EQ(report.import->courses.kind, "a wall");
  EXPECT_TRUE(wall.sheets.empty() || wall.sheets.front().thrust_lines == Sheet::ThrustLines::none);
}

// Two portals side by side have no axis between them; under one slab they are a vault on four springers.
TEST(Courses, OfArchesSideBySideHaveNoAxis) {
  std::vector<RawBlock> blocks;
  for (const double y : {0.0, 5.0}) {
    for (const double x : {0.0, 2.0})
      for (const double z : {0.0, 1.0})
        blocks.push_back(
            prism({{x, z}, {x + 1, z}, {x + 1, z + 1}, {x, z + 1}}, 1.0, fmt::format("{} {} {}", x, y, z)));
    blocks.push_back(prism({{0, 2}, {3, 2}, {3, 3}, {0, 3}}, 1.0, fmt::format("lintel {}", y)));
    for (size_t b = blocks.size() - 5; b < blocks.size(); ++b)
      for (Vec3& p : blocks[b].mesh.vertices) p.y() += y;
  }
  Case scene;
  scene.geometry.imported.emplace();
  scene.geometry.imported->path = test::fresh_folder("side_by_side") + "/model.obj";
  scene.geometry.imported->fixed_by = SupportRule::lowest;
  for (const auto expected : {Sheet::ThrustLines::none, Sheet::ThrustLines::radial}) {
    write_text_atomically(scene.geometry.imported->path, obj_of(blocks));
    const Assembly found = generate(scene);
    EXPECT_EQ(found.sheets.empty() ? Sheet::ThrustLines::none : found.sheets.front().thrust_lines, expected);
    blocks.push_back(prism({{0, 3}, {3, 3}, {3, 4}, {0, 4}}, 6.0, "slab"));
  }
}

/// The outside of each stone is that of the generated one, and opposite sides of the model have opposite ones.
void expect_same_outside(const Assembly& original, const Assembly& found) {
  constexpr double kRounding = 1e-9;  // of areas, from coordinates that were written with 17 digits
  std::vector<double> area(original.blocks.size(), 0.0), expected = area;
  Vec3 sum = Vec3::Zero();
  for (const auto& [assembly, of_blocks] : {std::pair(&found, &area), std::pair(&original, &expected)})
    for (const Part& part : assembly->parts)
      for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
        if (assembly->blocks[part.block].fixed || assembly->face_kinds[f] != FaceKind::extrados) continue;
        const std::vector<Vec3> polygon = face_points(*assembly, f);
        (*of_blocks)[part.block] += polygon_area(polygon);
        if (assembly == &found) sum += polygon_area(polygon) * polygon_plane(polygon).normal;
      }
  for (size_t b = 0; b < area.size(); ++b) EXPECT_NEAR(area[b], expected[b], kRounding) << b;
  EXPECT_NEAR(sum.head<2>().norm(), 0.0, kRounding * static_cast<double>(area.size()));
}

// The courses beside the windows are chains. Stones at their ends, and single ones, have an outside, too.
TEST(Courses, OfADrumWithWindowsAreRings) {
  const Member drum = octagonal_drum(10.0, 3.0, 0.6, RunningBond{6, 24, 2});
  Case c;
  c.geometry.surface = drum.surface;
  c.geometry.bond = drum.bond;
  Openings windows;
  windows.width = 1.0;
  windows.height = 1.0;
  windows.sill = 0.5;
  windows.bearing = 0.3;
  c.geometry.openings = {windows};
  const Assembly original = cut_assembly(c);
  GenerateReport report;
  const Assembly found = imported("windows", original, SupportRule::lowest, &report);
  EXPECT_EQ(report.import->courses.kind, "rings about a vertical axis") << report.import->courses.refusal;
  EXPECT_EQ(found.num_rings, 6);
  expect_same_outside(original, found);
}

// Joints lead round the middle of the wall, which is masonry. Its stones run along it, not to the other leaf.
// They have neighbours beside and behind them, so that only the file can number the courses.
TEST(Courses, OfAWallInTwoLeavesAreNoRings) {
  Case c = wall_case(4, 8);
  for (const char* leaf : {"back", "front"})
    c.geometry.wythes.push_back({leaf, {{}, {0.3}}, RunningBond{4, 8, 2}, {}});
  Bonders headers;
  headers.name = "header";
  headers.from = "back";
  headers.to = "front";
  headers.per_ring = 4;
  headers.at = {0.5};
  headers.width = 0.2;
  c.geometry.bonders = {headers};
  const Assembly original = cut_assembly(c);
  GenerateReport report;
  const Assembly found = imported("leaves", original, SupportRule::lowest, &report, "model.json");
  EXPECT_EQ(report.import->courses.kind, "a wall") << report.import->courses.refusal;
  expect_one_outside(found);
  for (const FaceKind skin : {FaceKind::intrados, FaceKind::extrados}) {
    const std::vector<double> expected = areas(original, skin), is = areas(found, skin);
    for (size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(is[k], expected[k], 1e-9) << k;  // 17 digits
  }
}

// A walk from stone to stone leads along one leaf and back along the other, about the joint between them.
TEST(Courses, OfTwoLeavesStoneByStoneAreNoRings) {
  for (const int length : {2, 3}) {
    SCOPED_TRACE(length);
    std::vector<RawBlock> stones{prism({{-1, -0.3}, {2.5, -0.3}, {2.5, 0}, {-1, 0}}, 0.4, "ground")};
    for (int k = 0; k < 3; ++k)
      for (const double leaf : {0.0, 0.2})
        for (int i = 0; i < length; ++i) {
          const double x = 0.5 * i, z = 0.25 * k;
          stones.push_back(prism({{x, z}, {x + 0.5, z}, {x + 0.5, z + 0.25}, {x, z + 0.25}}, 0.2,
                                 fmt::format("{}_{}", k, stones.size())));
          for (Vec3& p : stones.back().mesh.vertices) p.y() += leaf;
        }
    Case scene;
    scene.geometry.imported.emplace();
    scene.geometry.imported->path = test::fresh_folder("two_leaves") + "/wall.obj";
    scene.geometry.imported->supports = {"ground"};
    std::string text = obj_of(stones);
    for (int k = 0; k < 3 && length > 2; ++k)  // stones with three neighbours: the file numbers the courses
      text.insert(text.find(fmt::format("o {}_", k)), fmt::format("g course {}\n", k));
    write_text_atomically(scene.geometry.imported->path, text);
    GenerateReport report;
    const Assembly found = generate(scene, &report);
    EXPECT_EQ(report.import->courses.kind, "a wall") << report.import->courses.refusal;
    EXPECT_EQ(found.num_rings, 3);
    expect_one_outside(found);
  }
}

TEST(Courses, OutwardIsAwayFromAGivenAxis) {
  const Assembly original = cut_assembly(wall_case(4, 3));
  Case scene;
  scene.geometry.imported.emplace();
  scene.geometry.imported->path = test::fresh_folder("axis") + "/model.obj";
  scene.geometry.imported->fixed_by = SupportRule::lowest;
  scene.geometry.imported->axis = Eigen::Vector3d(0.0, -3.0, 7.0);
  write_export(scene.geometry.imported->path, {original, {}, {}});
  const Assembly found = generate(scene);
  ASSERT_EQ(found.sheets.size(), 1u);
  const std::optional<Vec3> outward = found.sheets.front().outward(Vec3(0.0, 1.0, 2.0));
  ASSERT_TRUE(outward.has_value());
  EXPECT_NEAR((*outward - Vec3::UnitY()).norm(), 0.0, 1e-15);
}

TEST(Courses, OfAnArchRefuseAnAxis) {
  Case scene;
  scene.geometry.imported.emplace();
  scene.geometry.imported->path = test::fresh_folder("axis_of_an_arch") + "/model.obj";
  scene.geometry.imported->fixed_by = SupportRule::one_neighbour;
  scene.geometry.imported->axis = Vec3(100.0, 0.0, 0.0);
  write_export(scene.geometry.imported->path,
               {cut_assembly(read_case(CUPOLA_SOURCE_DIR "/cases/arch.yaml", {})), {}, {}});
  EXPECT_NE(refusal_of(scene).find("geometry.import.axis: must be left out: an arch"), std::string::npos);
}

}  // namespace
}  // namespace cupola::courses_test
