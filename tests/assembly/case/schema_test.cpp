// What `--schema` says of the keys of a case.

#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "assembly/base/error.hpp"
#include "assembly/case/case_reader.hpp"

namespace cupola::schema_test {
namespace {

TEST(Schema, NamesEveryKeyOnceWithItsDefault) {
  const std::string schema = case_schema();
  for (const char* expected :
       {"\njoints.friction: number, >= 0, default 0.4\n    Coulomb friction coefficient mu\n", ", required\n",
        "\ngeometry.surface.span (type: dome): number in m, > 0, default 45\n",
        "\ngeometry.surface.length (type: wall)", "postproc.meridians[].azimuth_deg",
        "joints.compliance.normal: number in m/N, m3/N, >= 0, default 1e-08 per point, 1e-10 per area\n"})
    EXPECT_NE(schema.find(expected), std::string::npos) << expected;
  std::istringstream lines(schema);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120u) << line;
}

// The bond of a wythe has the keys of geometry.bond, 30 of them.
TEST(Schema, DescribesARepeatedSectionOnce) {
  const std::string schema = case_schema();
  EXPECT_NE(schema.find("geometry.wythes[].bond: map\n"), std::string::npos);
  EXPECT_NE(schema.find("; keys as in geometry.bond\n"), std::string::npos);
  EXPECT_EQ(schema.find("geometry.wythes[].bond.rings"), std::string::npos);
  EXPECT_NE(case_schema("geometry.wythes").find("geometry.wythes[].bond.rings"), std::string::npos);
}

TEST(Schema, AsJsonSaysWhatAnEditorChecks) {
  const auto schema = nlohmann::json::parse(case_json_schema());
  const auto& keys = schema.at("properties");
  EXPECT_EQ(keys.at("extends").at("type"), "string");
  const auto& joints = keys.at("joints");
  EXPECT_EQ(joints.at("additionalProperties"), false);
  EXPECT_EQ(joints.at("properties").at("friction").at("minimum"), 0.0);
  EXPECT_EQ(joints.at("properties").at("friction").at("description"),
            "Coulomb friction coefficient mu; default 0.4");
  const auto& surface = keys.at("geometry").at("properties").at("surface").at("properties");
  EXPECT_EQ(surface.at("type").at("enum").size(), 5u);
  EXPECT_EQ(surface.at("crown_angle_deg").at("exclusiveMaximum"), 90.0);
  const auto& wythe = keys.at("geometry").at("properties").at("wythes").at("items").at("properties");
  EXPECT_EQ(wythe.at("thickness").at("anyOf").size(), 2u) << "a number, or heights and values";
  EXPECT_EQ(wythe.at("bond").at("properties").at("rings").at("type"), "integer");
}

TEST(Schema, ShowsOneKeyOrSection) {
  EXPECT_EQ(case_schema("joints.friction"),
            "joints.friction: number, >= 0, default 0.4\n    Coulomb friction coefficient mu\n");
  const std::string sections = case_schema("postproc.meridians");
  EXPECT_NE(sections.find("postproc.meridians[].azimuth_deg"), std::string::npos) << sections;
  EXPECT_EQ(sections.find("postproc.planes"), std::string::npos) << sections;
  const auto refused = [](const std::string& key) -> std::string {
    try {
      case_schema(key);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refused("joints.frction"),
            "error: --schema joints.frction: no such key; did you mean joints.friction?");
  EXPECT_EQ(refused("mu").find("error: --schema mu: no such key; did you mean joints.friction or "), 0u)
      << refused("mu");
}

}  // namespace
}  // namespace cupola::schema_test
