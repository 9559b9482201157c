// The report of a range analysis: sentences generated from the values, in the place that leads.

#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/files/atomic_file.hpp"
#include "postproc/report/ranges.hpp"
#include "postproc/report/report.hpp"
#include "tests/postproc/analysed_column.hpp"
#include "tests/postproc/ranges.hpp"

namespace cupola::range_report_test {
namespace {

TEST(RangeSentence, StatesCertainLimitsAndTheChosenValue) {
  const std::vector<ForceRange> ranges = test::some_ranges();
  EXPECT_EQ(
      range_sentence(ranges[0]),
      "The outward thrust lies between 12.1 and 40 MN for every history of the building that the friction "
      "admits; the compliances of this case choose 20 MN.");
  EXPECT_EQ(
      range_sentence(ranges[1]),
      "The hoop force of ring 1 is at least -0.3 MN for every history of the building that the friction "
      "admits; it has no maximum: self-stresses that need no load, as in a jammed wedge, raise it without "
      "limit; the compliances of this case choose 0.1 MN.");
  EXPECT_EQ(range_sentence(ranges[2]),
            "The share of the ribs lies between 0 and 1 for every history of the building that the friction "
            "admits; the compliances of this case choose 0.43.")
      << "rounding errors are no limits";
}

// What is certain is the bound, where it differs from the value attained; what did not converge is no limit.
TEST(RangeSentence, NamesUnconvergedEndsAndLooseBounds) {
  EXPECT_EQ(
      range_sentence(test::some_ranges()[3]),
      "The normal force of joint 2-3 is at most 4.8 kN for every history of the building that the friction "
      "admits; it has an unknown minimum, because the search did not converge beyond a state with 0.15 kN; "
      "it attains 4 kN in the state found for the maximum.");
}

TEST(RangeSentence, UnboundedAndUnknownQuantities) {
  ForceRange range{"ratio of rib over mid-sail",
                   "",
                   test::bounded_end(0.0, 0.0, 1),
                   {RangeOutcome::unbounded, {}, {}, {}},
                   {}};
  EXPECT_EQ(range_sentence(range),
            "The ratio of rib over mid-sail is at least 0 for every history of the building that the "
            "friction admits; "
            "it has no maximum: states in which its denominator vanishes raise it without limit.");
  range.unit = "N";
  range.min = {};
  EXPECT_EQ(
      range_sentence(range),
      "The ratio of rib over mid-sail has an unknown minimum, because the search did not converge; it has no "
      "maximum: self-stresses that need no load, as in a jammed wedge, raise it without limit.");
}

TEST(RangeSentence, ANarrowRangeIsOneCertainValue) {
  ForceRange range{"vertical reaction of block 5", "N", test::bounded_end(99.99e3, 99.99e3, 1),
                   test::bounded_end(100.01e3, 100.01e3, 2), 100e3};
  EXPECT_EQ(range_sentence(range),
            "The vertical reaction of block 5 is 0.1 MN for every history of the building that the friction "
            "admits, to within 0.1 %; the compliances of this case choose 0.1 MN.");
  range.chosen = 130e3;
  EXPECT_NE(range_sentence(range).find("choose 0.13 MN, outside the range"), std::string::npos);
}

TEST(RangeReport, LeadsWithTheRangesAndSaysWhatIsCertainChosenAndAssumed) {
  const Assembly a = test::column(3);
  const std::string post = test::analysed_column("range", test::range_frames(a), test::range_summary(a));
  const std::string html = read_text(post + "/report.html");
  const size_t ranges = html.find("<h2>Ranges over all admissible states</h2>");
  ASSERT_NE(ranges, std::string::npos);
  EXPECT_EQ(html.find("<h2>"), ranges) << "the first section";
  EXPECT_NE(html.find("Forces exist that balance the loads within the joint laws."), std::string::npos);
  EXPECT_EQ(html.find("The structure is at rest"), std::string::npos);
  for (const char* said :
       {"lies between 12.1 and 40 MN", "The limits are certain", "The chosen value belongs to one state",
        "their loads and a coefficient of friction of 0.4 are assumed", "up to 1000 times",
        "It does not mean that the history", "under Coulomb&#39;s law they may still fall",
        "<h2>Findings in the chosen state</h2>", "<td class=\"text\">∞</td>",
        "the one that the compliances choose"})
    EXPECT_NE(html.find(said), std::string::npos) << said;
  const size_t picture = html.find("<img alt=\"Ranges over all admissible states\"");
  if (std::filesystem::exists(post + "/figures/ranges.svg")) {
    EXPECT_LT(picture, html.find("<h2>", ranges + 1));
    EXPECT_EQ(html.find("<img alt=\"Ranges over all admissible states\"", picture + 1), std::string::npos)
        << "once";
  }
  EXPECT_NE(read_text(post + "/ranges.csv").find("hoop force of ring 1,N,-300000,100000,inf"),
            std::string::npos);
}

TEST(RangeReport, AssumesTheFrictionOfAllJoints) {
  const Assembly a = test::column(3);
  Case scene = test::column_case();
  scene.joints.friction = 0.7;
  scene.joints.base.emplace().friction = 0.4;
  const Evaluation e = test::evaluated(a, test::range_frames(a), test::range_summary(a), scene,
                                       test::fresh_folder("range_frictions"));
  const std::string assumed = range_conditions(e).front();
  EXPECT_NE(assumed.find("coefficients of friction of 0.4 to 0.7 are assumed"), std::string::npos) << assumed;
}

TEST(RangeReport, AJointThatTheModelDoesNotHaveIsAnError) {
  const Assembly a = test::column(3);
  Summary summary = test::range_summary(a);
  summary.ranges.back().joint = std::pair{2, 4};
  try {
    test::analysed_column("range_joint", test::range_frames(a), summary);
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("a range of joint 2-4, and the assembly 4 blocks"),
              std::string::npos)
        << error.what();
  }
}

TEST(RangeReport, WithoutACompliantStateNothingIsChosen) {
  const Assembly a = test::column(3);
  Summary summary = test::range_summary(a);
  for (ForceRange& range : summary.ranges) range.chosen.reset();
  const std::string html =
      read_text(test::analysed_column("range", test::range_frames(a), summary) + "/report.html");
  EXPECT_EQ(html.find("The chosen value"), std::string::npos);
  EXPECT_EQ(html.find("compliances of this case choose"), std::string::npos);
  EXPECT_NE(html.find("<h2>Findings in one admissible state</h2>"), std::string::npos);
}

// Without an admissible state there is a mechanism, as after a static analysis, and no range.
TEST(RangeReport, ShowsTheMechanismWhereNoStateIsAdmissible) {
  const Assembly a = test::column(3);
  const auto [summary, frame] = test::moving_range_run(a);
  const std::string post = test::analysed_column("range", {frame}, summary);
  const std::string html = read_text(post + "/report.html");
  EXPECT_NE(html.find("The structure moves: no forces balance the loads within the joint laws."),
            std::string::npos);
  EXPECT_NE(
      html.find(
          "<strong>1 of 3</strong><small>faster than a tenth of the fastest</small><small>they form 1 body"),
      std::string::npos);
  EXPECT_EQ(html.find("<h2>Ranges"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(post + "/ranges.csv"));
}

TEST(LimitReport, APeakStressIsNotAPlaceWhereTheStructureMoves) {
  Summary summary;
  summary.critical = CriticalValue{"peak_stress", 2e5, 2.001e5, 1.999e5};
  EXPECT_EQ(verdict_text(summary, FrameRole::equilibrium).find("moves"), std::string::npos);
  EXPECT_NE(verdict_text(summary, FrameRole::equilibrium).find("no stress exceeds 2.001e+05 Pa"),
            std::string::npos);
  summary.critical->parameter = "lantern";
  EXPECT_NE(
      verdict_text(summary, FrameRole::equilibrium).find("a lantern of 2.001e+05 times the weight and moves"),
      std::string::npos);
}

TEST(RangeReport, ExplainsTheStatusOnlyWhereItApplies) {
  Evaluation e;
  e.summary.ranges = test::some_ranges();
  const auto explained = [&e](Status status) {
    e.summary.status = status;
    return ranges_section(e, "").find("That it stands means") != std::string::npos;
  };
  EXPECT_TRUE(explained(Status::stable));
  EXPECT_FALSE(explained(Status::unconverged));
}

TEST(RangeReport, ManyQuantitiesAreLeftToTheTable) {
  Evaluation e;
  e.summary.ranges.assign(31, test::some_ranges()[0]);
  const std::string html = ranges_section(e, "");
  EXPECT_NE(html.find("The first 30 of 31 quantities"), std::string::npos);
  EXPECT_EQ(html.find("The first 30 of 30"), std::string::npos);
}

}  // namespace
}  // namespace cupola::range_report_test
