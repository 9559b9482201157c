// Answers of limits, and of searches that find no critical value.
#include <gtest/gtest.h>

#include "postproc/report/answers.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::limit_answers_test {
namespace {

TEST(LimitAnswers, TheMarginSaysWhatWasLookedForInVain) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.summary.analysis = AnalysisType::limit;
  e.scene.analysis.limit.parameter = LimitSearch::Parameter::acceleration;
  const auto margin = [&](Status status, const std::string& reason) {
    e.summary.status = status;
    e.summary.message = "acceleration: " + reason;
    return margin_answer(e);
  };
  const std::string both = "the structure stands at both ends of the bracket";
  const KeyNumber range = margin(Status::stable, "no limit from 0 to 0.02: " + both + "; widen it");
  EXPECT_EQ(range.name, "Critical acceleration");
  EXPECT_EQ(range.value, "no limit from 0 to 0.02");
  EXPECT_EQ(range.detail, both + "; widen it");
  EXPECT_EQ(margin(Status::stable, "no limit: the structure stands at 0 and at every higher value").value,
            "no limit");
  EXPECT_EQ(margin(Status::stable, both + ", 0.01 and 1; widen the bracket").value, "not found");
  EXPECT_EQ(margin(Status::unconverged, both + ", 0.01 and 1; widen the bracket").value, "unknown");
}

// The assessment of a case that falls does not advise to run an assessment.
TEST(LimitAnswers, NoAccelerationIsLeftToWhatFalls) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.scene.analysis.robustness = 8;
  e.summary.status = Status::moving;
  e.last.frame.role = FrameRole::mechanism;
  const KeyNumber margin = margin_answer(e);
  EXPECT_EQ(margin.name, "Horizontal acceleration");
  EXPECT_EQ(margin.value, "none");
  EXPECT_EQ(margin.detail, "no equilibrium exists");
}

}  // namespace
}  // namespace cupola::limit_answers_test
