// Every row of the table of extreme scenes is a test. The slow ones carry the label `slow`.

#include <cctype>

#include <gtest/gtest.h>

#include "tests/extremes/extreme_scene.hpp"
#include "tests/extremes/known_verdicts.hpp"
#include "tests/extremes/random_scene.hpp"

namespace cupola::extremes_test {
namespace {

std::vector<ExtremeScene> rows(bool slow) {
  std::vector<ExtremeScene> chosen;
  for (const ExtremeScene& scene : extreme_scenes())
    if (scene.slow == slow) chosen.push_back(scene);
  return chosen;
}

std::string test_name(const ExtremeScene& scene) {
  std::string name;
  for (const char c : scene.group + "_" + scene.name)
    name += std::isalnum(static_cast<unsigned char>(c)) ? c : c == '-' ? 'm' : '_';
  return name;
}

void expect_truth(const ExtremeScene& scene) {
  const ExtremeResult result = run_extreme(scene);
  EXPECT_LE(result.verdict, known_verdict(scene.group, scene.name)) << result.reason << "\n"
                                                                    << result.message;
}

class ExtremeRow : public ::testing::TestWithParam<ExtremeScene> {};
class ExtremeRowSlow : public ::testing::TestWithParam<ExtremeScene> {};

TEST_P(ExtremeRow, IsRightOrReportedAsNotSolved) {
  expect_truth(GetParam());
}
TEST_P(ExtremeRowSlow, IsRightOrReportedAsNotSolved) {
  expect_truth(GetParam());
}

// Rigid towers whose weight acts inside all beds. They creep by the errors of their contacts from iteration to
// iteration, which was presented as a motion (found by `make -f Makefile.cases extremes-search`).
TEST(RandomTower, IsNotPresentedAsMovingWhereItStands) {
  for (const std::uint64_t seed : {1022, 1040, 1088, 1211}) {
    const ExtremeScene row = random_tower_row(seed, FrictionLaw::coulomb);
    ASSERT_EQ(row.correct, std::vector{Ending::stable});
    const ExtremeResult result = run_extreme(row);
    EXPECT_NE(result.verdict, Verdict::wrong) << row.name << ": " << result.message;
  }
}

INSTANTIATE_TEST_SUITE_P(Extremes, ExtremeRow, ::testing::ValuesIn(rows(false)),
                         [](const auto& row) { return test_name(row.param); });
INSTANTIATE_TEST_SUITE_P(Extremes, ExtremeRowSlow, ::testing::ValuesIn(rows(true)),
                         [](const auto& row) { return test_name(row.param); });

}  // namespace
}  // namespace cupola::extremes_test

namespace cupola {
/// Prints a row in the messages of GoogleTest.
void PrintTo(const ExtremeScene& scene, std::ostream* out) {
  *out << scene.group << ", " << scene.name;
}
}  // namespace cupola
