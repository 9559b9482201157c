// Ranges in tables, in post/summary.json, in comparisons and in sweeps.

#include <cmath>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "postproc/claims/verdict.hpp"
#include "postproc/compare/findings.hpp"
#include "postproc/compare/range_findings.hpp"
#include "postproc/studies/sweep.hpp"
#include "postproc/tables/post_summary.hpp"
#include "postproc/tables/range_values.hpp"
#include "postproc/tables/result_tables.hpp"
#include "postproc/tables/run_files.hpp"
#include "tests/assembly/case/case_scratch.hpp"
#include "tests/postproc/ranges.hpp"

namespace cupola::range_table_test {
namespace {

/// The head and a first row as cupola-solve writes them.
constexpr const char* kSolved =
    "quantity,unit,min,max,min_bound,max_bound,chosen,min_outcome,max_outcome,min_frame,max_frame,"
    "block_a,block_b\n"
    "thrust,N,12,,11.9,,20,bounded,unbounded,,,,\n";

void expect_equal(const RangeEnd& a, const RangeEnd& b) {
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.bound, b.bound);
  EXPECT_EQ(a.frame, b.frame);
}

void expect_equal(const std::vector<ForceRange>& a, const std::vector<ForceRange>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].quantity, b[i].quantity);
    EXPECT_EQ(a[i].unit, b[i].unit);
    EXPECT_EQ(a[i].chosen, b[i].chosen);
    EXPECT_EQ(a[i].joint, b[i].joint);
    expect_equal(a[i].min, b[i].min);
    expect_equal(a[i].max, b[i].max);
  }
}

Evaluation range_evaluation() {
  const Assembly a = test::column(3);
  return test::evaluated(a, test::range_frames(a), test::range_summary(a), test::column_case(),
                         test::fresh_folder("results"));
}

TEST(RangeTable, ReadsBackUnchangedFromTheTable) {
  const std::vector<ForceRange> ranges = test::some_ranges();
  expect_equal(read_ranges(parse_csv(to_csv(range_table(ranges)), "ranges.csv")), ranges);
}

TEST(RangeTable, ReadsTheTableOfTheSolver) {
  const std::vector<ForceRange> read = read_ranges(parse_csv(kSolved, "ranges.csv"));
  expect_equal(read, {{"thrust",
                       "N",
                       {RangeOutcome::bounded, 12.0, 11.9, {}},
                       {RangeOutcome::unbounded, {}, {}, {}},
                       20.0}});
  EXPECT_EQ(greatest(read[0]), std::numeric_limits<double>::infinity());
  EXPECT_THROW(
      read_ranges(parse_csv("quantity,unit,min,max,min_bound,max_bound,chosen,min_outcome,max_outcome,"
                            "min_frame,max_frame,block_a,block_b\nthrust,N,1,2,1,2,1,found,bounded,,,,\n",
                            "ranges.csv")),
      InputError);
}

TEST(RangeTable, SummaryReadsBackUnchanged) {
  const Evaluation e = range_evaluation();
  const std::string folder = test::fresh_folder("post");
  write_text_atomically(folder + "/summary.json", post_summary_json(e));
  expect_equal(read_post_summary(folder).ranges, e.summary.ranges);
}

// By name in the table, or by place in the summary.
TEST(RangeTable, ClaimsAddressRanges) {
  const ScratchFolder scratch;
  const Evaluation e = range_evaluation();
  scratch.write("dome/results/summary.json", R"({"status": "stable", "message": ""})");
  scratch.write("dome/post/summary.json", post_summary_json(e));
  scratch.write("dome/post/ranges.csv", to_csv(range_table(e.summary.ranges)));
  Claim claim;
  claim.open = true;
  claim.value.runs = {"dome"};
  claim.value.table = "ranges";
  claim.value.column = "max";
  claim.value.where = {{"quantity", "thrust", {}, {}}};
  EXPECT_EQ(evaluate_claims({claim}, scratch.folder())[0].number, 40e6);
  RunFiles run(scratch.file("dome"));
  EXPECT_EQ(run.number("post.ranges.0.max"), 40e6);
  EXPECT_EQ(run.number("post.ranges.2.chosen"), 0.43);
  EXPECT_THROW(run.number("post.ranges.1.max"), InputError) << "it is unbounded";
}

TEST(RangeTable, SweepHasColumnsForEveryQuantityOfItsMembers) {
  const ScratchFolder scratch;
  const std::vector<SweptKey> sweep = {{"joints.friction", {"0.1", "0.2", "0.3"}}};
  std::vector<StudyRun> members;
  for (const SweepMember& member : members_of(sweep, "dome"))
    members.push_back({member.name, "dome", member.settings});
  scratch.write("dome_friction0.2/results/summary.json",
                R"({"status": "stable", "text_files": {"ranges.csv": "0"}})");
  scratch.write("dome_friction0.3/results/summary.json", R"({"status": "moving"})");
  for (const char* friction : {"0.2", "0.3"})  // the last is of an earlier run, which stood
    scratch.write(std::string("dome_friction") + friction + "/results/ranges.csv", kSolved);
  const Table table = sweep_table({"joints.friction"}, members, scratch.folder());
  const size_t n = table.columns.size();
  EXPECT_EQ(table.columns[n - 3].key, "thrust_min_N");
  EXPECT_EQ(table.columns[n - 2].key, "thrust_chosen_N");
  EXPECT_EQ(table.columns[n - 1].key, "thrust_max_N");
  EXPECT_EQ(table.rows[1][n - 3], Table::Cell(12.0));
  EXPECT_EQ(table.rows[1][n - 2], Table::Cell(20.0));
  EXPECT_EQ(to_display(table.rows[1][n - 1]), "∞");
  for (const size_t i : {0u, 2u}) EXPECT_EQ(to_display(table.rows[i][n - 1]), "") << "no ranges";
}

TEST(RangeTable, ColumnsOfOppositeDirectionsHaveNamesOfTheirOwn) {
  std::vector<ForceRange> ranges;
  for (const char* quantity :
       {"reaction of block 0 along (1, 0, 0)", "reaction of block 0 along (-1, 0, 0)",
        "shear of joint 3-4 along (0.5, 0, 1)", "shear of joint 3-4 along (0, 5, 0.1)"})
    ranges.push_back({quantity, "N", {}, {}, {}});
  Table table;
  table.rows.resize(1);
  add_range_columns({ranges}, &table);
  ASSERT_EQ(table.columns.size(), 12u);
  EXPECT_EQ(table.columns[0].key, "reaction_of_block_0_along_1_0_0_min_N");
  EXPECT_EQ(table.columns[3].key, "reaction_of_block_0_along_minus_1_0_0_min_N");
  EXPECT_EQ(table.columns[6].key, "shear_of_joint_3_4_along_0p5_0_1_min_N");
  EXPECT_EQ(table.columns[9].key, "shear_of_joint_3_4_along_0_5_0p1_min_N");
}

TEST(RangeTable, ComparisonNamesTheNarrowestRange) {
  PostSummary a, b, c;
  for (PostSummary* s : {&a, &b, &c}) s->status = "stable";
  a.ranges = {{"thrust", "N", test::bounded_end(1e6, 1e6, 1), test::bounded_end(4e6, 4e6, 2), 2e6}};
  b.ranges = {{"thrust", "N", test::bounded_end(1.5e6, 1.5e6, 1), test::bounded_end(2e6, 2e6, 2), {}},
              {"share of the ribs", "", test::bounded_end(0.2, 0.2, 1), test::bounded_end(0.7, 0.7, 2), 0.3}};
  const std::vector<std::string> said = range_findings({a, b, c}, {"A", "B", "C"});
  ASSERT_EQ(said.size(), 1u) << "one run alone is no comparison";
  EXPECT_EQ(said[0],
            "The range of the outward thrust over all admissible states is 1 to 4 MN in A, 1.5 to 2 MN in B: "
            "narrowest in B.");
  b.ranges[0] = a.ranges[0];
  EXPECT_EQ(range_findings({a, b}, {"A", "B"})[0].find("narrowest"), std::string::npos) << "both are equal";
  b.ranges[0].max = {RangeOutcome::unbounded, {}, {}, 4};
  EXPECT_TRUE(range_findings({a, b}, {"A", "B"})[0].ends_with("1 to ∞ MN in B: narrowest in A."))
      << range_findings({a, b}, {"A", "B"})[0];
  const Table table = comparison_table({a, b, c});
  EXPECT_EQ(table.columns.back().key, "share_of_the_ribs_max");
  EXPECT_EQ(table.rows[1].back(), Table::Cell(0.7));
  EXPECT_TRUE(std::isnan(std::get<double>(table.rows[2].back())));
  const Table plain = plain_table({a, b, c});
  EXPECT_EQ(to_display(plain.rows.back()[2]), "0.2 to 0.7");
  EXPECT_EQ(to_display(plain.rows.back()[1]), "-");
}

}  // namespace
}  // namespace cupola::range_table_test
