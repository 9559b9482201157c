#include "postproc/evaluation/thrust.hpp"

#include <gtest/gtest.h>

#include "postproc/report/answers.hpp"

namespace cupola::thrust_test {
namespace {

/// Stones on two supports, without courses, about an axis or not.
Evaluation stones(Sheet::ThrustLines lines) {
  Evaluation e;
  e.assembly.sheets = {{.name = "blocks", .thrust_lines = lines}};
  e.reactions = {{.block = 0, .outward = 3e3}, {.block = 1, .outward = 4e3}};
  e.summary.status = Status::stable;
  e.summary.weight_N = 14e3;
  return e;
}

// As the range of the thrust, which needs an axis and no courses.
TEST(Thrust, OfStonesWithoutCoursesIsTheSumOverTheSupports) {
  const Evaluation e = stones(Sheet::ThrustLines::radial);
  EXPECT_EQ(outward_thrust(e), 7e3);
  const auto answer = thrust_answer(e);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->value, "7 kN");
  EXPECT_TRUE(
      answer->detail.starts_with("the sum over the supports; 3 kN to 4 kN, depending on the support; "
                                 "0.5 of the weight"))
      << answer->detail;
}

// The stiffness of the joints chose nothing where a limit without a critical value shows a state that
// balances.
TEST(Thrust, OfAStateOfAConicSolverDependsOnNoStiffness) {
  Evaluation e = stones(Sheet::ThrustLines::radial);
  EXPECT_NE(thrust_answer(e)->detail.find("depends on the stiffness"), std::string::npos);
  e.summary.forces_unique = {false, ForcesUnique::kOneOfMany};
  EXPECT_TRUE(
      thrust_answer(e)->detail.ends_with("of one of the admissible states: their range was not computed"))
      << thrust_answer(e)->detail;
}

TEST(Thrust, NeedsAnAxis) {
  EXPECT_FALSE(outward_thrust(stones(Sheet::ThrustLines::none)));
  Evaluation e = stones(Sheet::ThrustLines::none);
  e.assembly.sheets.clear();
  EXPECT_FALSE(outward_thrust(e));
}

}  // namespace
}  // namespace cupola::thrust_test
