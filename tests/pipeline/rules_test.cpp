// Makefile.run, the rules by which `cupola run` calls the programs.

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

}  // namespace
}  // namespace cupola::rules_test
