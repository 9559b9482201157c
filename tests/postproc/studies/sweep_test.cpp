// The table of a sweep: finished members with their numbers, missing members with a remark.
#include "postproc/studies/sweep.hpp"

#include <gtest/gtest.h>

#include "tests/assembly/case/case_scratch.hpp"

namespace cupola::sweep_test {
namespace {

TEST(SweepTable, ReportsMissingMembersAndHowFarTheyGot) {
  const ScratchFolder scratch;
  const std::vector<SweptKey> sweep = {{"joints.friction", {"0.1", "0.2", "0.3", "x"}}};
  const auto members = members_of(sweep, "dome");
  scratch.write("dome_friction0.1/results/summary.json",
                R"({"status": "stable", "equilibrium_residual": 1e-9, "max_displacement_m": 0.5})");
  scratch.write("dome_friction0.2/assembly.vtu", "");
  scratch.write("dome_friction0.3/results/checkpoint", "");
  const Table table = sweep_table(sweep, members, scratch.folder());
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(num_missing(table), 3);
  EXPECT_EQ(table.columns[2].key, "status");
  EXPECT_EQ(table.rows[0][2], Table::Cell(std::string("stable")));
  EXPECT_EQ(table.rows[0][5], Table::Cell(0.5));
  EXPECT_EQ(to_display(table.rows[1][3]), "no results: see the output of the run");
  EXPECT_EQ(to_display(table.rows[2][3]), "interrupted: repeat the command to resume");
  EXPECT_EQ(to_display(table.rows[3][3]), "no assembly: see the output of the run");
  EXPECT_EQ(members_text({members[0]}, "dome"), "dome_friction0.1 dome joints.friction=0.1\n");
}

}  // namespace
}  // namespace cupola::sweep_test
