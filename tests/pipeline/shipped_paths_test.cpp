// How the paths of shipped cases end.

#include "tests/pipeline/program_run.hpp"

namespace cupola::shipped_paths_test {
namespace {

// The last step, however short, leads too far to be an equilibrium, and there is none where it leads to: the
// arch falls. What is proven of that geometry, which the arch may not reach, is not proven of the arch.
TEST(ShippedPaths, ThePushedArchFalls) {
  const ProgramFolder folder;
  const std::string path = CUPOLA_SOURCE_DIR "/cases/arch_pushed.yaml";
  ASSERT_EQ(folder.run("cupola-generate " + path + " --output a.vtu --quiet").code, 0);
  const ProgramRun run = folder.run("cupola-solve " + path + " --assembly a.vtu --output results");
  EXPECT_NE(run.out.find("the path ends at 1.87"), std::string::npos) << run.out;
  EXPECT_NE(slurp(folder.file("results/summary.json")).find("\"status\": \"moving_unproven\""),
            std::string::npos)
      << run.out;
}

}  // namespace
}  // namespace cupola::shipped_paths_test
