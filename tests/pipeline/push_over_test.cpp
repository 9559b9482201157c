#include <cmath>

#include "assembly/files/atomic_file.hpp"
#include "assembly/files/mesh_file.hpp"
#include "tests/csv_numbers.hpp"
#include "tests/pipeline/program_run.hpp"

namespace cupola::push_over_test {
namespace {

// The dry portal under a force on its lintel. Its piers (0.6 x 3 m, 45 kN) rock about their toes, and carry
// the lintel (50 kN) on their other corners: F = (W_pier + W_lintel) tan(alpha - theta) with tan alpha = 0.6
// / 3, at the displacement 3 sin(theta) + 0.6 (1 - cos(theta)). The force falls from the first moment on.
TEST(PushOver, OfThePortalFollowsItsFallingForce) {
  const ProgramFolder folder;
  write_text_atomically(folder.file("push.yaml"), R"(extends: cupola:portal
loads: {forces: [{block: lintel, point: [0, 0, 3.2], force: [1.0e5, 0, 0], time: {type: ramp}}]}
analysis: {type: path, tolerance: 1e-6, path: {steps: 20, length: 0.5, control: {block: lintel}}}
)");
  ASSERT_EQ(folder.run("cupola-generate push.yaml --output a.vtu").code, 0);
  const ProgramRun solve = folder.run("cupola-solve push.yaml --assembly a.vtu --output results");
  ASSERT_EQ(solve.code, 0) << solve.err;
  const auto rows = test::csv_numbers(slurp(folder.file("results/path.csv")));
  ASSERT_GE(rows.size(), 21U)
      << "a step whose load is too large by its tolerance is proven to move, and halved";
  for (size_t k = 1; k < rows.size(); ++k) {
    double theta = 0.0;  // by Newton's method
    for (int i = 0; i < 20; ++i)
      theta -= (3 * std::sin(theta) + 0.6 * (1 - std::cos(theta)) - rows[k][1]) /
               (3 * std::cos(theta) + 0.6 * std::sin(theta));
    EXPECT_NEAR(rows[k][2], 95e3 * std::tan(std::atan(0.2) - theta), 0.002 * 19e3) << k;
  }

  const ProgramRun post =
      folder.run("cupola-post analyse push.yaml --assembly a.vtu --results results --output post");
  ASSERT_EQ(post.code, 0) << post.err;
  for (const char* pvd : {"results/contacts.pvd", "post/blocks.pvd"}) {
    const auto entries = read_pvd(folder.file(pvd));
    ASSERT_EQ(entries.size(), rows.size()) << pvd;
    for (size_t k = 0; k < entries.size(); ++k) EXPECT_EQ(entries[k].time, k) << "the times fall";
  }
  EXPECT_NE(slurp(folder.file("post/report.html")).find("Equilibria along the path"), std::string::npos);
}

}  // namespace
}  // namespace cupola::push_over_test
