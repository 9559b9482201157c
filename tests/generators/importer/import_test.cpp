#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "generators/generate.hpp"
#include "generators/importer/readers.hpp"
#include "tests/generators/meshes.hpp"
#include "tests/generators/shared_data.hpp"

namespace cupola::import_test {
namespace {

/// Gives each test its own folder for files.
class Import : public testing::Test {
 protected:
  Import() : folder_(std::filesystem::temp_directory_path() / ("cupola_import_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Import() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  /// Message of the error with which the generator rejects a file, or "".
  static std::string complaint(const std::string& path) {
    Case c;
    c.geometry.imported.emplace();
    c.geometry.imported->path = path;
    try {
      generate(c);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  std::filesystem::path folder_;
};

std::string obj_box(const std::string& name, double x, double z, int first) {
  std::string text = "o " + name + "\n";
  for (double dz : {0.0, 1.0})
    for (auto [dx, dy] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
      text += fmt::format("v {:f} {} {:f}\n", x + dx, dy, z + dz);
  const int faces[6][4] = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4},
                           {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  for (const auto& face : faces) {
    text +=
        fmt::format("f {} {} {} {}\n", first + face[0], first + face[1], first + face[2], first + face[3]);
  }
  return text;
}

constexpr const char* kOffBox =
    "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

TEST_F(Import, ReadsObjObjectsAsBlocks) {
  ImportedBlocks source;
  source.path = write("two.obj", obj_box("lower", 0, 0, 1) + obj_box("upper", 0.25, 1, 9));
  source.supports = {"lower"};
  ImportReport report;
  const Assembly model = import_blocks(source, 2000.0, &report);
  ASSERT_EQ(model.blocks.size(), 2u);
  ASSERT_EQ(report.origins.size(), 2u);
  EXPECT_EQ(report.origins[0].name, "lower");
  EXPECT_EQ(report.origins[1].name, "upper");
  EXPECT_TRUE(model.blocks[0].fixed);
  EXPECT_FALSE(model.blocks[1].fixed);
  EXPECT_NEAR(model.blocks[1].mass, 2000.0, 1e-9);
  EXPECT_NEAR((model.blocks[1].centroid - Vec3(0.75, 0.5, 1.5)).norm(), 0.0, 1e-15);
}

// Blender writes names with blanks, and a `#` inside a word is part of it.
TEST_F(Import, KeepsBlanksInTheNamesOfObjObjects) {
  ImportedBlocks source;
  source.path = write("two.obj", obj_box("Mesh 0  # a comment", 0, 0, 1) + obj_box("Mesh 1#b", 0.25, 1, 9));
  source.supports = {"Mesh 0"};
  const Assembly model = import_blocks(source, 2000.0);
  ASSERT_EQ(model.blocks.size(), 2u);
  EXPECT_EQ(model.blocks[0].name, "Mesh 0");
  EXPECT_EQ(model.blocks[1].name, "Mesh 1#b");
  EXPECT_TRUE(model.blocks[0].fixed);
}

TEST_F(Import, ReadsOffStlAndPly) {
  ImportedBlocks source;
  source.path = write("box.off", kOffBox);
  EXPECT_NEAR(import_blocks(source, 1.0).blocks.at(0).volume, 1.0, 1e-15);

  // Two tetrahedra of volume 1/6 in one ascii STL file are two components; the PLY file has one.
  std::string stl = "solid s\n";
  for (double x : {0.0, 5.0}) {
    const Vec3 p[4] = {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}, {x, 0, 1}};
    for (const auto& t :
         {std::array{0, 2, 1}, std::array{0, 1, 3}, std::array{1, 2, 3}, std::array{2, 0, 3}}) {
      stl += "facet normal 0 0 0\nouter loop\n";
      for (int v : t)
        stl += "vertex " + std::to_string(p[v].x()) + " " + std::to_string(p[v].y()) + " " +
               std::to_string(p[v].z()) + "\n";
      stl += "endloop\nendfacet\n";
    }
  }
  source.path = write("two.stl", stl + "endsolid s\n");
  const Assembly from_stl = import_blocks(source, 1.0);
  ASSERT_EQ(from_stl.blocks.size(), 2u);
  for (const Block& b : from_stl.blocks) EXPECT_NEAR(b.volume, 1.0 / 6, 1e-15);

  source.path =
      write("tet.ply",
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
            "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  EXPECT_NEAR(import_blocks(source, 1.0).blocks.at(0).volume, 1.0 / 6, 1e-15);
}

TEST_F(Import, ReadsBinaryStlAndPly) {
  const float p[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int t[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const auto raw = [](const auto& value) {
    return std::string(reinterpret_cast<const char*>(&value), sizeof value);
  };
  std::string stl(80, ' ');
  stl += raw(std::uint32_t{4});
  std::string ply =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
      "float z\n"
      "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& corner : p)
    for (float x : corner) ply += raw(x);
  for (const auto& triangle : t) {
    for (int i = 0; i < 3; ++i) stl += raw(0.0f);
    for (int v : triangle)
      for (float x : p[v]) stl += raw(x);
    stl += raw(std::uint16_t{0});
    ply += raw(std::uint8_t{3});
    for (int v : triangle) ply += raw(std::int32_t{v});
  }
  ImportedBlocks source;
  source.path = write("tet.stl", stl);
  EXPECT_NEAR(import_blocks(source, 1.0).blocks.at(0).volume, 1.0 / 6, 1e-15);
  source.path = write("tet.ply", ply);
  EXPECT_NEAR(import_blocks(source, 1.0).blocks.at(0).volume, 1.0 / 6, 1e-15);
}

TEST_F(Import, ConvertsUnitsAndAxes) {
  ImportedBlocks source;
  source.path = write("box.obj", obj_box("a", 0, 0, 1));
  source.metres_per_unit = 0.01;
  source.up = ImportedBlocks::UpAxis::y;  // (x, y, z) -> (x, -z, y)
  const Assembly model = import_blocks(source, 1.0);
  EXPECT_NEAR(model.blocks[0].volume, 1e-6, 1e-20);
  EXPECT_NEAR((model.blocks[0].centroid - Vec3(0.005, -0.005, 0.005)).norm(), 0.0, 1e-16);
}

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
  EXPECT_NEAR(report.import->snap, 7e-4, 1e-9);  // twice the distance from the middle of the widest
  EXPECT_LT(report.model.max_overlap, 1e-12);
  EXPECT_LT(report.model.max_joint_gap, 1e-12);
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

TEST_F(Import, ReadsDensityFlagsAndPartsOfBricks) {
  const std::string corners_a = "0,0,0,1,0,0,1,1,0,0,1,0,0,0,1,1,0,1,1,1,1,0,1,1";
  const std::string corners_b = "1,0,0,3,0,0,3,1,0,1,1,0,1,0,1,3,0,1,3,1,1,1,1,1";
  ImportedBlocks source;
  source.path = write("bricks.csv", "7,1,1,0,2500,0,0,0,0,0,0," + corners_a + ",9999," + corners_b + "\n");
  ImportReport report;
  const Assembly model = import_blocks(source, 1.0, &report);
  ASSERT_EQ(model.blocks.size(), 1u);
  EXPECT_EQ(report.parts, std::vector<int>{2});
  EXPECT_NEAR(model.blocks[0].mass, 2500.0 * 3.0, 1e-9);
  EXPECT_TRUE(model.blocks[0].fixed);
}

TEST_F(Import, SpringsAndRodsConnectBricks) {
  const std::string left = "0,0,0,1,0,0,1,1,0,0,1,0,0,0,1,1,0,1,1,1,1,0,1,1";
  const std::string right = "2,0,0,3,0,0,3,1,0,2,1,0,2,0,1,3,0,1,3,1,1,2,1,1";
  ImportedBlocks source;
  source.path =
      write("bricks.csv", "7,1,1,0,2500,0,0,0,0,0,0," + left + "\n8,0,1,0,2500,0,0,0,0,0,0," + right + "\n");
  source.springs = write("springs.csv", "1,7,1,0.5,0.25,8,2,0.5,0.25,5000,0.9\n");
  source.rods = write("rods.csv", "2,7,1,0.5,0.75,8,2,0.5,0.75\n");
  const Assembly model = import_blocks(source, 1.0);
  ASSERT_EQ(model.ties.size(), 2u);
  const BuiltTie &spring = model.ties[0], &rod = model.ties[1];
  EXPECT_DOUBLE_EQ(spring.stiffness, 5000.0);
  EXPECT_DOUBLE_EQ(spring.length, 0.9);
  EXPECT_FALSE(spring.pushes);
  EXPECT_EQ(spring.block_a, 0);
  EXPECT_EQ(spring.block_b, 1);
  EXPECT_EQ(spring.point_a, Vec3(1, 0.5, 0.25));
  EXPECT_EQ(spring.point_b, Vec3(2, 0.5, 0.25));
  EXPECT_TRUE(std::isinf(rod.stiffness));
  EXPECT_DOUBLE_EQ(rod.length, 1.0);
  EXPECT_TRUE(rod.pushes);
}

TEST_F(Import, NamesTheDefectOfInvalidInput) {
  const std::string box = obj_box("a", 0, 0, 1);
  std::string open = box.substr(0, box.rfind("f "));
  EXPECT_NE(
      complaint(write("open.obj", open)).find("open.obj:1: error: block a: not closed, 4 boundary edges"),
      std::string::npos)
      << complaint(write("open.obj", open));

  std::string inside_out;
  const int faces[6][4] = {{1, 2, 3, 4}, {8, 7, 6, 5}, {5, 6, 2, 1},
                           {6, 7, 3, 2}, {7, 8, 4, 3}, {8, 5, 1, 4}};
  inside_out = box.substr(0, box.find("f "));
  for (const auto& f : faces)
    inside_out += "f " + std::to_string(f[0]) + " " + std::to_string(f[1]) + " " + std::to_string(f[2]) +
                  " " + std::to_string(f[3]) + "\n";
  EXPECT_NE(complaint(write("turned.obj", inside_out)).find("block a: inside out"), std::string::npos);

  std::string crossing = box;  // one corner of the top lies below the bottom
  crossing.replace(crossing.find("v 1.000000 1 1.000000"), 21, "v 1.000000 1 -2.00000");
  EXPECT_NE(complaint(write("crossing.obj", crossing)).find("block a: its surface intersects itself"),
            std::string::npos)
      << complaint(write("crossing.obj", crossing));

  const std::string overlapping = box + obj_box("b", 0, 0.98, 9);
  EXPECT_NE(complaint(write("overlap.obj", overlapping))
                .find("overlap by 0.02 m, more than contact.margin = 0.01 m"),
            std::string::npos)
      << complaint(write("overlap.obj", overlapping));

  const std::string twice = box + obj_box("a", 5, 0, 9);
  EXPECT_NE(complaint(write("twice.obj", twice)).find("block a: the same name is used at"),
            std::string::npos);

  std::string nan = box;
  nan.replace(nan.find("v 1.0"), 5, "v nan");
  EXPECT_NE(
      complaint(write("nan.obj", nan)).find("nan.obj:3: error: block a: 'nan00000' is not a finite number"),
      std::string::npos)
      << complaint(write("nan.obj", nan));

  EXPECT_NE(complaint(write("empty.obj", box + "o nothing\n")).find("block nothing: no faces"),
            std::string::npos);
  EXPECT_NE(
      complaint(write("huge.off", "OFF\n100000000 100000000 0\n0 0 0\n")).find("declares 100000000 items"),
      std::string::npos);
  std::string stl(80, ' ');
  stl += std::string("\xff\xff\xff\x3f", 4);
  EXPECT_NE(complaint(write("huge.stl", stl)).find("declares 1073741823 triangles"), std::string::npos);
  EXPECT_NE(complaint(write("cut.json", "{\"data\": {\"graph\":")).find("cut.json:1: error: not valid JSON"),
            std::string::npos);
  EXPECT_NE(complaint((folder_ / "missing.obj").string()).find("no such file"), std::string::npos);
}

// Boxes on each other: the second reaches 0.02 m into the first, and the third 0.05 m into the second.
TEST_F(Import, NamesAllOverlapsAtOnceWithTheMarginThatAdmitsThem) {
  const std::string text = obj_box("a", 0, 0, 1) + obj_box("b", 0, 0.98, 9) + obj_box("c", 0, 1.93, 17);
  const std::string found = complaint(write("three.obj", text));
  for (const char* expected : {"blocks b and c (", "overlap by 0.05 m", "2 pairs overlap by more than that",
                               "b and c by 0.05 m, a and b by 0.02 m", "increase contact.margin to 0.053 m"})
    EXPECT_NE(found.find(expected), std::string::npos) << expected << " in: " << found;
  EXPECT_EQ(found.find('\n'), std::string::npos) << found;
}

// The lid of every other box is missing.
TEST_F(Import, NamesTheDefectsOfAllBlocksAtOnce) {
  const auto open = [](const std::string& box) {
    const size_t lid = box.find("f ", box.find("f ") + 1);
    return box.substr(0, lid) + box.substr(box.find('\n', lid) + 1);
  };
  const std::string found = complaint(
      write("open.obj", open(obj_box("a", 0, 0, 1)) + obj_box("b", 0, 1, 9) + open(obj_box("c", 0, 2, 17))));
  for (const char* expected :
       {"open.obj:1: error: block a: not closed, 4 boundary edges; block c: not closed"})
    EXPECT_NE(found.find(expected), std::string::npos) << expected << " in: " << found;
  EXPECT_EQ(found.find("block b"), std::string::npos) << found;
}

TEST_F(Import, DropsDoubledFacesWithAWarning) {
  const std::string box = obj_box("a", 0, 0, 1);
  const std::string again = box.substr(box.rfind("f "));
  const std::string reversed = "f 1 2 3 4\n";
  Case scene;
  scene.geometry.imported.emplace();
  scene.geometry.imported->path = write("doubled.obj", box + again + reversed);
  GenerateReport report;
  const Assembly model = generate(scene, &report);
  EXPECT_NEAR(model.blocks.at(0).volume, 1.0, 1e-15);
  EXPECT_EQ(report.import->doubled_faces, 2);
  EXPECT_NE(fmt::format("{}", fmt::join(warnings_of(report), "|")).find("2 faces repeat another one"),
            std::string::npos);
}

// A box of 1 m drawn in millimetres, and one of 2 km: nobody can know, so the unit is asked for.
TEST_F(Import, AsksForTheUnitOfModelsThatAreNoStructures) {
  std::string large = obj_box("a", 0, 0, 1);
  for (size_t at = large.find("v 1.000000"); at != std::string::npos; at = large.find("v 1.000000"))
    large.replace(at, 10, "v 2000.0");
  const std::string path = write("large.obj", large);
  EXPECT_NE(complaint(path).find("set geometry.import.metres_per_unit"), std::string::npos)
      << complaint(path);
  ImportedBlocks source;
  source.path = path;
  source.metres_per_unit = 1e-3;
  EXPECT_NO_THROW(import_blocks(source, 1000.0));
  source.metres_per_unit = 1.0;
  EXPECT_NO_THROW(import_blocks(source, 1000.0));
}

std::string scaled(const std::string& obj, double factor) {
  std::istringstream lines(obj);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    double x = 0.0, y = 0.0, z = 0.0;
    const bool vertex = std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) == 3;
    text += vertex ? fmt::format("v {} {} {}\n", factor * x, factor * y, factor * z) : line + "\n";
  }
  return text;
}

// A box of 30 m could be a structure, but is no stone.
TEST_F(Import, DoubtsTheUnitOfBlocksThatAreNoStones) {
  const std::string box = obj_box("a", 0, 0, 1), large = scaled(box, 30.0);
  Case scene;
  scene.geometry.imported.emplace();
  const auto doubted = [&](const std::string& text) {
    scene.geometry.imported->path = write("box.obj", text);
    GenerateReport report;
    generate(scene, &report);
    return fmt::format("{}", fmt::join(warnings_of(report), "|")).find("if the file is not in metres") !=
           std::string::npos;
  };
  EXPECT_FALSE(doubted(box));
  EXPECT_TRUE(doubted(large));
  scene.geometry.imported->metres_per_unit = 1.0;
  EXPECT_FALSE(doubted(large));
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

// A tower along the file's y axis, whose base is the only support.
TEST_F(Import, SuspectsThatYIsUpward) {
  std::string lying, upright;
  for (int i = 0; i < 4; ++i) upright += obj_box(fmt::format("{}", i), 0, i, 8 * i + 1);
  for (size_t start = 0; start < upright.size();) {
    const size_t end = upright.find('\n', start) + 1;
    const std::string line = upright.substr(start, end - start);
    double x = 0.0, y = 0.0, z = 0.0;
    lying += std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) == 3  // a turn about x
                 ? fmt::format("v {:f} {:f} {:f}\n", x, z, -y)
                 : line;
    start = end;
  }
  ImportedBlocks source;
  source.supports = {"0"};
  ImportReport report;
  source.path = write("upright.obj", upright);
  import_blocks(source, 1000.0, &report);
  EXPECT_EQ(report.doubt_of_axes, "");
  source.path = write("lying.obj", lying);
  import_blocks(source, 1000.0, &report);
  EXPECT_NE(report.doubt_of_axes.find("geometry.import.up: y"), std::string::npos);
  source.up = ImportedBlocks::UpAxis::y;
  import_blocks(source, 1000.0, &report);
  EXPECT_EQ(report.doubt_of_axes, "");
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

TEST_F(Import, RejectsLinksToFilesOutsideTheFolder) {
  const std::string outside = write("box.off", kOffBox);
  const auto folder = folder_ / "blocks";
  std::filesystem::create_directory(folder);
  write("blocks/a.off", kOffBox);
  std::filesystem::create_symlink("a.off", folder / "b.off");
  EXPECT_EQ(complaint(folder.string()).find("outside"), std::string::npos)
      << "links inside the folder are allowed";
  std::filesystem::create_symlink(outside, folder / "c.off");
  EXPECT_NE(complaint(folder.string()).find("c.off: error: is a link to a file outside the folder"),
            std::string::npos)
      << complaint(folder.string());
}

// --- models from other projects, if available -----------------------------------------------------------

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

TEST_F(Import, AppliesDensitiesOfTheCase) {
  ImportedBlocks source;
  source.path = write("two.obj", obj_box("lower", 0, 0, 1) + obj_box("upper", 0.25, 1, 9));
  source.densities = {{{"upper"}, 3510.0}};
  const Assembly model = import_blocks(source, 2000.0);
  EXPECT_NEAR(model.blocks[0].mass, 2000.0, 1e-9);
  EXPECT_NEAR(model.blocks[1].mass, 3510.0, 1e-9);
  source.densities = {{{"middle"}, 3510.0}};
  EXPECT_THROW(import_blocks(source, 2000.0), InputError);
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
