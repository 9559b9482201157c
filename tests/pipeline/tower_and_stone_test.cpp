// An import in two parts: a tower of three cubes that stands, and a stone beside it that nothing carries.

#include <cmath>

#include "assembly/files/summary_file.hpp"
#include "tests/pipeline/program_run.hpp"

namespace cupola::tower_and_stone_test {
namespace {

/// A cube of 1 m as an object of an OBJ file, with its lowest corner at (x, 0, z).
std::string cube(const std::string& name, double x, double z, int index) {
  std::string text = "o " + name + "\n";
  for (int i = 0; i < 8; ++i) text += fmt::format("v {} {} {}\n", x + (i & 1), (i >> 1) & 1, z + (i >> 2));
  constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 4, 6, 2},
                                {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}};
  for (const auto& face : kFaces) {
    text += "f";
    for (const int corner : face) text += fmt::format(" {}", 8 * index + corner + 1);
    text += "\n";
  }
  return text;
}

struct Answer {
  Summary summary;
  std::string answers;
};

Answer answer_of(const ProgramFolder& folder, const std::string& blocks) {
  std::ofstream(folder.file("blocks.obj")) << blocks;
  std::ofstream(folder.file("case.yaml")) << "geometry: {import: {file: blocks.obj, supports: [ground]}}\n"
                                             "material: {density: 2000}\nloads: {gravity: [0, 0, -10]}\n"
                                             "joints: {friction: 0.6, compliance: {per: area}}\n";
  const ProgramRun made = folder.run("cupola-generate case.yaml --output a.vtu");
  EXPECT_EQ(made.code, 0) << made.err;
  const ProgramRun solved = folder.run("cupola-solve case.yaml --assembly a.vtu --output results");
  EXPECT_EQ(solved.code, 0) << solved.err;
  const ProgramRun drawn =
      folder.run("cupola-post analyse case.yaml --assembly a.vtu --results results --output post --tables");
  EXPECT_EQ(drawn.code, 0) << drawn.err;
  return {summary_from_json(slurp(folder.file("results/summary.json")), "summary.json"),
          slurp(folder.file("post/answers.json"))};
}

std::string tower() {
  return cube("ground", 0, -1, 0) + cube("low", 0, 0, 1) + cube("middle", 0, 1, 2) + cube("high", 0, 2, 3);
}

TEST(TowerAndStone, TheStoneFallsAndTheTowerStandsUnderItsOwnWeight) {
  const ProgramFolder folder;
  const Answer both = answer_of(folder, tower() + cube("stone", 5, 1, 4));
  EXPECT_EQ(both.summary.status, Status::moving) << both.summary.message;
  ASSERT_EQ(both.summary.parts.size(), 2u);
  EXPECT_EQ(both.summary.parts[0].blocks, 3);
  EXPECT_EQ(both.summary.parts[0].status, Status::stable);
  EXPECT_EQ(both.summary.parts[1].blocks, 1);
  EXPECT_EQ(both.summary.parts[1].first_block, 4);
  EXPECT_EQ(both.summary.parts[1].status, Status::moving);
  EXPECT_NE(both.answers.find("It stands, except for what falls"), std::string::npos) << both.answers;
  EXPECT_NE(
      both.answers.find("Of 2 unconnected parts one falls (1 block, \\\"stone\\\"), one stands (3 blocks)."),
      std::string::npos)
      << both.answers;
  // Three cubes of 1 m3 and 2000 kg at 10 m/s2 weigh 60 kN, and the stone does not reach the ground.
  EXPECT_NEAR(both.summary.support_reaction_N.z(), 60e3, 1e-3);
  EXPECT_EQ(both.summary.free_blocks, 3);
  EXPECT_NEAR(both.summary.weight_N, 60e3, 1e-10 * 60e3) << "rounding of the volumes";

  // Of the tower alone the forces are the same, to the default tolerance of 1e-9 of a block's weight: its
  // courses are found, and with them another first step.
  const Answer alone = answer_of(folder, tower());
  EXPECT_EQ(alone.summary.status, Status::stable);
  EXPECT_TRUE(alone.summary.parts.empty());
  EXPECT_LE((alone.summary.support_reaction_N - both.summary.support_reaction_N).norm(), 1e-9 * 3 * 20e3);
}

// A part that falls may be the largest: then the whole falls.
TEST(TowerAndStone, TheLargestPartDecides) {
  const ProgramFolder folder;
  const Answer answer = answer_of(
      folder, cube("ground", 0, -1, 0) + cube("low", 0, 0, 1) + cube("one", 5, 1, 2) + cube("two", 5, 2, 3));
  EXPECT_EQ(answer.summary.status, Status::moving);
  ASSERT_EQ(answer.summary.parts.size(), 2u);
  EXPECT_EQ(answer.summary.parts[0].status, Status::moving);
  EXPECT_EQ(answer.summary.parts[1].status, Status::stable);
  EXPECT_NE(answer.answers.find("\"words\": \"It falls\""), std::string::npos) << answer.answers;
}

}  // namespace
}  // namespace cupola::tower_and_stone_test
