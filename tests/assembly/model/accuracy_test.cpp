#include "assembly/model/accuracy.hpp"

#include <gtest/gtest.h>

namespace cupola::accuracy_test {
namespace {

TEST(AccuracySentence, NamesQuantityNormAndTheWorstOfTheRun) {
  const Accuracy accuracy{"critical value", "width of its bracket, relative to the middle", 1e-3, 2e-4, 2e-4};
  EXPECT_EQ(
      to_sentence(accuracy),
      "Error of the critical value: 2.00e-04 reached, 1.00e-03 requested (width of its bracket, relative to "
      "the middle).");
  Accuracy worse = accuracy;
  worse.worst_over_run = 3.5e-3;
  EXPECT_EQ(
      to_sentence(worse),
      "Error of the critical value: 2.00e-04 reached, 1.00e-03 requested, 3.50e-03 at worst over the run "
      "(width of its bracket, relative to the middle).");
}

TEST(AccuracySentence, StatesThatAnErrorWasNotMeasured) {
  EXPECT_EQ(to_sentence(Accuracy{"critical value", "width of its bracket", 1e-3}),
            "Error of the critical value: unknown, 1.00e-03 requested (width of its bracket).");
}

TEST(AccuracySentence, StatesWhatIsBoundedOrWhyNothingIs) {
  EXPECT_EQ(to_sentence(ForceCertificate{1.4e-14, "the distance of the forces from the exact ones"}),
            "Certified to be at most 1.4e-14: the distance of the forces from the exact ones.");
  EXPECT_EQ(to_sentence(ForceCertificate{{}, "some compliance is zero"}),
            "No error bound is certified: some compliance is zero.");
}

TEST(AccuracySentence, StatesWhetherTheForcesAreUnique) {
  EXPECT_EQ(to_sentence(ForcesUnique{true, "every compliance is above zero"}),
            "The forces are unique: every compliance is above zero.");
  EXPECT_EQ(to_sentence(ForcesUnique{false, "some compliance is zero"}),
            "The forces may not be unique: some compliance is zero.");
}

}  // namespace
}  // namespace cupola::accuracy_test
