// Formats of block files: what is read from them.

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "generators/importer/mesh_repair.hpp"
#include "generators/importer/readers.hpp"
#include "tests/generators/importer/import_files.hpp"
#include "tests/generators/meshes.hpp"

namespace cupola::import_test {
namespace {

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

TEST(ImportReport, ExtentsAtCoordinatesOfMapsHaveTheDigitsOfTheModel) {
  ImportReport report;
  report.low = Vec3(5e5, 5.4e6, 432.0);
  report.high = report.low + Vec3(2.5, 1.0, 3.2);
  EXPECT_NE(to_text(report).find("x 500000 to 500002.5 m, y 5400000 to 5400001 m, z 432 to 435.2 m"),
            std::string::npos)
      << to_text(report);
}

// Two unit cubes that share a face, an edge or a corner, as stones of an STL file do.
// Two cubes, the second at an offset from the first. `rounding`: m, by which a corner that they may share lies
// too high, so that a face that they share is cut along other diagonals into triangles that do not coincide.
void expect_two_cubes(const Vec3& offset, double rounding) {
  const int faces[6][4] = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4},
                           {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  PolygonMesh mesh;
  for (const Vec3& origin : {Vec3(0, 0, 0), offset}) {
    const int first = static_cast<int>(mesh.vertices.size());
    for (double z : {0.0, 1.0})
      for (auto [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
        mesh.vertices.push_back(origin + Vec3(x, y, z));
    for (const auto& f : faces)  // two triangles each
      for (const int i : {1, 2}) mesh.faces.push_back({first + f[0], first + f[i], first + f[i + 1]});
  }
  for (Vec3& vertex : mesh.vertices)
    if (vertex == Vec3(1, 1, 1)) vertex.z() += rounding;
  merge_equal_vertices(&mesh);
  const std::vector<RawBlock> blocks = split_components(mesh, "cubes.stl");
  ASSERT_EQ(blocks.size(), 2u) << offset.transpose();
  for (const RawBlock& block : blocks) {
    EXPECT_EQ(block.mesh.faces.size(), 12u);
    EXPECT_EQ(block.mesh.vertices.size(), 8u);
    EXPECT_NEAR(mesh_volume(repair_mesh(block, 1e-6)), 1.0, rounding + 1e-12);
  }
}

TEST(SplitComponents, SeparatesStonesThatShareCorners) {
  for (const Vec3& offset : {Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(1, 1, 1)})
    for (const double rounding : {0.0, 1e-5}) expect_two_cubes(offset, rounding);
}

// A unit cube whose front has three more corners on its upper side, divided as a fan: three triangles have no
// height, also where the side is off a straight line by rounding.
TEST(RepairMesh, ReadsTrianglesWithoutHeight) {
  for (const double rounding : {0.0, 1e-16, -1e-16, 1e-7, -1e-7}) {
    RawBlock block;
    block.mesh.vertices = {{0, 0, 0},           {1, 0, 0},           {1, 1, 0},          {0, 1, 0},
                           {0, 0, 1},           {1, 0, 1},           {1, 1, 1},          {0, 1, 1},
                           {0.25, rounding, 1}, {0.5, -rounding, 1}, {0.75, rounding, 1}};
    for (const auto& face : {std::vector{0, 3, 2, 1},
                             {1, 2, 6, 5},
                             {2, 3, 7, 6},
                             {3, 0, 4, 7},
                             {0, 1, 5, 10, 9, 8, 4},
                             {4, 8, 9, 10, 5, 6, 7}})
      for (size_t i = 1; i + 1 < face.size(); ++i)
        block.mesh.faces.push_back({face[0], face[i], face[i + 1]});
    EXPECT_NEAR(mesh_volume(repair_mesh(block, 1e-6)), 1.0, std::abs(rounding) + 1e-12) << rounding;
  }
}

TEST_F(Import, ReadsFilesWithAByteOrderMark) {
  const std::string mark = "\xEF\xBB\xBF";
  EXPECT_EQ(read_obj(write("marked.obj", mark + obj_box("ground", 0, 0, 1))).at(0).name, "ground");
  EXPECT_EQ(read_off(write("marked.off", mark + kOffBox)).size(), 1u);
  const std::string stl = "solid s\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
  EXPECT_EQ(read_stl(write("marked.stl", mark + stl)).size(), 1u);
}

// A backslash at its end continues a line, with or without a blank before it; that of a comment does not.
TEST_F(Import, JoinsContinuedLinesOfObj) {
  std::string text = "# C:\\vault\\\n" + obj_box("a", 0, 0, 1);
  for (size_t at = text.find("\nf "); at != std::string::npos; at = text.find("\nf ", at + 1))
    text.insert(at + 2, " \\\r\n");
  text.insert(text.rfind(' '), "\\\n");
  const std::vector<RawBlock> blocks = read_obj(write("continued.obj", text));
  ASSERT_EQ(blocks.size(), 1u);
  ASSERT_EQ(blocks[0].mesh.faces.size(), 6u);
  for (const auto& face : blocks[0].mesh.faces) EXPECT_EQ(face.size(), 4u);
}

// Maya begins a file with the group `default`, which holds the vertices of the next one.
TEST_F(Import, GroupsOfObjWithoutFacesAreNoBlocks) {
  std::string text = obj_box("pCube1", 0, 0, 1);
  text.replace(0, 2, "g default\ng ");
  const std::vector<RawBlock> blocks = read_obj(write("maya.obj", text + "g default\n"));
  ASSERT_EQ(blocks.size(), 1u);
  EXPECT_EQ(blocks[0].name, "pCube1");
  EXPECT_EQ(blocks[0].mesh.faces.size(), 6u);
  EXPECT_NE(complaint(write("object.obj", "o empty\n" + obj_box("a", 0, 0, 1))).find("block empty: no faces"),
            std::string::npos);
}

// A group is in force until the next one, from before the first object on.
TEST_F(Import, GroupsOfObjObjectsNumberTheirCourses) {
  const std::string text = "g course 7\n" + obj_box("a", 0, 0, 1) + "g course 9\n" + obj_box("b", 0, 1, 9) +
                           obj_box("c", 1, 1, 17) + "g course x\n" + obj_box("d", 0, 2, 25);
  const std::vector<RawBlock> blocks = read_obj(write("groups.obj", text));
  ASSERT_EQ(blocks.size(), 4u);
  EXPECT_EQ(blocks[0].course, 7);
  EXPECT_EQ(blocks[1].course, 9);
  EXPECT_EQ(blocks[2].course, 9);
  EXPECT_FALSE(blocks[3].course.has_value());
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

  std::ranges::transform(stl, stl.begin(), [](unsigned char c) { return std::toupper(c); });
  source.path = write("upper.stl", stl);
  EXPECT_EQ(import_blocks(source, 1.0).blocks.size(), 2u);

  source.path = write("tet.ply",
                      "ply\nformat ascii 1.0\ncomment made from C:\\models\\\nelement vertex 4\nproperty "
                      "float x\nproperty float y\nproperty float z\n"
                      "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
                      "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  EXPECT_NEAR(import_blocks(source, 1.0).blocks.at(0).volume, 1.0 / 6, 1e-15);
}

// Programs with flat shading write each face with vertices of its own.
TEST_F(Import, MergesTheVerticesOfEachFaceOfOff) {
  std::string vertices, faces;
  int count = 0;
  for (const double z : {0.0, 1.0})  // two stones on each other
    for (const auto& face :
         {std::array{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}) {
      faces += fmt::format("4 {} {} {} {}\n", count, count + 1, count + 2, count + 3);
      for (const int v : face)
        vertices += fmt::format("{} {} {}\n", v % 4 == 1 || v % 4 == 2 ? 1 : 0, v % 4 / 2, z + v / 4);
      count += 4;
    }
  ImportedBlocks source;
  source.path = write("faces.off", "OFF\n48 12 0\n" + vertices + faces);
  const Assembly model = import_blocks(source, 1.0);
  ASSERT_EQ(model.blocks.size(), 2u);
  for (const Block& b : model.blocks) EXPECT_NEAR(b.volume, 1.0, 1e-15);
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
  for (const auto& [row, phrase] :
       {std::pair("1,7,1,0.5,0.5,7,0,0.5,0.5\n", "both ends are on block '7'"),
        {"1,7,1,0.5,0.5,8,1,0.5,0.5\n", "the length is 0"},
        {"1,7,1,0.5,0.5,8,9,0.5,0.5\n",
         "the end at (9, 0.5, 0.5) m lies 6 m beyond the faces of its block '8'"}}) {
    write("rods.csv", row);
    try {
      import_blocks(source, 1.0);
      ADD_FAILURE() << row;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(std::string("rods.csv:1: error: ") + phrase),
                std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace cupola::import_test
