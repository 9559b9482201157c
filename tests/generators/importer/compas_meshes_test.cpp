// Files of COMPAS that are no assemblies: lists of meshes, and models of compas_dem.

#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "generators/importer/readers.hpp"

namespace cupola::compas_meshes_test {
namespace {

/// A unit cube on height z as COMPAS writes a mesh. `more`: further members after a comma.
std::string cube(double z, const std::string& more = "") {
  std::string vertices, faces;
  int id = 0;
  for (const double dz : {0.0, 1.0})
    for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
      vertices +=
          fmt::format(R"({}"{}": {{"x": {}, "y": {}, "z": {}}})", id > 0 ? ", " : "", id, x, y, z + dz),
          ++id;
  const int quads[6][4] = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4},
                           {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  id = 0;
  for (const auto& q : quads)
    faces += fmt::format(R"({}"{}": [{}, {}, {}, {}])", id > 0 ? ", " : "", id, q[0], q[1], q[2], q[3]), ++id;
  return fmt::format(
      R"({{"dtype": "compas.datastructures/Mesh", "data": {{"vertex": {{{}}}, "face": {{{}}}}}{}}})",
      vertices, faces, more);
}

std::vector<RawBlock> read(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / fmt::format("cupola_meshes_{}.json", ::getpid());
  std::ofstream(path) << text;
  struct Remove {
    std::filesystem::path path;
    ~Remove() { std::filesystem::remove(path); }
  } remove{path};
  return read_compas(path.string());
}

TEST(CompasMeshes, ListsOfMeshesAreBlocksInTheOrderOfTheFile) {
  const auto blocks = read("[[" + cube(0) + "], [" + cube(1, R"(, "name": "upper")") + ", " + cube(2) + "]]");
  ASSERT_EQ(blocks.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(blocks[i].mesh.vertices.size(), 8u);
    EXPECT_EQ(blocks[i].mesh.vertices.front().z(), i);
    EXPECT_FALSE(blocks[i].fixed);
  }
  EXPECT_EQ(blocks[1].name, "upper");
  EXPECT_TRUE(blocks[0].name.ends_with("_0") && blocks[2].name.ends_with("_2"));
}

TEST(CompasMeshes, ElementsOfAModelSayWhetherTheyAreSupports) {
  const auto element = [](double z, bool support) {
    return fmt::format(
        R"({{"dtype": "compas_dem.elements/Block", "data": {{"transformation": null, "geometry": {}, "is_support": {}}}}})",
        cube(z), support);
  };
  // The graph of a model holds meshes of its joints, which are no blocks.
  const std::string graph =
      R"("graph": {"data": {"node": {}, "edge": {"0": {"1": {"contacts": [)" + cube(1) + "]}}}}}";
  for (const std::string& elements :
       {fmt::format("[{}, {}]", element(0, true), element(1, false)),
        fmt::format(R"({{"a": {}, "b": {}}})", element(0, true), element(1, false))}) {
    const auto blocks = read(R"({"dtype": "compas_dem.models/BlockModel", "data": {)" + graph +
                             R"(, "elements": )" + elements + "}}");
    ASSERT_EQ(blocks.size(), 2u);
    EXPECT_TRUE(blocks[0].fixed);
    EXPECT_FALSE(blocks[1].fixed);
  }
}

/// The vertices and faces of cube() alone, as versions of COMPAS before 1.0 wrote them.
std::string former_cube(double z, const std::string& more = "") {
  const std::string mesh = cube(z);
  const size_t data = mesh.find("\"data\": ") + 8;
  std::string inner = mesh.substr(data, mesh.size() - 1 - data);
  inner.pop_back();
  return inner + more + "}";
}

// Blocks by number beside the graph that says which of them are supports; and in the nodes of a graph.
TEST(CompasMeshes, FormerVersionsAreRead) {
  std::string apart, nodes, within;
  for (const int i : {0, 2, 10}) {  // as text, 10 is before 2
    const std::string comma = i > 0 ? ", " : "", key = fmt::format("{}\"{}\": ", comma, i),
                      flag = fmt::format("\"is_support\": {}, \"course\": {}", i == 10, i + 3);
    apart += key + former_cube(i);
    nodes += key + "{" + flag + "}";
    within += key + R"({"block": {"dtype": "compas_assembly/Block", "value": )" + former_cube(i) + "}, " +
              flag + "}";
  }
  for (const std::string& text :
       {R"({"assembly": {"vertex": {)" + nodes + R"(}}, "blocks": {)" + apart + "}}",
        R"({"node": {)" + within + "}}"}) {
    const auto blocks = read(text);
    ASSERT_EQ(blocks.size(), 3u) << text;
    EXPECT_EQ(blocks[0].name, "0");
    EXPECT_EQ(blocks[2].name, "10");
    EXPECT_EQ(blocks[2].mesh.vertices.front().z(), 10.0);
    EXPECT_FALSE(blocks[0].fixed || blocks[1].fixed);
    EXPECT_TRUE(blocks[2].fixed);
    EXPECT_EQ(blocks[1].course, 5);
  }
}

TEST(CompasMeshes, AttributesOfAMeshSayWhetherItIsASupport) {
  const auto blocks = read(
      fmt::format("[{}, {}]", former_cube(0, R"(, "attributes": {"is_support": true})"), former_cube(1)));
  ASSERT_EQ(blocks.size(), 2u);
  EXPECT_TRUE(blocks[0].fixed);
  EXPECT_FALSE(blocks[1].fixed);
}

TEST(CompasMeshes, AreRefusedWithTheReason) {
  const auto complaint = [](const std::string& text) -> std::string {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(complaint(R"([{"transformation": [1, 0], "geometry": )" + cube(0) + "}]").find("transformation"),
            std::string::npos);
  const std::string box = R"({"dtype": "compas.geometry/Box", "data": {"xsize": 1, "ysize": 1, "zsize": 1}})";
  EXPECT_NE(complaint("[" + cube(0) + ", " + box + "]")
                .find("object 2 of a list of meshes is a compas.geometry/Box"),
            std::string::npos);
  EXPECT_EQ(complaint("[" + cube(0) + R"(, {"dtype": "compas.geometry/Frame", "data": {}}])"), "");
  EXPECT_NE(complaint(R"({"dtype": "other"})").find("not a COMPAS assembly"), std::string::npos);
  EXPECT_NE(complaint(R"([{"dtype": "m", "data": {"vertex": {}, "face": {}}}])").find("no faces"),
            std::string::npos);
}

}  // namespace
}  // namespace cupola::compas_meshes_test
