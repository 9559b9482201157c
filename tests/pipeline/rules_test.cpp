// Makefile.run, the rules by which `cupola run` calls the programs.

#include <regex>

#include <gtest/gtest.h>

#include "tests/pipeline/program_run.hpp"

namespace cupola::rules_test {
namespace {

/// A motion of hours, which ends only if it is told to.
constexpr const char* kLongMotion = R"(title: a wall that is watched for hours
geometry:
  surface: {type: wall, length: 1, height: 1, thickness: 0.4}
  bond: {type: running, rings: 4, blocks_per_ring: 2, slices_per_block: 2}
material: {unit_weight: 20000}
joints: {friction: 0.6}
analysis: {type: dynamic, duration: 10000, time_step: 0.001}
)";

/// Starts make, ends it by SIGTERM once the solver runs in `results`. Returns whether the solver ends, too.
bool solver_ends_with_make(const ProgramFolder& folder, const std::string& goal, const std::string& results) {
  const std::string make = "make -f " CUPOLA_SOURCE_DIR "/Makefile.run BIN=" CUPOLA_BIN_DIR " " + goal;
  const ProgramRun done = folder.run(
      "bash -c '" + make + " & make=$!; until [ -s " + results +
      "/.lock ]; do kill -0 $make || exit 5; sleep 0.02; done; read -r word solver rest < " + results +
      "/.lock; sleep 0.1; kill -TERM $make; wait $make;"
      "for i in {1..100}; do kill -0 $solver || exit 0; sleep 0.05; done; kill -9 $solver; exit 6'");
  EXPECT_TRUE(done.code == 0 || done.code == 6) << done.out << done.err;
  return done.code == 0;
}

TEST(Rules, EndTheSolverWithMake) {
  const ProgramFolder folder;
  std::ofstream(folder.file("long.yaml")) << kLongMotion;
  EXPECT_TRUE(solver_ends_with_make(folder, "long", "out/long/results"));
}

TEST(Rules, EndTheMembersOfASweepWithMake) {
  const ProgramFolder folder;
  std::ofstream(folder.file("long.yaml"))
      << kLongMotion << "sweep: [{key: joints.friction, values: [0.5, 0.7]}]\n";
  EXPECT_TRUE(solver_ends_with_make(folder, "long", "out/long_friction0.5/results"));
}

/// One block, twice as long as high, on an incline of slope 0.5: gravity leans instead of the ground. It
/// slides where its friction is less.
constexpr const char* kIncline = R"(geometry:
  surface: {type: wall, length: 2, height: 1, thickness: 1}
  bond: {type: stack, rings: 1, blocks_per_ring: 1, slices_per_block: 1}
joints: {compliance: {per: area}}
loads: {gravity: [4, 0, -8]}
)";
constexpr const char* kSweep = "sweep: [{key: joints.friction, values: [0.6, 0.8]}]\n";

/// Cases and studies that are edited between calls of make.
struct EditedFolder : ProgramFolder {
  ProgramRun make(const std::string& goals) const {
    return run("make -k -f " CUPOLA_SOURCE_DIR "/Makefile.run BIN=" CUPOLA_BIN_DIR " POST=--tables " + goals);
  }
  /// Name, value and status of the members of a sweep.
  std::string rows(const std::string& name) const {
    const std::string table = slurp(file("out/" + name + "/sweep.csv"));
    return std::regex_replace(table.substr(table.find('\n') + 1),
                              std::regex("([^,\n]*,[^,\n]*,[^,\n]*),[^\n]*\n"), "$1;");
  }
};

/// How often each program ran, as "generate 2, solve 2, post 2".
std::string stages(const ProgramRun& run) {
  std::string text;
  for (const char* program : {"generate", "solve", "post analyse"}) {
    const std::regex call(std::string("(^|\n)cupola-") + program + " ");
    const auto calls =
        std::distance(std::sregex_iterator(run.out.begin(), run.out.end(), call), std::sregex_iterator());
    text += (text.empty() ? "" : ", ") + std::string(program) + " " + std::to_string(calls);
  }
  return text;
}

// The first call after an edit shows the new verdict: all stages of the members run, once.
TEST(Rules, RunAllStagesOfMembersAfterAnEdit) {
  const EditedFolder folder;
  std::ofstream(folder.file("block.yaml")) << kIncline << kSweep;
  const ProgramRun first = folder.make("block");
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(folder.rows("block"), "block_friction0.6,0.6,stable;block_friction0.8,0.8,stable;");
  const std::string steeper = std::regex_replace(kIncline, std::regex("\\[4, "), "[5.6, ");
  std::ofstream(folder.file("block.yaml")) << steeper << kSweep;
  EXPECT_EQ(stages(folder.make("block")), "generate 2, solve 2, post analyse 2");
  EXPECT_EQ(folder.rows("block"), "block_friction0.6,0.6,moving;block_friction0.8,0.8,stable;");
  EXPECT_EQ(stages(folder.make("block")), "generate 0, solve 0, post analyse 0");
}

// A new value leaves the members that were there as they are.
TEST(Rules, RunOnlyTheMembersThatAreMissing) {
  const EditedFolder folder;
  std::ofstream(folder.file("block.yaml")) << kIncline << kSweep;
  ASSERT_EQ(folder.make("block").code, 0);
  std::ofstream(folder.file("block.yaml"))
      << kIncline << "sweep: [{key: joints.friction, values: [0.6, 0.7, 0.8]}] # one more\n";
  EXPECT_EQ(stages(folder.make("block")), "generate 1, solve 1, post analyse 1");
}

// The name of a member over a component has brackets, in which make sees a pattern. That its checkpoint is
// damaged is what its row says, because repeating the command does not help.
TEST(Rules, ResumeMembersOverAComponent) {
  const EditedFolder folder;
  std::ofstream(folder.file("block.yaml")) << kIncline << "sweep: [{key: 'loads.gravity[0]', values: [4]}]\n";
  ASSERT_EQ(folder.make("block").code, 0);
  const std::string member = "out/block_gravity[0]4/";
  for (const char* stamp : {".solved", ".drawn"}) std::filesystem::remove(folder.file(member + stamp));
  std::ofstream(folder.file(member + "results/checkpoint")) << "damaged";
  const ProgramRun again = folder.make("block");
  EXPECT_NE(again.out.find(" --resume\n"), std::string::npos) << again.out;
  EXPECT_NE(folder.rows("block").find("missing"), std::string::npos);
  EXPECT_EQ(slurp(folder.file("out/block/sweep.csv")).find("interrupted"), std::string::npos);
}

TEST(Rules, RefuseWhatIsNoSlice) {
  const EditedFolder folder;
  std::ofstream(folder.file("block.yaml")) << kIncline << kSweep;
  for (const std::string slice : {"3/2", "0/2", "-1/2", "1.5/2", "/20", "2", "a/b"}) {
    const ProgramRun run = folder.make("block SLICE=" + slice);
    EXPECT_EQ(run.code, 2) << slice;
    EXPECT_NE(run.err.find("SLICE=" + slice + ": give which part"), std::string::npos) << run.err;
  }
  EXPECT_EQ(stages(folder.make("block SLICE=2/2")), "generate 1, solve 1, post analyse 1");
}

TEST(Rules, SayWhyASweepHasNoAssessment) {
  const EditedFolder folder;
  std::ofstream(folder.file("block.yaml")) << kIncline << kSweep;
  const ProgramRun run = folder.make("block_assessment");
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("block_assessment: a case with a `sweep` or an `ensemble` has no study of one case"),
            std::string::npos)
      << run.err;
}

// A member that STRICT=1 refuses has no verdict any more, nor the one of the call before.
TEST(Rules, AMemberThatFailsLosesItsVerdict) {
  const EditedFolder folder;
  std::ofstream(folder.file("block.yaml"))
      << kIncline << "sweep: [{key: joints.friction, values: [0.6, 5]}]\n";
  ASSERT_EQ(folder.make("block").code, 0);
  EXPECT_EQ(folder.rows("block"), "block_friction0.6,0.6,stable;block_friction5,5,stable;");
  EXPECT_NE(folder.make("block STRICT=1").code, 0);
  EXPECT_EQ(folder.rows("block"), "block_friction0.6,0.6,stable;block_friction5,5,missing;");
  EXPECT_NE(slurp(folder.file("out/block/sweep.csv")).find("no assembly: "), std::string::npos);
}

// A case that cannot be read any more takes neither its old numbers nor the other members' runs with it.
TEST(Rules, AMemberWithABrokenCaseLosesItsNumbers) {
  const EditedFolder folder;
  std::filesystem::create_directory(folder.file("studies"));
  std::ofstream(folder.file("studies/both.yaml")) << R"(runs: [{cases: a b, name: "{case}"}]
tables: [{name: weights, columns: [{heading: weight, key: post.weight_N}]}]
)";
  for (const char* name : {"a.yaml", "b.yaml"})
    std::ofstream(folder.file(name)) << kIncline << "material: {unit_weight: 20000}\n";
  ASSERT_EQ(folder.make("both").code, 0);
  std::ofstream(folder.file("a.yaml"), std::ios::app) << "title: [\n";
  std::ofstream(folder.file("b.yaml")) << kIncline << "material: {unit_weight: 10000}\n";
  const ProgramRun broken = folder.make("both");
  EXPECT_NE(broken.err.find("a.yaml:"), std::string::npos) << broken.err;
  EXPECT_EQ(slurp(folder.file("out/both/weights.csv")).find("weight\nnot run\n"), 0u) << broken.err;
  EXPECT_EQ(stages(broken), "generate 2, solve 1, post analyse 1");
}

}  // namespace
}  // namespace cupola::rules_test
