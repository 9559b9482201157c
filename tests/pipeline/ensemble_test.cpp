// Ensembles through make: the three programs, what stays of a member, repetition, and slices.
#include <algorithm>
#include <cmath>
#include <regex>

#include "tests/csv_numbers.hpp"
#include "tests/pipeline/program_run.hpp"

namespace cupola::ensemble_pipeline_test {
namespace {

const std::string kMake = "make -f " CUPOLA_SOURCE_DIR "/Makefile.run BIN=" CUPOLA_BIN_DIR " -j2 ";

/// One block, twice as long as high, on an incline of slope 0.5: gravity leans instead of the ground.
constexpr const char* kIncline = R"(geometry:
  surface: {type: wall, length: 2, height: 1, thickness: 1}
  bond: {type: stack, rings: 1, blocks_per_ring: 1, slices_per_block: 1}
joints: {compliance: {per: area}}
loads: {gravity: [4.387, 0, -8.774]}
ensemble:
  members: 12
  keep: KEEP
  vary: [{key: joints.friction, distribution: lognormal, mean: 0.55, deviation: 0.1}]
)";

struct EnsembleFolder : ProgramFolder {
  explicit EnsembleFolder(const std::string& kept = "summary") { keep(kept); }
  void keep(const std::string& kept) const {
    std::ofstream(file("incline.yaml")) << std::regex_replace(kIncline, std::regex("KEEP"), kept);
  }
  std::string table() const { return slurp(file("out/incline/incline.csv")); }
  /// The table without the column of processor times, and every summary without times.
  std::string results() const { return std::regex_replace(table(), std::regex(",[^,\n]*\n"), "\n"); }
};

/// Rows of the table: friction and status.
std::vector<std::pair<double, std::string>> members_of(const std::string& table) {
  std::vector<std::pair<double, std::string>> members;
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::string name, friction, status;
    std::getline(cells, name, ',');
    std::getline(cells, friction, ',');
    std::getline(cells, status, ',');
    members.emplace_back(std::stod(friction), status);
  }
  return members;
}

// Exactly the members with less friction than the slope slide. Only summaries stay, and nothing runs again.
TEST(Ensembles, ABlockOnAnInclineSlidesWhereItsFrictionIsLess) {
  const EnsembleFolder folder;
  const ProgramRun run = folder.run(kMake + "incline");
  ASSERT_EQ(run.code, 0) << run.err;
  const auto members = members_of(folder.table());
  ASSERT_EQ(members.size(), 12u);
  size_t sliding = 0;
  for (const auto& [friction, status] : members) {
    EXPECT_EQ(status, friction < 0.5 ? "moving" : "stable") << friction;
    sliding += friction < 0.5;
  }
  EXPECT_NE(run.out.find("incline: " + std::to_string(sliding) + " of 12 members fall: probability"),
            std::string::npos)
      << run.out;
  EXPECT_TRUE(std::filesystem::exists(folder.file("out/incline/0001/results/summary.json")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/incline/0001/assembly.vtu")));
  for (const auto& [name, hash] : folder.contents()) EXPECT_EQ(name.find(".vtp"), std::string::npos) << name;
  const ProgramRun again = folder.run(kMake + "incline");
  EXPECT_EQ(again.out.find("cupola-solve"), std::string::npos) << again.out;
}

// Members that were lost run again, alone; slices together give the same results as one run.
TEST(Ensembles, LostMembersAndSlicesGiveTheSameResults) {
  const EnsembleFolder folder;
  ASSERT_EQ(folder.run(kMake + "incline").code, 0);
  const std::string first = folder.results();
  std::filesystem::remove_all(folder.file("out/incline/0003"));
  std::filesystem::remove(folder.file("out/incline/0007/.drawn"));
  const ProgramRun again = folder.run(kMake + "incline");
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(std::regex_replace(again.out, std::regex("[^]*?(cupola-solve|$)"), "$1"),
            "cupola-solvecupola-solve");
  EXPECT_EQ(folder.results(), first);
  std::filesystem::remove_all(folder.file("out"));
  for (const char* slice : {"2/3", "1/3"}) {
    const ProgramRun part = folder.run(kMake + "incline SLICE=" + slice);
    EXPECT_EQ(part.code, 0) << part.err;
    EXPECT_FALSE(std::filesystem::exists(folder.file("out/incline/study.html")));
  }
  EXPECT_TRUE(std::filesystem::exists(folder.file("out/incline/0011/.drawn")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/incline/0012/.drawn")));
  ASSERT_EQ(folder.run(kMake + "incline").code, 0);
  EXPECT_EQ(folder.results(), first);
}

// Blocks that members share are cut once, and a member has the bits that it would have alone. A member
// without input ends neither the others nor their batch.
TEST(Ensembles, ABatchGivesTheBitsOfSingleRuns) {
  const EnsembleFolder folder;
  const std::string programs = CUPOLA_BIN_DIR;
  const auto generate = [&](const std::string& name, const std::string& settings) {
    return name + ".stamp - incline.yaml --output " + name + ".vtu " + settings + "\n";
  };
  std::ofstream(folder.file("list")) << generate("a", "--set joints.friction=0.3")
                                     << generate("b", "--set joints.friction=-1")
                                     << generate("c", "--set joints.friction=0.4")
                                     << "d.stamp b.stamp incline.yaml --output d.vtu\n"
                                     << generate("e", "--set geometry.surface.height=0.5");
  const ProgramRun run = folder.run(programs + "/cupola-generate --batch list");
  EXPECT_EQ(run.code, 2) << run.err;
  EXPECT_NE(run.err.find("joints.friction = -1: must be >= 0"), std::string::npos) << run.err;
  for (const char* done : {"a", "c", "e"}) {
    EXPECT_EQ(slurp(folder.file(std::string(done) + ".stamp")), "0\n");
    const std::string settings = *done == 'a'   ? "joints.friction=0.3"
                                 : *done == 'c' ? "joints.friction=0.4"
                                                : "geometry.surface.height=0.5";
    EXPECT_EQ(
        folder.run(programs + "/cupola-generate incline.yaml --output alone.vtu --set " + settings).code, 0);
    EXPECT_EQ(slurp(folder.file("alone.vtu")), slurp(folder.file(std::string(done) + ".vtu"))) << done;
  }
  for (const char* left_out : {"b.stamp", "d.stamp", "d.vtu"})
    EXPECT_FALSE(std::filesystem::exists(folder.file(left_out))) << left_out;
}

TEST(Ensembles, KeepTablesOnRequest) {
  const EnsembleFolder folder("tables");
  ASSERT_EQ(folder.run(kMake + "incline").code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder.file("out/incline/0001/post/blocks.csv")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/incline/0001/assembly.vtu")));
}

// Tables that were left out are computed again; those that are left out from now on go without a run.
TEST(Ensembles, KeepWhatTheLastCallAsksFor) {
  const EnsembleFolder folder;
  const std::string table = folder.file("out/incline/0001/post/blocks.csv");
  bool runs = true;
  for (const char* keep : {"summary", "tables", "summary", "all"}) {
    folder.keep(keep);
    const ProgramRun run = folder.run(kMake + "incline");
    ASSERT_EQ(run.code, 0) << run.err;
    const bool less = keep == std::string("summary");
    EXPECT_EQ(run.out.find("cupola-solve") != std::string::npos, runs) << keep;
    EXPECT_EQ(std::filesystem::exists(table), !less) << keep;
    EXPECT_EQ(std::filesystem::exists(folder.file("out/incline/0001/assembly.vtu")),
              keep == std::string("all"));
    runs = less;
  }
}

// Three courses with a friction of their own on each bed: the wall slides on the weakest, at that
// acceleration (g), before it tips at a slope of 2. The samples come from a file; the direct limit finds the
// value to 1e-6.
TEST(Ensembles, AStackSlidesOnItsWeakestJoint) {
  const ProgramFolder folder;
  std::ofstream(folder.file("stack.yaml")) << R"(geometry:
  surface: {type: wall, length: 3, height: 1.5, thickness: 1}
  bond: {type: stack, rings: 3, blocks_per_ring: 1, slices_per_block: 1}
joints:
  compliance: {per: area}
  rings: [{from: 0, friction: 0.5}, {from: 1, friction: 0.5}, {from: 2, friction: 0.5}]
analysis: {type: limit, limit: {parameter: acceleration, low: 0, high: 3}}
sweep: {file: samples.csv}
)";
  std::ofstream(folder.file("samples.csv"))
      << "joints.rings[0].friction, joints.rings[1].friction, "
         "joints.rings[2].friction\n0.5, 0.4, 0.6\n0.31, 0.4, 0.6\n0.7, 0.8, 0.43\n";
  const ProgramRun run = folder.run(kMake + "stack");
  ASSERT_EQ(run.code, 0) << run.err;
  for (const auto& [name, least] : {std::pair("0001", 0.4), {"0002", 0.31}, {"0003", 0.43}}) {
    const std::string summary =
        slurp(folder.file(std::string("out/stack/") + name + "/results/summary.json"));
    std::smatch value;
    ASSERT_TRUE(std::regex_search(summary, value, std::regex("\"critical_value\": ([0-9.e+-]+)"))) << summary;
    EXPECT_NEAR(std::stod(value[1]), least, 1e-6) << name;
  }
}

}  // namespace
}  // namespace cupola::ensemble_pipeline_test
