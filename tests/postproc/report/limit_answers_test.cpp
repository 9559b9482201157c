// Answers of limits, and of searches that find no critical value.
#include <gtest/gtest.h>

#include "postproc/evaluation/margin.hpp"
#include "postproc/report/answers.hpp"
#include "postproc/report/first_screen.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::limit_answers_test {
namespace {

// The words are those of the record; without a found value or word nothing counts.
TEST(LimitAnswers, TheMarginSaysWhatWasSoughtAndFound) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.summary.analysis = AnalysisType::limit;
  const std::string both = "the structure stands at both ends of the bracket";
  e.summary.sought = Sought{"critical acceleration", "no limit from 0 to 0.02", both, "widen it", ""};
  EXPECT_EQ(margin_answer(e).name, "Critical acceleration");
  EXPECT_EQ(margin_answer(e).value, "no limit from 0 to 0.02");
  EXPECT_EQ(margin_answer(e).detail(), both + "; widen it");
  e.summary.sought->found = "";
  e.summary.sought->also = "the case itself stands";
  EXPECT_EQ(margin_answer(e).value, "unknown");
  EXPECT_EQ(margin_answer(e).detail(), both + "; widen it; the case itself stands");
}

// Summaries of earlier versions have no record.
TEST(LimitAnswers, WithoutARecordTheMessageSaysWhatWasFound) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.summary.analysis = AnalysisType::limit;
  e.summary.message = "friction: no limit above 0.15: the structure stands at every value from 0.15 to 0.9";
  for (const FrameRole role : {FrameRole::equilibrium, FrameRole::mechanism, FrameRole::unconverged}) {
    e.last.frame.role = role;
    EXPECT_EQ(margin_answer(e).name, "Margin");
    EXPECT_EQ(margin_answer(e).value, "unknown");
    EXPECT_EQ(margin_answer(e).detail(), e.summary.message);
  }
}

// A search for accelerations says what it found: none that moves it, none that it bears, or nothing.
TEST(LimitAnswers, ASearchForAccelerationsSaysWhatItFound) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.scene.analysis.robustness = 8;
  e.summary.sought =
      Sought{"horizontal acceleration", "no limit", "no horizontal acceleration makes it move", "", ""};
  EXPECT_EQ(margin_answer(e).name, "Horizontal acceleration");
  EXPECT_EQ(margin_answer(e).value, "no limit");
  EXPECT_EQ(margin_answer(e).detail(), "no horizontal acceleration makes it move");
  e.summary.sought->found = "";
  e.summary.robustness = Robustness{8, 0.0, 1e-8, 45.0};
  EXPECT_EQ(margin_answer(e).value, "0 g");
  EXPECT_EQ(margin_answer(e).detail(), "any push towards 45 degrees makes it move");
  e.summary.robustness = Robustness{8, 0.156, 0.1561, 90.0};
  EXPECT_EQ(margin_answer(e).detail(), "borne in the weakest of 8 directions, towards 90 degrees");
  e.summary.robustness->directions = 7;
  EXPECT_EQ(
      margin_answer(e).detail(),
      "borne in the weakest of 7 directions, towards 90 degrees; 1 of 8 is undecided and may be weaker");
  e.summary.robustness.reset();
  e.summary.sought.reset();
  e.summary.parts = {{1, 2, Status::stable}, {3, 1, Status::moving}};
  EXPECT_EQ(margin_answer(e).value, "not computed") << "of what stands in part";
  EXPECT_EQ(margin_answer(e).detail(), "not all parts stand");
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
  EXPECT_EQ(margin.detail(), "no equilibrium exists");
}

Evaluation limit_of(LimitSearch::Parameter parameter, double low, double stable, double moving) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.summary.analysis = AnalysisType::limit;
  e.scene.analysis.limit.parameter = parameter;
  e.scene.analysis.limit.low = low;
  e.scene.analysis.limit.high = 10.0;
  e.summary.critical = CriticalValue{to_string(parameter), stable, stable, moving};
  return e;
}

// A corbel under a counterweight: it moves when its loads fall below half, and never when they grow.
TEST(LimitAnswers, LoadsThatHoldItUpAreNeeded) {
  const Evaluation e = limit_of(LimitSearch::Parameter::load, 0.0, 0.5, 0.49999);
  EXPECT_EQ(verdict_words(e).words, "It stands");
  const std::string reason = reason_for_verdict(e);
  EXPECT_NE(reason.find(", 2 times what it needs: it stands down to 0.5"), std::string::npos) << reason;
  EXPECT_NE(margin_answer(e).detail().find("2 times what it needs"), std::string::npos)
      << margin_answer(e).detail();
  const Evaluation short_of_it = limit_of(LimitSearch::Parameter::load, 0.0, 5.0, 4.9999);
  EXPECT_EQ(verdict_words(short_of_it).words, "It falls");
  EXPECT_EQ(reason_for_verdict(short_of_it).find("bears only"), std::string::npos);
}

TEST(LimitAnswers, NoFactorLeadsFromAPushToAPull) {
  EXPECT_FALSE(factor_of_safety(limit_of(LimitSearch::Parameter::load, -100.0, -20.0, -20.001).scene,
                                limit_of(LimitSearch::Parameter::load, -100.0, -20.0, -20.001).summary));
}

// The case moves its supports by once what it gives.
TEST(LimitAnswers, SupportsThatSpreadFurtherThanTheCriticalFactorAreItsFall) {
  const Evaluation e = limit_of(LimitSearch::Parameter::spread, 0.0, 0.625, 0.6254);
  EXPECT_EQ(verdict_words(e).words, "It falls");
  EXPECT_NEAR(factor_of_safety(e.scene, e.summary).value(), 0.625, 1e-15);
}

// A limit that varies the friction of some joints is none of the others, nor of the case.
TEST(LimitAnswers, NamesTheJointsWhoseFrictionItVaries) {
  Evaluation e = limit_of(LimitSearch::Parameter::friction, 0.0, 0.2, 0.2 - 1e-9);
  e.scene.joints.friction = 0.6;
  e.scene.analysis.limit.joints = RingJoints{1, 1, RingJoints::Sort::laid_bed, {}};
  EXPECT_EQ(verdict_words(e).words, "Limit found");
  EXPECT_EQ(margin_answer(e).name, "Critical friction of the laid bed joints of course 1");
  EXPECT_TRUE(reason_for_verdict(e).ends_with(
      " It is the friction of the laid bed joints of course 1 alone; the others keep theirs."))
      << reason_for_verdict(e);
  EXPECT_NE(certain_sentence(e).find("a coefficient of friction of 0.6 of the other joints"),
            std::string::npos)
      << certain_sentence(e);
}

// Joints that pull may bear less with more friction: a block on a slope that two values hold falls beyond the
// upper one, of which a search that finds the lower one knows nothing.
TEST(LimitAnswers, FrictionOfJointsThatBearTensionIsNoVerdict) {
  Evaluation e = limit_of(LimitSearch::Parameter::friction, 0.0, 0.3, 0.2999);
  e.scene.joints.friction = 0.9;
  EXPECT_EQ(verdict_words(e).words, "It stands");
  e.scene.joints.strength.cohesion = 2e4;
  EXPECT_EQ(verdict_words(e).words, "It stands") << "cohesion alone bears no tension";
  e.scene.joints.head.emplace().tension = 1.5e4;
  EXPECT_EQ(verdict_words(e).words, "Limit found");
  EXPECT_FALSE(factor_of_safety(e.scene, e.summary));
}

// A block on a floor without friction: its bracket has no relative width, and nothing is less than 0 g.
TEST(LimitAnswers, ALimitAtZeroHasTheWidthThatWasReached) {
  Evaluation e = limit_of(LimitSearch::Parameter::acceleration, 0.0, 0.0, 5e-10);
  e.summary.accuracy.reached = 1.25e-12;
  EXPECT_TRUE(
      how_sure(e).starts_with("The structure stands at one end of a bracket of relative width 1.2e-12 "))
      << how_sure(e);
  EXPECT_NE(certain_sentence(e).find("slide without opening. Assumed"), std::string::npos)
      << certain_sentence(e);
}

// Loads that a structure needs can also be too large.
TEST(LimitAnswers, ALeastLoadNamesTheLargestOneToo) {
  Evaluation e = limit_of(LimitSearch::Parameter::load, 0.0, 0.0366, 0.0365);
  e.summary.sought =
      Sought{"critical load", "", "an admissible state at 0.0366", "", "it moves again beyond 1.2418"};
  EXPECT_NE((margin_answer(e).detail() + ";").find("; it moves again beyond 1.2418;"), std::string::npos)
      << margin_answer(e).detail();
}

// Forces that do not balance at one end of the bracket decide nothing.
TEST(LimitAnswers, WhatStandsBetweenTwoValuesOnlyHasBoth) {
  Evaluation e = limit_of(LimitSearch::Parameter::acceleration, 0.0, 0.3, 0.4);
  e.summary.critical.reset();
  e.summary.status = Status::moving;
  e.last.frame.role = FrameRole::mechanism;
  e.summary.sought =
      Sought{"critical acceleration", "not found", "the structure moves at both ends of the bracket, 0 and 1",
             "", "it stands from 0.3333 up to 0.6667"};
  EXPECT_EQ(margin_answer(e).value, "not found");
  EXPECT_TRUE(margin_answer(e).detail().ends_with("0 and 1; it stands from 0.3333 up to 0.6667"))
      << margin_answer(e).detail();
}

TEST(LimitAnswers, AThicknessThatMissedItsWidthIsUndecided) {
  Evaluation e = limit_of(LimitSearch::Parameter::thickness, 0.1, 0.36, 0.35);
  EXPECT_EQ(verdict_words(e).words, "Limit found");
  e.summary.status = Status::bracketed;
  EXPECT_EQ(verdict_words(e).words, "Undecided") << "as the summary and the console say";
}

TEST(LimitAnswers, AnUndecidedLimitIsNoMargin) {
  Evaluation e = limit_of(LimitSearch::Parameter::joint_extent, 0.0, 0.055, 0.054);
  e.summary.status = Status::unconverged;
  e.summary.sought =
      Sought{"critical joint extent", "", "forces that do not balance the loads at 0.055", "", ""};
  EXPECT_FALSE(factor_of_safety(e.scene, e.summary));
  EXPECT_EQ(verdict_words(e).words, "Undecided");
  EXPECT_EQ(margin_answer(e).name, "Critical joint extent");
  EXPECT_EQ(margin_answer(e).value, "unknown");
  EXPECT_EQ(margin_answer(e).detail(), "forces that do not balance the loads at 0.055");
  EXPECT_EQ(reason_for_verdict(e).find("shrink"), std::string::npos) << reason_for_verdict(e);
  EXPECT_TRUE(certain_sentence(e).starts_with("Nothing is certain")) << certain_sentence(e);
}

// No state of joints that bear less than the least peak stress balances the loads.
TEST(LimitAnswers, AStressBeyondTheCompressiveStrengthIsItsFall) {
  Evaluation e = limit_of(LimitSearch::Parameter::peak_stress, 0.0, 1.7208e5, 1.7207e5);
  EXPECT_EQ(verdict_words(e).words, "It stands") << "strength without limit";
  EXPECT_EQ(margin_answer(e).name, "Least peak stress");
  EXPECT_NE(margin_answer(e).detail().find("no forces that balance the loads have less"), std::string::npos);
  EXPECT_NE(certain_sentence(e).find("it may need a higher peak stress"), std::string::npos);
  e.scene.joints.strength.compression = 1.6e5;
  EXPECT_EQ(verdict_words(e).words, "It falls");
  EXPECT_TRUE(reason_for_verdict(e).starts_with(
      "The case has a compressive strength of 1.6e+05 Pa, 0.93 times what it needs: it stands down to"))
      << reason_for_verdict(e);
  e.scene.joints.strength.compression = 2e5;
  EXPECT_EQ(verdict_words(e).words, "It stands");
  e.scene.joints.bed.emplace().compressive_strength = 1e5;
  EXPECT_EQ(verdict_words(e).words, "Limit found") << "some joints bear it, and some do not";
}

}  // namespace
}  // namespace cupola::limit_answers_test
