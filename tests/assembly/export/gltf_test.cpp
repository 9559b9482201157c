#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "assembly/base/error.hpp"
#include "assembly/export/export.hpp"
#include "assembly/export/formats.hpp"
#include "tests/assembly/scene.hpp"

namespace cupola::gltf_test {
namespace {

using Json = nlohmann::json;

Vec3 vector_of(const Json& numbers) {
  return {numbers.at(0).get<double>(), numbers.at(1).get<double>(), numbers.at(2).get<double>()};
}

/// Box of a node in its own axes, y up.
std::pair<Vec3, Vec3> box_of_node(const Json& file, const Json& node) {
  const Json& mesh = file["meshes"][node["mesh"].get<size_t>()];
  const Json& positions = file["accessors"][mesh["primitives"][0]["attributes"]["POSITION"].get<size_t>()];
  return {vector_of(positions["min"]), vector_of(positions["max"])};
}

// The cube spans 0.1..0.2 in x, 0..1/3 in y and 0..1 in z (tests/assembly/scene.hpp): y up, it spans 0..1 in
// y and -1/3..0 in z. Positions are floats of numbers below 1, hence 1e-7.
TEST(Gltf, TurnsTheBlocksUpright) {
  const Assembly a = test::two_block_assembly();
  const Json file = Json::parse(gltf_text({a, {}, {}}));
  EXPECT_EQ(file["asset"]["version"], "2.0");
  const Json& node = file["nodes"][0];
  EXPECT_EQ(node["name"], "0");
  const Vec3 origin = vector_of(node["translation"]);
  const Vec3& c = a.blocks[0].centroid;
  EXPECT_NEAR((origin - Vec3(c.x(), c.z(), -c.y())).norm(), 0.0, 1e-15);
  const auto [low, high] = box_of_node(file, node);
  EXPECT_NEAR((low + origin - Vec3(0.1, 0.0, -1.0 / 3)).norm(), 0.0, 1e-7);
  EXPECT_NEAR((high + origin - Vec3(0.2, 1.0, 0.0)).norm(), 0.0, 1e-7);
  EXPECT_EQ(file["nodes"].size(), 3u) << "two blocks and their parent, no forces";
}

// An arrow of 100 kN upwards at 1e-5 m/N is 1 m long.
TEST(Gltf, DrawsForcesToScale) {
  const Assembly a = test::two_block_assembly();
  ExportModel model{a, {}, {}, 1e-5};
  ExportedJoint joint;
  joint.block_b = 1;
  joint.centre = {0.3, 0.2, 1.0};
  joint.force = {0.0, 0.0, 1e5};
  model.joints = {joint};
  const Json file = Json::parse(gltf_text(model));
  const Json& node = file["nodes"].back();
  EXPECT_EQ(node["name"], "forces");
  EXPECT_EQ(file["scenes"][0]["nodes"].size(), 2u);
  const auto [low, high] = box_of_node(file, node);
  EXPECT_NEAR(low.y(), 1.0, 1e-7);
  EXPECT_NEAR(high.y(), 2.0, 1e-6);
  EXPECT_NEAR(0.5 * (low.x() + high.x()), 0.3, 1e-7);
  EXPECT_NEAR(0.5 * (low.z() + high.z()), -0.2, 1e-7);
}

TEST(Export, RefusesOtherEndings) {
  try {
    check_export_path("dome.stl");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(
        std::string(error.what()).find("must end in .gltf, .obj, .json (COMPAS), .csv or .vtu (Cupola)"),
        std::string::npos);
  }
}

TEST(Export, SaysWhichFormatsLoseTies) {
  Assembly a = test::two_block_assembly();
  EXPECT_TRUE(lost_by_export("dome.obj", a).empty());
  a.ties.resize(2);
  for (const char* path : {"dome.gltf", "dome.obj", "dome.json"}) {
    const std::vector<std::string> lost = lost_by_export(path, a);
    ASSERT_EQ(lost.size(), 1u) << path;
    EXPECT_EQ(lost[0].find(std::string(path) + " holds no ties: 2 ties"), 0u) << lost[0];
  }
  EXPECT_TRUE(lost_by_export("dome.vtu", a).empty());
}

}  // namespace
}  // namespace cupola::gltf_test
