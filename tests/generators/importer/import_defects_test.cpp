// Files that are refused or doubted, and with which words.

#include <algorithm>
#include <array>

#include <fmt/ranges.h>

#include "generators/importer/readers.hpp"
#include "tests/generators/importer/import_files.hpp"

namespace cupola::import_test {
namespace {

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
  EXPECT_NE(complaint(write("points.obj", "v 0 0 0\n")).find("no faces in this file"), std::string::npos);
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

/// A cube with the sides `edge` about (x, 0, 0), in lines of an OBJ file.
std::string cube_at(double x, double edge, int first, bool inside_out) {
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += fmt::format("v {} {} {}\n", x + (i & 1 ? 0.5 : -0.5) * edge, (i & 2 ? 0.5 : -0.5) * edge,
                        (i & 4 ? 0.5 : -0.5) * edge);
  std::array<std::array<int, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (auto& face : faces) {
    if (inside_out) std::ranges::reverse(face);
    text +=
        fmt::format("f {} {} {} {}\n", first + face[0], first + face[1], first + face[2], first + face[3]);
  }
  return text;
}

// A surface that looks the wrong way beside another one of the block was "cannot be split into convex parts",
// and a cavity drawn as a block of its own had the advice to reverse it: a stone inside the other.
TEST_F(Import, TellsSurfacesThatAreInsideOutFromCavities) {
  ImportedBlocks source;
  source.path = write("cavity.obj", "o a\n" + cube_at(0, 1.0, 1, false) + cube_at(0, 0.5, 9, true));
  EXPECT_NEAR(import_blocks(source, 1000.0).blocks.at(0).volume, 0.875, 1e-15) << "m3, up to rounding";
  for (const double x : {0.0, 3.0}) {
    const std::string found =
        complaint(write("one.obj", "o a\n" + cube_at(0, 1.0, 1, false) + cube_at(x, 0.5, 9, x > 0.0)));
    EXPECT_NE(found.find("block a: one of its closed surfaces is inside out"), std::string::npos) << found;
  }
  const std::string found =
      complaint(write("own.obj", "o a\n" + cube_at(0, 1.0, 1, false) + "o b\n" + cube_at(0, 0.5, 9, true)));
  EXPECT_NE(found.find("block b: inside out: reverse its faces, or, if it is the cavity of another block"),
            std::string::npos)
      << found;
}

// A load that is in the table but not in the model would turn "it falls" into "it stands".
TEST_F(Import, RefusesForcesOfBricks) {
  const std::string corners = ",0.5,0.5,1,0,0,0,1,0,0,1,1,0,0,1,0,0,0,1,1,0,1,1,1,1,0,1,1\n";
  EXPECT_EQ(read_bricks(write("still.csv", "s1,0,1,0,2500,0,-0.0,0" + corners)).size(), 1u);
  const std::string pushed = complaint(write("pushed.csv", "s1,0,1,0,2500,20000,0,0" + corners));
  EXPECT_NE(pushed.find("pushed.csv:1: error: block s1: has a force, which is not read"), std::string::npos)
      << pushed;
}

// An empty cell stays one cell, of a cube of 1 m3: where empty cells vanished, the corners moved by three
// columns and the first was lost, which left 0.83 m3. Tolerance: rounding of sums.
TEST_F(Import, CountsEmptyCellsOfBricks) {
  const std::string corners = "0,0,0,1,0,0,1,1,0,0,1,0,0,0,1,1,0,1,1,1,1,0,1,1\n";
  const std::string path = write("no_point.csv", "2,0,1,,2000,0, 0,0,,,\t," + corners);
  ImportedBlocks source;
  source.path = path;
  EXPECT_NEAR(import_blocks(source, 1000.0).blocks.at(0).volume, 1.0, 1e-15);
  EXPECT_EQ(read_bricks(write("padded.csv",
                              "2,0,1,,2000,0,0,0,,,," + corners.substr(0, corners.size() - 1) + ",,,\n"))
                .at(0)
                .point_parts.at(0)
                .size(),
            8u);
  for (const auto& [row, phrase] :
       {std::pair("2,0,1,0,2000,,,,0,0,0,", "cells.csv:1: error: block 2: value 6 of the row is empty"),
        {",0,1,0,2000,0,0,0,0,0,0,", "the first column, its ID, is empty"},
        {"2,0,1,0,2000,0,0,0,0,0,0,,", "value 12 of the row is empty"}}) {
    const std::string found = complaint(write("cells.csv", row + corners));
    EXPECT_NE(found.find(phrase), std::string::npos) << found;
  }
}

// Read as separators, decimal commas doubled the numbers: "overlap by 15.8 m".
TEST_F(Import, RefusesDecimalCommasBetweenSemicolons) {
  const std::string found = complaint(write("comma.csv", "2;0;1;0;2000;0;0;0;0;0;0;0,25;0;0 # a, b\n"));
  EXPECT_NE(found.find("'0,25' is not a finite number (value 12 of the row"), std::string::npos) << found;
}

// Dropped, a density would be that of `material`, and a support free.
TEST_F(Import, RefusesAttributesOfCompasOfAnotherType) {
  const auto file = [this](const std::string& attribute) {
    return write("node.json",
                 R"({"data": {"graph": {"data": {"node": {"7": {"block": {"data": {"vertex":
                 {"0": {"x": 0, "y": 0, "z": 0}, "1": {"x": 1, "y": 0, "z": 0}, "2": {"x": 0, "y": 1, "z": 0},
                 "3": {"x": 0, "y": 0, "z": 1}}, "face": {"0": [0, 2, 1], "1": [0, 1, 3], "2": [0, 3, 2],
                 "3": [1, 2, 3]}}}, )" +
                     attribute + "}}, \"edge\": {}}}}}");
  };
  for (const auto& [attribute, phrase] :
       {std::pair(R"("density": "1000")", R"(block 7: density = "1000": must be a number > 0)"),
        {R"("density": -1000)", "block 7: density = -1000: must be a number > 0"},
        {R"("density": 0)", "block 7: density = 0: must be a number > 0"},
        {R"("is_support": 1)", "block 7: is_support = 1: must be true or false"},
        {R"("course": "0")", R"(block 7: course = "0": must be a whole number)"},
        {R"("course": 0.5)", "block 7: course = 0.5: must be a whole number"}}) {
    const std::string found = complaint(file(attribute));
    EXPECT_NE(found.find(phrase), std::string::npos) << found;
  }
  const std::string is_default = R"("density": null, "is_support": null, "course": )";
  EXPECT_EQ(read_compas(file(is_default + "null")).at(0).course, std::nullopt);
  EXPECT_EQ(read_compas(file(is_default + "-1")).at(0).course, std::nullopt);
  EXPECT_EQ(read_compas(file(is_default + "0.0")).at(0).course, 0);
}

// A slip of unit, and an arch of two stones, each with one neighbour: the model weighed 0 N and stood.
TEST_F(Import, RefusesACaseThatFixesAllBlocks) {
  Case scene;
  ImportedBlocks& source = scene.geometry.imported.emplace();
  source.path = write("two.obj", obj_box("a", 0, 0, 1) + obj_box("b", 0, 1, 9));
  const auto found = [&scene] {
    try {
      generate(scene);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  source.fixed_below = 10.0;
  EXPECT_EQ(found(),
            "error: geometry.import.fixed_below: all blocks are fixed; leave those free that may move");
  source.fixed_below.reset();
  source.fixed_by = ImportedBlocks::SupportRule::one_neighbour;
  EXPECT_EQ(found(), "error: geometry.import.fixed_by: all blocks are fixed; leave those free that may move");
}

// The lid runs back and forth along one of its edges.
TEST_F(Import, RefusesAFaceThatPassesACornerTwice) {
  std::string box = obj_box("a", 0, 0, 1);
  const std::string lid = "f 5 6 7 8";
  box.replace(box.find(lid), lid.size(), "f 5 6 7 6 7 8");
  const std::string found = complaint(write("spike.obj", box));
  EXPECT_NE(found.find("block a: a face passes through a corner twice"), std::string::npos) << found;
}

// A stone of two boxes that share a cube would weigh it twice.
TEST_F(Import, RefusesPartsOfABrickThatOverlap) {
  const std::string lying = "0,0,0,2,0,0,2,1,0,0,1,0,0,0,1,2,0,1,2,1,1,0,1,1",
                    upright = "0,0,0,1,0,0,1,1,0,0,1,0,0,0,2,1,0,2,1,1,2,0,1,2";
  const std::string found =
      complaint(write("l.csv", "2,0,1,0,2000,0,0,0,0,0,0," + lying + ",9999," + upright + "\n"));
  EXPECT_NE(found.find("l.csv:1: error: block 2: two of its parts overlap by 1 m"), std::string::npos)
      << found;
}

// Boxes on each other: the second reaches 0.02 m into the first, and the third 0.05 m into the second.
TEST_F(Import, NamesAllOverlapsAtOnceWithTheMarginThatAdmitsThem) {
  const std::string text = obj_box("a", 0, 0, 1) + obj_box("b", 0, 0.98, 9) + obj_box("c", 0, 1.93, 17);
  const std::string found = complaint(write("three.obj", text));
  for (const char* expected : {"blocks b and c (", "overlap by 0.05 m", "2 pairs overlap:",
                               "b and c by 0.05 m, a and b by 0.02 m", "increase contact.margin to 0.053 m"})
    EXPECT_NE(found.find(expected), std::string::npos) << expected << " in: " << found;
  EXPECT_EQ(found.find('\n'), std::string::npos) << found;
}

// No margin makes two blocks of one.
TEST_F(Import, OffersNoMarginForABlockThatIsDrawnTwice) {
  const std::string found = complaint(write("twice.obj", obj_box("a", 0, 0, 1) + obj_box("b", 0, 0, 9)));
  EXPECT_NE(found.find("correct the geometry, in which one may be drawn twice or inside the other"),
            std::string::npos)
      << found;
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

// Two stones in one object, one of them with a cavity, which is no solid. Supports may be drawn as one.
TEST_F(Import, WarnsOfSeparateSolidsThatMoveAsOneStone) {
  const auto without_name = [](const std::string& box) { return box.substr(box.find('\n') + 1); };
  const std::string cavity =
      "v 0.4 0.4 0.4\nv 0.6 0.4 0.4\nv 0.4 0.6 0.4\nv 0.4 0.4 0.6\nf 17 18 19\nf 17 20 18\nf 17 19 20\nf 18 "
      "20 19\n";
  ImportedBlocks source;
  source.path = write("joined.obj", obj_box("a", 0, 0, 1) + without_name(obj_box("", 0, 2, 9)) + cavity);
  ImportReport report;
  import_blocks(source, 2000.0, &report);
  EXPECT_EQ(report.solids, std::vector<int>{2});
  EXPECT_NE(fmt::format("{}", fmt::join(warnings_of(report), "|"))
                .find("block a: 2 separate solids move as 1 rigid stone"),
            std::string::npos);
  source.supports = {"a"};
  ImportReport of_support;
  import_blocks(source, 2000.0, &of_support);
  EXPECT_EQ(of_support.separate_solids, "");
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

}  // namespace
}  // namespace cupola::import_test
