#include "solver/analysis/construction/least_search.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

// The search for the least value with which structures stand, on structures whose answer is given.

namespace cupola::least_search_test {
namespace {

/// A structure that needs `needed` and whose solves do not converge between two values.
TryValue needs(double needed, double from, double to, int* solves = nullptr) {
  return [=](double value) -> std::optional<LimitTrial> {
    if (solves) ++*solves;
    if (value > from && value < to) return LimitTrial{value, StaticOutcome::unconverged, 0.0};
    return LimitTrial{value, value >= needed ? StaticOutcome::equilibrium : StaticOutcome::moving, 0.0};
  };
}

TEST(LeastSearch, StartsFromTheLastBracket) {
  LeastSearch search(1000.0, 1e6, {0.01, 1.0});
  int solves = 0;
  LeastSearch::Result result = search.find(needs(437.0, 0, 0, &solves));
  EXPECT_TRUE(result.bracket.narrow);
  EXPECT_GE(result.bracket.stable.value, 437.0);
  EXPECT_LT(result.bracket.moving.value, 437.0);
  EXPECT_LE(result.bracket.stable.value - result.bracket.moving.value, 4.4);
  solves = 0;
  result = search.find(needs(437.0, 0, 0, &solves));
  EXPECT_TRUE(result.bracket.narrow);
  EXPECT_EQ(solves, 2);
  EXPECT_TRUE(search.find(needs(0.0, 0, 0)).needs_none);
  EXPECT_FALSE(search.find(needs(1e7, 0, 0)).bracket.found) << "nothing up to 1e6 holds it";
}

// A solve that does not converge is never an end of the bracket.
TEST(LeastSearch, UnconvergedIsNotAVerdict) {
  LeastSearch::Result result = LeastSearch(1000.0, 1e6, {0.01, 1.0}).find(needs(437.0, 400.0, 500.0));
  ASSERT_TRUE(result.bracket.found);
  EXPECT_FALSE(result.bracket.narrow);
  EXPECT_GE(result.bracket.stable.value, 500.0);
  EXPECT_LE(result.bracket.moving.value, 400.0);
  result = LeastSearch(1000.0, 1e6, {0.01, 1.0}).find(needs(437.0, -1.0, 1e7));
  EXPECT_FALSE(result.needs_none);
  EXPECT_FALSE(result.bracket.found);
}

// If the solve at zero does not converge, the least value is at most that at which the structure stands.
TEST(LeastSearch, KeepsWhatStandsWhereNothingMoves) {
  LeastSearch search(1000.0, 1e6, {0.01, 1.0});
  ASSERT_TRUE(search.find(needs(437.0, 0, 0)).bracket.found);
  const double moved = search.last()->second;
  const LeastSearch::Result result = search.find(needs(0.0, -1.0, 100.0));
  EXPECT_FALSE(result.bracket.found);
  EXPECT_EQ(result.bracket.stable.outcome, StaticOutcome::equilibrium);
  EXPECT_EQ(result.bracket.stable.value, moved);
}

// A structure that more of the property lets fall: it stands from 0.05 to 0.35 only.
TEST(LeastSearch, FindsWhatStandsBelowWhatMoves) {
  const TryValue solve = [](double value) -> std::optional<LimitTrial> {
    const bool stands = value >= 0.05 && value <= 0.35;
    return LimitTrial{value, stands ? StaticOutcome::equilibrium : StaticOutcome::moving, 0.0};
  };
  for (const double first : {0.01, 0.2, 0.6, 20.0}) {
    LeastSearch search(first, 10.0, {0.01, 1e-4}, LeastSearch::MoreBears::less_at_times);
    for (int stage = 0; stage < 2; ++stage) {
      const LeastSearch::Result result = search.find(solve);
      ASSERT_TRUE(result.bracket.found) << first << ": " << result.bracket.sought.reason;
      EXPECT_GE(result.bracket.stable.value, 0.05);
      EXPECT_LT(result.bracket.moving.value, 0.05);
    }
  }
  LeastSearch search(0.6, 10.0, {0.01, 1e-4}, LeastSearch::MoreBears::less_at_times);
  const LeastSearch::Result nowhere = search.find(needs(1e7, 0, 0));
  EXPECT_FALSE(nowhere.bracket.found);
  EXPECT_NE(nowhere.bracket.moving.outcome, StaticOutcome::moving)
      << "which would prove that nothing holds it";
}

}  // namespace
}  // namespace cupola::least_search_test
