// Every row of the verification manual is a test. The slow ones carry the label `slow`.

#include <cctype>
#include <set>

#include <gtest/gtest.h>

#include "tests/verification/verification_row.hpp"

namespace cupola::verification {
namespace {

/// A row of references.yaml with its problem.
struct Check {
  const Reference* problem;
  const ReferenceRow* row;
};

void PrintTo(const Check& check, std::ostream* out) {
  *out << check.problem->title << ", " << check.row->name();
}

std::vector<Check> checks(bool slow) {
  std::vector<Check> chosen;
  for (const Reference& problem : references())
    for (const ReferenceRow& row : problem.rows)
      if (row.slow == slow) chosen.push_back({&problem, &row});
  return chosen;
}

std::string test_name(const Check& check) {
  std::string name = check.problem->id;
  for (const auto& [key, value] : check.row->parameters) {
    name += '_';
    for (const char c : value)
      name += std::isalnum(static_cast<unsigned char>(c)) ? c : c == '-' ? 'm' : c == '+' ? 'p' : '_';
  }
  return name;
}

/// A row whose failure is explained must fail: its `why` would be wrong otherwise.
void expect_verdict(const Check& check) {
  const RowResult result = run_row(*check.problem, *check.row);
  EXPECT_EQ(result.passed, check.row->why.empty())
      << check.problem->title << ", " << check.row->name() << ": computed " << result.computed << " "
      << result.failure << ", expected " << check.row->expected_text << ", error " << result.error << " ("
      << check.problem->error << "), tolerance " << check.problem->tolerance << " " << check.row->why;
}

class Row : public ::testing::TestWithParam<Check> {};
class RowSlow : public ::testing::TestWithParam<Check> {};

TEST_P(Row, HasItsVerdict) {
  expect_verdict(GetParam());
}
TEST_P(RowSlow, HasItsVerdict) {
  expect_verdict(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Manual, Row, ::testing::ValuesIn(checks(false)),
                         [](const auto& check) { return test_name(check.param); });
INSTANTIATE_TEST_SUITE_P(Manual, RowSlow, ::testing::ValuesIn(checks(true)),
                         [](const auto& check) { return test_name(check.param); });

TEST(References, HaveOneComputationEach) {
  std::set<std::string> problems, computed;
  for (const Reference& problem : references()) problems.insert(problem.id);
  for (const auto& [id, computation] : computations()) computed.insert(id);
  EXPECT_EQ(problems, computed);
}

TEST(References, NameTheirSourceAndReason) {
  for (const Reference& problem : references()) {
    EXPECT_GE(problem.source.size(), 10u) << problem.id;
    EXPECT_GE(problem.reason.size(), 10u) << problem.id;
    EXPECT_TRUE(problem.chapter == "code" || problem.chapter == "solution" || problem.chapter == "validation")
        << problem.id;
  }
}

// An error above the tolerance, no number, and a distance from an interval.
TEST(RunRow, FailsOutsideTheTolerance) {
  Reference problem = reference("unit_cubes");
  ReferenceRow row = problem.rows.front();
  EXPECT_TRUE(run_row(problem, row).passed);
  row.low = row.high = 0.25 + 2 * problem.tolerance;
  EXPECT_FALSE(run_row(problem, row).passed);
  row.low = 0.25 + 2 * problem.tolerance;
  row.high = 0.3;
  EXPECT_FALSE(run_row(problem, row).passed);
  EXPECT_NEAR(run_row(problem, row).error, 2 * problem.tolerance, problem.tolerance);
  row = reference("toppling").rows.front();
  row.parameters.clear();
  problem.id = "toppling";
  EXPECT_FALSE(run_row(problem, row).passed);
  EXPECT_NE(run_row(problem, row).failure, "");
}

}  // namespace
}  // namespace cupola::verification
