// Errors of checks against the blocks give the place of the key in the case.
#include "assembly/case/key_places.hpp"

#include <gtest/gtest.h>

#include "assembly/case/case_reader.hpp"
#include "tests/assembly/case/case_scratch.hpp"

namespace cupola::key_places_test {
namespace {

constexpr const char* kCase = R"(geometry: {surface: {type: wall}, bond: {type: running}}
joints: {compliance: {per: point}}
loads:
  forces:
    - {block: 3, force: [0, 0, -1]}
    - {block: 99, force: [0, 0, -1]}
)";

/// What is printed of an error in a check of the case.
std::string printed(const Case& scene, const std::string& message) {
  try {
    with_places_of_keys(scene, [&] { throw InputError(message); });
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(PlacesOfKeys, AreGivenInErrors) {
  const ScratchFolder scratch;
  const std::string path = scratch.write("c.yaml", kCase);
  const Case scene = read_case(path);
  for (const auto& [message, place] : std::initializer_list<std::pair<std::string, std::string>>{
           {"loads.forces[1]: block 99 does not exist", path + ":6:7: "},
           {"loads.forces[1].force = [...]: wrong", path + ":6:26: "},
           {"loads.forces[2]: not in the list", path + ":5:5: "},
           {"loads.gravity: not given", path + ":4:3: "},
           {"joints: wrong", path + ":2:9: "},
           {"analysis.plane: in no section of the file", ""},
           {"joints of block 3 are wrong", ""},
           {"block 3: not closed", ""}})
    EXPECT_EQ(printed(scene, message), place + "error: " + message);
  EXPECT_EQ(printed(Case{}, "joints: wrong"), "error: joints: wrong") << "without a file";
}

TEST(PlacesOfKeys, AreThoseOfTheOptionOrFileThatGivesThem) {
  const ScratchFolder scratch;
  const std::string base = scratch.write("base.yaml", kCase);
  const Case scene = read_case(scratch.write("c.yaml", "extends: base.yaml\n"),
                               {"joints.friction=0.5", "loads.forces[1].block=77"});
  EXPECT_EQ(printed(scene, "loads.forces[0]: wrong"), base + ":5:7: error: loads.forces[0]: wrong");
  EXPECT_EQ(printed(scene, "joints.friction: wrong").substr(0, 6), "--set ");
  EXPECT_EQ(printed(scene, "loads.forces[1].block: wrong").substr(0, 6), "--set ");
}

}  // namespace
}  // namespace cupola::key_places_test
