// File names that a shell or make would interpret, and cases that name parts which the blocks do not have.

#include <regex>
#include <vector>

#include "tests/pipeline/program_run.hpp"

namespace cupola::hostile_inputs_test {
namespace {

const std::string kMake = "make -f " CUPOLA_SOURCE_DIR "/Makefile.";

/// Names that make, a shell or both would interpret.
const std::vector<std::string> kHostileNames = {"x;touch pwned;y",
                                                "$(shell touch pwned)",
                                                "$(touch pwned)",
                                                "e`touch pwned`",
                                                "a|touch pwned",
                                                "a&touch pwned",
                                                "a>pwned",
                                                "a b",
                                                "q\"z",
                                                "it's",
                                                "c:d",
                                                "#",
                                                "%",
                                                "a\\b",
                                                "-rf",
                                                "*",
                                                "[x]",
                                                "~root",
                                                "new\nline",
                                                "a=b",
                                                "!",
                                                "{x,y}"};

/// A folder with a case of each hostile name and two plain ones.
struct HostileFolder : ProgramFolder {
  HostileFolder() {
    for (const std::string& name : kHostileNames) std::ofstream(file(name + ".yaml")) << "sweep: []\n";
    std::ofstream(file("swept-case_1.yaml")) << "sweep: [{key: joints.friction, values: [0.3, 0.4]}]\n";
    std::ofstream(file("plain.yaml")) << "title: none\n";
  }
};

TEST(HostileInputs, NamesOfCasesRunNoCommand) {
  const HostileFolder folder;
  const ProgramRun run = folder.run(kMake + "cases FOLDER=. help");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("Cases: plain swept-case_1\n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("tabulates them: swept-case_1\n"), std::string::npos) << run.out;
  EXPECT_NE(run.err.find("it's.yaml"), std::string::npos) << "the ignored files are named: " << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("pwned")));
}

TEST(HostileInputs, NoTargetPassesOnHostileNames) {
  const HostileFolder folder;
  // make -n runs lines that contain $(MAKE); python3 would then write tables into the documentation.
  const std::string fake = folder.file("bin/python3");
  std::filesystem::create_directory(folder.file("bin"));
  std::filesystem::create_symlink("/bin/true", fake);
  std::smatch targets;
  const std::string makefile = slurp(CUPOLA_SOURCE_DIR "/Makefile.cases");
  ASSERT_TRUE(std::regex_search(makefile, targets, std::regex("\nTARGETS := (.*)\n")));
  const ProgramRun run = folder.run("PATH=$PWD/bin:$PATH " + kMake +
                                    "cases -nk FOLDER=. all-cases all-variants " + targets.str(1));
  for (const char* part : {"pwned", "it's", "c:d", "q\"z", "new"})
    EXPECT_EQ(run.out.find(std::string(part) + ".yaml"), std::string::npos) << part;
  EXPECT_NE(run.out.find("./plain.yaml"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("pwned")));
}

TEST(HostileInputs, FoldersThatMakeWouldSplitAreRefused) {
  const ProgramFolder folder;
  for (const char* name : {"a b", "q\\\"z", "it's", "c:d", "a\\`b", "a;b", "a#b", "a%b", "a=b"})
    for (const char* variable : {"FOLDER", "OUT", "BIN"}) {
      const ProgramRun run = folder.run(kMake + "run BIN=. \"" + variable + "=" + name + "\" all-cases");
      EXPECT_EQ(run.code, 2) << name;
      EXPECT_NE(run.err.find("the path of this folder may not"), std::string::npos)
          << variable << " " << name << run.err;
    }
  EXPECT_EQ(folder.run(kMake + "run BIN=. FOLDER=. OUT=./é_+-,@9 all-cases").code, 0);
}

constexpr const char* kWall = R"(geometry:
  surface: {type: wall, length: 2, height: 1, thickness: 0.5}
  bond: {type: running, rings: 2, blocks_per_ring: 2, slices_per_block: 2}
joints: {compliance: {per: point}}
)";

TEST(HostileInputs, ACaseRestoredWithAnOlderDateRunsAgain) {
  const ProgramFolder folder;
  const std::string make = kMake + "run BIN=" CUPOLA_BIN_DIR " POST=--tables wall";
  const auto thickness = [&] {
    return slurp(folder.file("out/wall/results/run.yaml")).find("thickness: 0.4") != std::string::npos;
  };
  std::ofstream(folder.file("wall.yaml")) << kWall;
  const auto date = std::filesystem::last_write_time(folder.file("wall.yaml"));
  std::ofstream(folder.file("wall.yaml"))
      << std::regex_replace(kWall, std::regex("thickness: 0.5"), "thickness: 0.4");
  ASSERT_EQ(folder.run(make).code, 0);
  EXPECT_TRUE(thickness());
  std::ofstream(folder.file("wall.yaml")) << kWall;
  std::filesystem::last_write_time(folder.file("wall.yaml"), date - std::chrono::hours(24));
  ASSERT_EQ(folder.run(make).code, 0);
  EXPECT_FALSE(thickness());
  // A new date alone changes nothing.
  std::filesystem::last_write_time(folder.file("wall.yaml"), std::filesystem::file_time_type::clock::now());
  const ProgramRun again = folder.run(make);
  EXPECT_EQ(again.code, 0);
  EXPECT_EQ(again.out.find("cupola-solve"), std::string::npos) << again.out;
}

TEST(HostileInputs, SweepsFinishTheirFirstMembersFirst) {
  const ProgramFolder folder;
  std::ofstream(folder.file("wall.yaml"))
      << kWall << "sweep: [{key: joints.friction, values: [0.3, 0.4, 0.5, 0.6, 0.7, 0.8]}]\n";
  const ProgramRun run = folder.run(kMake + "run -j2 BIN=" CUPOLA_BIN_DIR " POST=--tables wall");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const auto written = [&](const char* friction, const char* stamp) {
    return std::filesystem::last_write_time(folder.file(std::string("out/wall_friction") + friction + stamp));
  };
  EXPECT_LT(written("0.3", "/.drawn"), written("0.8", "/.generated"));
}

// A member without settings of its own is a case: its rules must not be made twice.
TEST(Studies, RunTheCasesThatTheyName) {
  const ProgramFolder folder;
  std::ofstream(folder.file("wall.yaml")) << kWall;
  std::filesystem::create_directory(folder.file("studies"));
  std::ofstream(folder.file("studies/forces.yaml"))
      << "title: Forces\nclaims:\n"
         "  - {source: none, says: The wall has weight., number: mean resultant of a block,\n"
         "     value: {runs: wall, table: blocks, column: resultant_N, take: mean}, ours: {at_least: 1, "
         "reason: in N}}\n";
  const ProgramRun run = folder.run(kMake + "run BIN=" CUPOLA_BIN_DIR " POST=--tables forces");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(std::filesystem::exists(folder.file("out/wall/.drawn"))) << run.out << run.err;
}

TEST(HostileInputs, MeridiansOfBlocksWithoutCoursesAreLeftOut) {
  const ProgramFolder folder;
  std::ofstream(folder.file("two.obj")) << R"(o ground
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
o cube
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
v 0 0 2
v 1 0 2
v 1 1 2
v 0 1 2
f 12 11 10 9
f 13 14 15 16
f 9 10 14 13
f 10 11 15 14
f 11 12 16 15
f 12 9 13 16
)";
  std::ofstream(folder.file("two.yaml")) << "geometry:\n  import: {file: two.obj, supports: [ground]}\n"
                                            "joints: {compliance: {per: area}}\n"
                                            "postproc:\n  meridians: [{name: side, azimuth_deg: 0}]\n";
  const std::string outputs = " --assembly a.vtu ";
  ASSERT_EQ(folder.run("cupola-generate two.yaml --output a.vtu").code, 0);
  ASSERT_EQ(folder.run("cupola-solve two.yaml" + outputs + "--output results").code, 0);
  const ProgramRun post =
      folder.run("cupola-post analyse two.yaml" + outputs + "--results results --output post");
  EXPECT_EQ(post.code, 0) << post.err;
  EXPECT_NE(slurp(folder.file("post/report.html")).find("the blocks have no courses"), std::string::npos);
}

}  // namespace
}  // namespace cupola::hostile_inputs_test
