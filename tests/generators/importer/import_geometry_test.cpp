// What the importer makes of surfaces: common planes, volumes, densities, supports.

#include <array>
#include <cmath>

#include "assembly/model/loaded_faces.hpp"
#include "tests/generators/importer/import_files.hpp"
#include "tests/generators/meshes.hpp"

namespace cupola::import_test {
namespace {

TEST_F(Import, SnapsOpposedFacetsToOnePlane) {
  ImportedBlocks source;
  source.path = write("two.obj", obj_box("a", 0, 0, 1) + obj_box("b", 0, 1.0004, 9));
  source.snap = 1e-3;
  ImportReport report;
  const Assembly model = import_blocks(source, 1.0, &report);
  EXPECT_EQ(report.snapped_facets, 2);
  double top = 0.0, bottom = 9.0;
  for (int v = 0; v < 8; ++v) top = std::max(top, model.vertices[v].z());
  for (int v = 8; v < 16; ++v) bottom = std::min(bottom, model.vertices[v].z());
  EXPECT_NEAR(top, 1.0002, 1e-12);
  EXPECT_NEAR(bottom, 1.0002, 1e-12);
}

/// Boxes on each other, each moved upwards by `errors` (m) from where it touches its neighbours.
std::string stack(const std::vector<double>& errors) {
  std::string text;
  for (size_t i = 0; i < errors.size(); ++i)
    text += obj_box(std::to_string(i), 0, static_cast<double>(i) + errors[i], 8 * static_cast<int>(i) + 1);
  return text;
}

// Rounded coordinates let plane faces gape and overlap by tenths of a millimetre, here by up to 0.7 mm.
TEST_F(Import, ClosesGapsAndOverlapsOfRoundedCoordinates) {
  Case scene;
  scene.geometry.imported.emplace();
  scene.geometry.imported->path = write("rounded.obj", stack({0, 4e-4, -3e-4, 2e-4, -4e-4, 1e-4}));
  scene.geometry.imported->supports = {"0"};
  GenerateReport report;
  generate(scene, &report);
  EXPECT_NEAR(report.import->snap, 7e-4, 1e-6);  // the widest; the tolerance is what covers rounding
  EXPECT_LT(report.model.max_overlap, 1e-12);
  EXPECT_LT(report.model.max_joint_gap, 1e-12);
}

// The solver finds a joint of an edge and a face, which the generator does not count: "0 joints".
TEST_F(Import, CountsBlocksThatTouchAtEdgesOnly) {
  Case scene;
  scene.geometry.imported.emplace();
  scene.geometry.imported->path =
      write("edge.obj", obj_of({prism({{-2, -1}, {2, -1}, {2, 0}, {-2, 0}}, 1.0, "ground"),
                                prism({{0, 0}, {1, 1}, {0, 2}, {-1, 1}}, 1.0, "on edge"),
                                prism({{1, 0}, {2, 0}, {2, 1}, {1, 1}}, 1.0, "on face")}));
  scene.geometry.imported->supports = {"ground"};
  GenerateReport report;
  generate(scene, &report);
  EXPECT_EQ(report.model.num_joints, 1);
  EXPECT_EQ(report.model.islands, 1);
  EXPECT_TRUE(report.model.blocks_without_joint.empty());
  EXPECT_EQ(report.model.blocks_on_edges, 1);
}

// On a ground of 3 x 3 m the base of a stone of 1 x 1 m is most of the gap from their common plane.
TEST_F(Import, SnapsByTheWidestGapWhateverTheAreas) {
  const auto box = [](const char* name, double x, double size, double low, double high) {
    return prism({{x, low}, {x + size, low}, {x + size, high}, {x, high}}, size, name);
  };
  Case scene;
  scene.geometry.imported.emplace();
  scene.geometry.imported->path =
      write("stones.obj", obj_of({box("ground", -1, 3, -1, 0), box("1", 0, 1, -2e-3, 1),
                                  box("2", 0, 1, 1.002, 2), box("3", 0, 1, 2, 3)}));
  scene.geometry.imported->supports = {"ground"};
  GenerateReport report;
  generate(scene, &report);
  EXPECT_NEAR(report.import->snap, 2e-3, 1e-5);  // as above
  EXPECT_LT(report.model.max_overlap, 1e-12);
  EXPECT_LT(report.model.max_joint_gap, 1e-12);
}

/// A box whose base rises by `wedge` (m) towards x = 1 and whose top by `lift` at one corner.
std::string wedged_box(const std::string& name, double z, double wedge, int first, double lift = 0.0) {
  std::string text = "o " + name + "\n";
  for (double dz : {0.0, 1.0})
    for (auto [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
      text += fmt::format("v {} {} {}\n", x, y,
                          z + dz + wedge * x * (1.0 - dz) + (dz * x * y > 0.0 ? lift : 0.0));
  const std::string box = obj_box(name, 0, 0, first);
  return text + box.substr(box.find("f "));
}

// A base that gapes by 1 mm on one side: its corner is that far from the face below, which is a little more
// than twice as far as from the plane between both. The other base overlaps by 0.7 mm.
TEST_F(Import, ClosesTheJointFromWhichSnapFollows) {
  Case scene;
  scene.geometry.imported.emplace();
  scene.geometry.imported->path = write(
      "wedges.obj", obj_box("0", 0, 0, 1) + wedged_box("1", 1, 1e-3, 9) + wedged_box("2", 2, -7e-4, 17));
  scene.geometry.imported->supports = {"0"};
  GenerateReport report;
  generate(scene, &report);
  EXPECT_NEAR(report.import->snap, 1e-3, 2e-6);
  EXPECT_EQ(report.import->snapped_facets, 4);
  EXPECT_LT(report.model.max_joint_gap, 1e-12);  // rounding
}

// Openings that were drawn do not overlap anywhere and stay.
TEST_F(Import, KeepsGapsThatWereDrawn) {
  ImportedBlocks source;
  source.path = write("open.obj", stack({0, 5e-4, 1e-3, 1.5e-3}));
  ImportReport report;
  import_blocks(source, 1.0, &report);
  EXPECT_EQ(report.snap, 0.0);
  EXPECT_EQ(report.snapped_facets, 0);
}

/// A box on another one, with a joint that gapes by `gap` (m), `wedge` more at x = 1. One corner of the top is
/// lifted by 80 mm, which warps this free face by at least 20 mm, four times of which are `snap`.
std::string gaping(double gap, double wedge) {
  return obj_box("a", 0, 0, 1) + wedged_box("b", 1.0 + gap, wedge, 9, 0.08);
}

// Openings of more than 1 % of the smaller box, 10 mm, stay although `snap` is larger.
TEST_F(Import, KeepsGapsThatWereDrawnBesideAWarpedFace) {
  for (const auto& [gap, wedge] : {std::pair(0.0, 0.0), {0.008, 0.0}, {0.03, 0.0}, {0.0, 0.03}}) {
    SCOPED_TRACE(fmt::format("gap {} m, wedge {} m", gap, wedge));
    ImportedBlocks source;
    source.path = write("gaping.obj", gaping(gap, wedge));
    ImportReport report;
    import_blocks(source, 1.0, &report);
    EXPECT_GT(report.snap, 0.08);
    EXPECT_EQ(report.snapped_facets, gap + 0.5 * wedge > 0.01 ? 0 : 2);
  }
}

TEST_F(Import, FixesTheLowestBlocks) {
  ImportedBlocks source;
  source.path = write("tower.obj", obj_box("a", 0, 0, 1) + obj_box("b", 0, 1, 9) + obj_box("c", 0, 2, 17));
  source.fixed_by = ImportedBlocks::SupportRule::lowest;
  const Assembly model = import_blocks(source, 1000.0);
  EXPECT_TRUE(model.blocks[0].fixed);
  EXPECT_FALSE(model.blocks[1].fixed);
  EXPECT_FALSE(model.blocks[2].fixed);
}

// A stone on a pad 5 mm thick is no support, however high the model: 5 mm are 5e-4 of it.
TEST_F(Import, FixesNoBlockOnAThinPad) {
  const auto brick = [](const char* name, double low, double high) {
    std::string row = fmt::format("{},0,0,0,2000,0,0,0,0,0,0", name);
    for (const double z : {low, high}) row += fmt::format(",0,0,{0},1,0,{0},1,1,{0},0,1,{0}", z);
    return row + "\n";
  };
  ImportedBlocks source;
  source.path = write("pad.csv", brick("pad", 0, 0.005) + brick("column", 0.005, 10));
  source.fixed_by = ImportedBlocks::SupportRule::lowest;
  const Assembly model = import_blocks(source, 1000.0);
  EXPECT_TRUE(model.blocks[0].fixed);
  EXPECT_FALSE(model.blocks[1].fixed);
}

// A wedge on its narrow foot in the middle of a wide ground. The least joint is 1e-3 of the cube root of
// 0.5 m3, 0.79 mm; the shift that separates foot and ground is 2 m. Tolerance: rounding of coordinates.
TEST_F(Import, MeasuresAJointInTheMiddleOfAFace) {
  for (const double foot : {0.5e-3, 1e-3}) {  // m
    SCOPED_TRACE(foot);
    const auto row = [](const char* name, int fixed, double z, double low, double high) {
      std::string text = fmt::format("{},{},0,0,2000,0,0,0,0,0,0", name, fixed);
      for (const auto& [x, level] : {std::pair(low, z), {high, z + 1.0}})
        text += fmt::format(",{0},0,{2},{1},0,{2},{1},1,{2},{0},1,{2}", -x, x, level);
      return text + "\n";
    };
    Case scene;
    scene.geometry.imported.emplace().path =
        write("wedge.csv", row("ground", 1, -1, 2, 2) + row("wedge", 0, 0, 0.5 * foot, 0.5));
    GenerateReport report;
    generate(scene, &report);
    EXPECT_EQ(report.model.num_joints, foot < 0.79e-3 ? 0 : 1);
    EXPECT_EQ(report.model.islands, foot < 0.79e-3 ? 2 : 1);
    ASSERT_EQ(report.model.narrow_joints.size(), foot < 0.79e-3 ? 1u : 0u);
    for (const NarrowJoint& joint : report.model.narrow_joints) EXPECT_NEAR(joint.width, foot, 1e-15);
  }
}

// Two faces of the block are warped by 0.1 m. The bilinear surface through four corners halves the difference
// of the volumes with either diagonal: each raised corner lifts the top by a quarter on average.
TEST_F(Import, ComparesTheVolumeWithTheDrawing) {
  std::string text = obj_box("a", 0, 0, 1);
  text.replace(text.find("v 1.000000 1 1.000000"), 21, "v 1.000000 1 1.100000");
  ImportedBlocks source;
  source.path = write("warped.obj", text);
  ImportReport report;
  const Assembly model = import_blocks(source, 1000.0, &report);
  EXPECT_NEAR(report.drawn_volume, 1.025, 1e-12);
  EXPECT_NEAR(report.volume_of_parts, model.blocks[0].volume, 1e-15);
  double parts = 0.0;
  for (const Part& part : model.parts) parts += part.volume;
  EXPECT_NEAR(model.blocks[0].volume, parts, 1e-12);
  EXPECT_NEAR(model.blocks[0].mass, 1000.0 * parts, 1e-9);
}

TEST_F(Import, AppliesDensitiesOfTheCase) {
  ImportedBlocks source;
  source.path = write("two.obj", obj_box("lower", 0, 0, 1) + obj_box("upper", 0.25, 1, 9));
  source.densities = {{{"upper"}, 3510.0}};
  const Assembly model = import_blocks(source, 2000.0);
  EXPECT_NEAR(model.blocks[0].mass, 2000.0, 1e-9);
  EXPECT_NEAR(model.blocks[1].mass, 3510.0, 1e-9);
  source.densities = {{{"middle"}, 3510.0}};
  EXPECT_THROW(import_blocks(source, 2000.0), InputError);
  source.densities = {{{"upper"}, 3510.0}, {{"lower", "upper"}, 2500.0}};
  EXPECT_THROW(import_blocks(source, 2000.0), InputError);
}

// A part that covers another face of its stone in part leaves the rest of it to loads.
TEST_F(Import, LoadsActOnTheSurfaceOfAStone) {
  for (const std::vector<Eigen::Vector2d>& section : {l_shape(), u_shape(), t_shape(), cross_shape()}) {
    ImportedBlocks source;
    source.path = write("stone.obj", obj_of({prism(section, 1.5)}));
    const Assembly stone = import_blocks(source, 1.0);
    double drawn = 2.0 * stone.blocks[0].volume / 1.5, loaded = 0.0;
    for (size_t i = 0; i < section.size(); ++i)
      drawn += 1.5 * (section[(i + 1) % section.size()] - section[i]).norm();
    for (const LoadedFace& face : faces_of_kind(stone, std::array{FaceKind::free}, -1, 0, ""))
      loaded += face.area;
    EXPECT_NEAR(loaded, drawn, 1e-14 * drawn) << "rounding of sums of areas";
  }
}

// A prism with 128 sides is one convex part with 256 vertices.
TEST_F(Import, KeepsConvexBlocksWithManyVerticesWhole) {
  const int n = 128;
  std::string text = "o drum\n", lower = "f", upper = "f", sides;
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * M_PI * i / n;
    text += fmt::format("v {0:.17g} {1:.17g} 0\nv {0:.17g} {1:.17g} 1\n", std::cos(a), std::sin(a));
    const int next = (i + 1) % n;
    upper += fmt::format(" {}", 2 * i + 2);
    lower += fmt::format(" {}", 2 * (n - 1 - i) + 1);
    sides += fmt::format("f {} {} {} {}\n", 2 * i + 1, 2 * next + 1, 2 * next + 2, 2 * i + 2);
  }
  ImportedBlocks source;
  source.path = write("drum.obj", text + lower + "\n" + upper + "\n" + sides);
  ImportReport report;
  const Assembly model = import_blocks(source, 1.0, &report);
  EXPECT_EQ(report.parts, std::vector<int>{1});
  EXPECT_EQ(model.vertices.size(), 2u * n);
  EXPECT_NEAR(model.blocks[0].volume, 0.5 * n * std::sin(2.0 * M_PI / n), 1e-12);
}

}  // namespace
}  // namespace cupola::import_test
