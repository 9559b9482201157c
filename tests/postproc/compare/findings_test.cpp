#include "postproc/compare/findings.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace cupola::findings_test {
namespace {

/// Two runs that differ in every measure.
std::vector<PostSummary> two_runs() {
  PostSummary a;
  a.title = "Running bond";
  a.status = "stable";
  a.mean_cv_pressure = 0.031;
  a.rib_over_mid_sail = 1.05;
  a.largest_friction_use = 0.62;
  a.critical_value = 0.101;
  a.mean_kern_use = 0.21;
  a.thrust_over_weight = 0.11;
  a.weight_N = 2e6;
  a.margin_factor = 4.0;
  a.widest_crack_m = 0.001;
  a.largest_couple_length_m = 0.04;
  a.max_displacement_m = 0.071;
  a.thrust_lines = {{"rib", 0, true, 0.5, 4.0}, {"mid_sail", 0, true, 0.6, 3.0}};
  PostSummary b = a;
  b.title = "Herringbone";
  b.mean_cv_pressure = 0.124;
  b.rib_over_mid_sail = 0.7;
  b.largest_friction_use = 0.93;
  b.critical_value = 0.152;
  b.mean_kern_use = 0.48;
  b.thrust_over_weight = 0.152;
  b.margin_factor = 2.6;
  b.widest_crack_m = 0.003;
  b.largest_couple_length_m = 0.173;
  b.max_displacement_m = 0.085;
  b.thrust_lines = {{"rib", 0, true, 0.5, 1.9}};
  return {a, b};
}

TEST(Findings, EverySentenceGivesTheNumbersAndTheBestRun) {
  const auto runs = two_runs();
  const auto sentences = findings(runs);
  ASSERT_EQ(sentences.size(), measures().size());
  for (size_t i = 0; i < sentences.size(); ++i) {
    const Measure& m = measures()[i];
    for (const PostSummary& run : runs)
      EXPECT_NE(sentences[i].find(fmt::format("{:.4g}", m.scale * *m.value(run))), std::string::npos)
          << sentences[i];
    EXPECT_NE(sentences[i].find(m.superlative + " in A"), std::string::npos) << sentences[i];
  }
  EXPECT_NE(sentences[0].find("by a factor of 4"), std::string::npos) << "0.124 / 0.031";
}

// The state of a limit is not that of its case.
TEST(Findings, StatesOfLimitsCompareOnlyWithTheirLike) {
  auto runs = two_runs();
  const auto of_thrust = [&runs] {
    for (const std::string& sentence : findings(runs))
      if (sentence.starts_with("The outward base thrust is")) return sentence;
    return std::string();
  };
  runs[0].critical_parameter = runs[1].critical_parameter = "friction";
  EXPECT_TRUE(of_thrust().ends_with("lowest in A, by a factor of 1.38, at the critical friction."));
  runs[1].critical_parameter = "acceleration";
  EXPECT_TRUE(of_thrust().ends_with(
      "304 kN in B: of the critical acceleration, the critical friction, which do not compare."))
      << of_thrust();
  runs[1].critical_parameter = "";
  EXPECT_TRUE(of_thrust().ends_with("of the case, the critical friction, which do not compare."));
}

// A factor on the friction is no factor on the load, and 0.1 is a friction where the limit is one of friction.
TEST(Findings, MarginsAndCriticalValuesNameTheirLimit) {
  auto runs = two_runs();
  const auto said = [&runs](const std::string& start) {
    for (const std::string& sentence : findings(runs))
      if (sentence.starts_with(start)) return sentence;
    return std::string();
  };
  runs[0].critical_parameter = runs[1].critical_parameter = "friction";
  EXPECT_EQ(said("The margin"),
            "The margin of the case, as a factor on the friction, is 4 in A, 2.6 in B: largest in A, by a "
            "factor of 1.54.");
  EXPECT_TRUE(said("The critical friction is 0.101 in A, 0.152 in B: lowest in A").size() > 0);
  runs[1].critical_parameter = "load";
  EXPECT_EQ(said("The margin"),
            "The margin of the case, as a factor, is 4 in A, 2.6 in B: of friction, load, which do not "
            "compare.");
}

// What was given explains what was found: it comes first.
TEST(Findings, NameDifferentLawsAndFrictions) {
  auto runs = two_runs();
  runs[0].friction_law = runs[1].friction_law = "associated";
  runs[0].friction = runs[1].friction = 0.4;
  EXPECT_EQ(findings(runs).size(), measures().size());
  runs[1].friction_law = "coulomb";
  runs[1].friction = 0.7;
  EXPECT_EQ(findings(runs)[0], "The friction law is associated in A, coulomb in B.");
  EXPECT_EQ(findings(runs)[1], "The friction of the case is 0.4 in A, 0.7 in B.");
}

TEST(Findings, SaysThatStiffnessDiffersWithTheNumberOfPoints) {
  auto runs = two_runs();
  runs[0].compliance_per = runs[1].compliance_per = "point";
  runs[0].points_per_base_joint = 6.5;
  runs[1].points_per_base_joint = 16.0;
  const std::string phrase = "base joint is 6.5 in A, 16 in B";
  EXPECT_NE(findings(runs).front().find(phrase), std::string::npos) << findings(runs).front();
  runs[1].points_per_base_joint = 6.5;
  EXPECT_EQ(findings(runs).size(), measures().size()) << "equal numbers need no warning";
  runs[1].points_per_base_joint = 16.0;
  runs[0].compliance_per = runs[1].compliance_per = "area";
  EXPECT_EQ(findings(runs).size(), measures().size()) << "per area the number does not matter";
}

TEST(Findings, EverySentenceChangesWhenTheRunsAreSwapped) {
  auto runs = two_runs();
  const auto before = findings(runs);
  std::swap(runs[0], runs[1]);
  const auto after = findings(runs);
  ASSERT_EQ(before.size(), after.size());
  for (size_t i = 0; i < before.size(); ++i) {
    EXPECT_NE(before[i], after[i]);
    EXPECT_NE(after[i].find(measures()[i].superlative + " in B"), std::string::npos) << after[i];
  }
}

TEST(Findings, EqualRunsAreCalledEqual) {
  auto runs = two_runs();
  runs[1] = runs[0];
  for (const std::string& sentence : findings(runs))
    EXPECT_NE(sentence.find("equal to within 0.1 %"), std::string::npos) << sentence;
}

// The summary of a run sets what is below its floor to zero. A ratio to it would mean nothing.
TEST(Findings, ZerosAreNegligible) {
  auto runs = two_runs();
  runs[0].mean_cv_pressure = 0.0;
  const auto has = [](const std::vector<std::string>& sentences, const std::string& part) {
    return std::any_of(sentences.begin(), sentences.end(),
                       [&](const std::string& s) { return s.find(part) != std::string::npos; });
  };
  EXPECT_TRUE(has(findings(runs), "within a ring is negligible in A, 12.4 % in B: most even in A."))
      << findings(runs)[0];
  runs[1].mean_cv_pressure = 0.0;
  EXPECT_TRUE(has(findings(runs), "within a ring is negligible in all runs."));
  runs.push_back(two_runs()[0]);
  EXPECT_TRUE(has(findings(runs), "3.1 % in C: the best two are negligible."));
}

TEST(Findings, SmallDifferencesArePercentagesNotFactorsOfOne) {
  auto runs = two_runs();
  runs[1].max_displacement_m = 1.004 * *runs[0].max_displacement_m;
  const std::string smaller = "smallest in A, by 0.4 %.";
  EXPECT_NE(findings(runs).back().find(smaller), std::string::npos) << findings(runs).back();
  runs[1].max_displacement_m = 1.11 * *runs[0].max_displacement_m;
  EXPECT_NE(findings(runs).back().find("by a factor of 1.11."), std::string::npos) << findings(runs).back();
}

TEST(Findings, RunsThatAreNotStableAreReportedFirst) {
  auto runs = two_runs();
  runs[1].status = "unconverged";
  EXPECT_EQ(findings(runs)[0], "B ended with the status `unconverged`.")
      << "a limit analysis with a wide bracket";
  runs[1].largest_friction_use.reset();
  EXPECT_EQ(findings(runs)[0], "B ended with the status `unconverged`: it has no equilibrium to compare.");
}

TEST(Findings, CriticalValuesHaveTheUnitOfTheirParameter) {
  auto runs = two_runs();
  for (PostSummary& run : runs) run.critical_unit = "degrees";
  const auto sentences = findings(runs);
  EXPECT_TRUE(std::any_of(sentences.begin(), sentences.end(), [](const std::string& s) {
    return s.find("0.101 degrees in A, 0.152 degrees in B") != std::string::npos;
  }));
}

TEST(Findings, LimitsOfDifferentParametersAreNotRanked) {
  auto runs = two_runs();
  runs[0].critical_parameter = "friction";
  runs[1].critical_parameter = "load";
  runs[1].critical_unit = "factor";
  const auto sentences = findings(runs);
  EXPECT_EQ(std::ranges::count(
                sentences,
                "The critical value is 0.101 in A, 0.152 factor in B: of friction, load, which do not "
                "compare."),
            1);
  const Table table = comparison_table(runs);
  EXPECT_EQ(std::ranges::count(table.columns, "critical_value", &Table::Column::key), 1);
}

TEST(Findings, MeasuresThatOnlyOneRunHasAreLeftOut) {
  auto runs = two_runs();
  runs[0].rib_over_mid_sail.reset();
  runs[0].critical_value.reset();
  EXPECT_EQ(findings(runs).size(), measures().size() - 2);
}

TEST(Findings, TheTableHasARowPerRunAndAColumnPerMeasure) {
  const Table table = comparison_table(two_runs());
  ASSERT_EQ(table.rows.size(), 2u);
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  EXPECT_EQ(std::get<std::string>(table.rows[1][1]), "Herringbone");
}

TEST(Findings, ThePlainTableExplainsEveryMeasureThatARunHas) {
  auto runs = two_runs();
  runs[0].mean_cv_pressure = 0.0;
  for (PostSummary& run : runs) run.critical_value.reset();
  const Table table = plain_table(runs);
  ASSERT_EQ(table.columns.size(), 3u);
  EXPECT_EQ(table.columns[2].meaning, "Herringbone");
  ASSERT_EQ(table.rows.size(), measures().size() - 1) << "no run has a critical value";
  EXPECT_EQ(std::get<std::string>(table.rows[0][1]), "negligible");
  EXPECT_EQ(std::get<std::string>(table.rows[0][2]), "12.4 %");
  for (const auto& row : table.rows) EXPECT_GT(std::get<std::string>(row[0]).size(), 20u);
}

TEST(Findings, LabelsAreLettersThenNumbers) {
  const auto labels = run_labels(28);
  EXPECT_EQ(labels[0], "A");
  EXPECT_EQ(labels[25], "Z");
  EXPECT_EQ(labels[26], "run 27");
}

}  // namespace
}  // namespace cupola::findings_test
