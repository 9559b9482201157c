// The page of ensembles on handwritten runs.
#include "postproc/studies/ensemble.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "postproc/studies/ensemble_results.hpp"
#include "tests/assembly/case/case_scratch.hpp"

namespace cupola::ensemble_test {
namespace {

/// Two ensembles of eight members: in `b` the widest crack is 0.01 more, and the members 1 to `fallen` fall.
std::vector<SampledRuns> two_ensembles(const ScratchFolder& scratch, double noise, int fallen) {
  std::vector<SampledRuns> ensembles;
  for (const char* name : {"a", "b"}) {
    const Samples samples = draw_samples({8,
                                          1,
                                          Ensemble::Design::monte_carlo,
                                          KeptFiles::summary,
                                          {{"joints.friction", UniformValues{0.2, 0.6}}}});
    ensembles.push_back(
        {name, samples, Ensemble::Design::monte_carlo,
         sampled_runs(samples, KeptFiles::summary, std::string("s/") + name + "_", "dome", {})});
    for (size_t i = 0; i < 8; ++i) {
      const bool falls = *name == 'b' && static_cast<int>(i) < fallen;
      const double crack =
          0.1 * static_cast<double>(i) + (*name == 'b' ? 0.01 + (i % 2 ? noise : -noise) : 0.0);
      const std::string& run = ensembles.back().runs[i].name;
      scratch.write(run + "/results/summary.json",
                    falls ? R"({"status": "moving"})" : R"({"status": "stable"})");
      scratch.write(run + "/post/summary.json", "{\"widest_crack_m\": " + std::to_string(crack) + "}");
    }
  }
  return ensembles;
}

TEST(EnsemblePage, ComparesEnsemblesMemberByMember) {
  const ScratchFolder scratch;
  const std::vector<SampledRuns> ensembles = two_ensembles(scratch, 0.0, 7);
  EXPECT_EQ(ensembles[1].runs[2].name, "s/b_0003");
  EXPECT_EQ(ensembles[1].runs[2].settings.back(), "--keep=summary");
  StudyPage page("Two", scratch.file("page"));
  const std::string text = add_ensembles(ensembles, scratch.folder(), &page);
  page.write();
  EXPECT_NE(
      text.find(
          "a and b: of 8 members with a verdict in both, 0 fall in the first only and 7 in the second only "
          "(exact McNemar test: p = 0.016)"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("a less b: widest_crack_m differs by -0.01 (-0.01 to -0.01)"), std::string::npos)
      << text;
  EXPECT_NE(text.find("b: 7 of 8 members fall: probability 87.5 % (47.3 to 99.7 %)."), std::string::npos)
      << text;
  EXPECT_NE(read_text(scratch.file("page/study.html")).find("<th>Median, 95 % low<"), std::string::npos)
      << "of which number";
  for (const char* file :
       {"a.csv", "b.csv", "a_statistics.csv", "a_inputs.csv", "a_ends.csv", "differences.csv"})
    EXPECT_TRUE(std::filesystem::exists(scratch.file(std::string("page/") + file))) << file;
  EXPECT_NE(read_text(scratch.file("page/differences.csv")).find("a less b,falls,8,0,0.875,-0.875,"),
            std::string::npos);
}

// The widest crack in the state in which a limit analysis ends is no result.
TEST(EnsemblePage, ComparesLimitAnalysesByTheirCriticalValues) {
  const ScratchFolder scratch;
  const std::vector<SampledRuns> ensembles = two_ensembles(scratch, 0.0, 0);
  for (const SampledRuns& ensemble : ensembles)
    for (size_t i = 0; i < 8; ++i)
      scratch.write(ensemble.runs[i].name + "/results/summary.json",
                    "{\"status\": \"stable\", \"critical_value\": " +
                        std::to_string((ensemble.name == "a" ? 2.0 : 1.0) + static_cast<double>(i)) + "}");
  StudyPage page("Two", scratch.file("page"));
  const std::string text = add_ensembles(ensembles, scratch.folder(), &page);
  EXPECT_NE(text.find("a less b: critical_value differs by 1 (1 to 1)."), std::string::npos) << text;
  EXPECT_EQ(text.find("widest_crack_m"), std::string::npos) << text;
  EXPECT_NE(read_text(scratch.file("page/differences.csv")).find("a less b,critical_value,8,5.5,4.5,1,1,1,"),
            std::string::npos);
}

// Five of eight fall throughout their bracket and one stands: their critical values, beyond those found, count
// in quantiles and shares. More is safer for loads (bracket upwards), less for friction.
TEST(EnsemblePage, MembersWithoutACriticalValueCountInItsQuantiles) {
  for (const bool more : {true, false}) {
    const ScratchFolder scratch;
    const SampledRuns ensemble = two_ensembles(scratch, 0.0, 0).front();
    for (size_t i = 0; i < 8; ++i) {
      const double critical = i == 5 ? 3.0 : 2.0;
      scratch.write(
          ensemble.runs[i].name + "/results/summary.json",
          i < 5    ? R"({"status": "unconverged", "stands_at_both_ends": false})"  // the case itself stands
          : i == 7 ? R"({"status": "stable", "stands_at_both_ends": true})"
                   : fmt::format(R"({{"status": "stable", "critical_value": {0}, "bracket": [{1}, {0}]}})",
                                 critical, critical + (more ? -0.1 : 0.1)));
    }
    StudyPage page("One", scratch.file("page"));
    const std::string text = add_ensembles({ensemble}, scratch.folder(), &page);
    page.write();
    const std::string counts = "a: of 8 members 5 fall and 1 stands throughout the bracket.";
    EXPECT_NE(
        text.find(counts +
                  " With them, the 5 % quantile of the critical value is below the bracket, the median " +
                  (more ? "below" : "above") + " the bracket, the 95 % quantile above the bracket."),
        std::string::npos)
        << text;
    EXPECT_NE(read_text(scratch.file("page/study.html"))
                  .find("<p class=\"verdict bad\"><strong>" + counts + "</strong>"),
              std::string::npos);
    EXPECT_NE(read_text(scratch.file("page/a_statistics.csv")).find("critical_value,,2,,,,,,"),
              std::string::npos)
        << "no mean of the others alone";
    EXPECT_NE(read_text(scratch.file("page/figures/distributions.gp")).find(more ? "\n2 0.75" : "\n2 0.25"),
              std::string::npos);
  }
}

TEST(EnsemblePage, HasNoMeanDifferenceWhereAValueIsInfinite) {
  const ScratchFolder scratch;
  const std::vector<SampledRuns> ensembles = two_ensembles(scratch, 0.0, 2);
  for (const SampledRuns& ensemble : ensembles)
    for (size_t i = 0; i < 8; ++i)
      scratch.write(ensemble.runs[i].name + "/results/summary.json",
                    ensemble.name == "b" && i < 2
                        ? R"({"status": "moving", "stands_at_both_ends": false})"
                        : fmt::format(R"({{"status": "stable", "critical_value": {}}})",
                                      (ensemble.name == "b" ? 2 : 1) + i));
  StudyPage page("Two", scratch.file("page"));
  const std::string text = add_ensembles(ensembles, scratch.folder(), &page);
  const std::string said =
      "a less b: critical_value has no mean difference: in 2 of 8 pairs a member falls, or stands, "
      "throughout its bracket.";
  EXPECT_EQ(text.find(said), 0u) << text;
  EXPECT_EQ(text.find("McNemar"), std::string::npos) << text;
  EXPECT_NE(read_text(scratch.file("page/differences.csv")).find("a less b,critical_value,6,,,,,,,,,"),
            std::string::npos);
}

// Joints with strength have results that dry ones lack, and limits none in common with statics.
TEST(EnsemblePage, ComparesPairsByTheResultsThatBothHave) {
  const ScratchFolder scratch;
  std::vector<SampledRuns> ensembles = two_ensembles(scratch, 0.0, 0);
  ensembles.push_back(ensembles.front());
  ensembles.back().name = "limits";
  ensembles.back().runs.clear();
  for (size_t i = 0; i < 8; ++i) {
    ensembles.back().runs.push_back({fmt::format("s/limits_{}", i), {}, {}});
    scratch.write(ensembles.back().runs[i].name + "/results/summary.json",
                  fmt::format(R"({{"status": "stable", "critical_value": {}}})", i));
    scratch.write(
        ensembles[1].runs[i].name + "/post/summary.json",
        fmt::format(R"({{"widest_crack_m": {}, "largest_pressure_Pa": {}, "largest_strength_use": 1}})",
                    0.1 * static_cast<double>(i) + 0.01, i));
  }
  StudyPage page("Three", scratch.file("page"));
  const std::string text = add_ensembles(ensembles, scratch.folder(), &page);
  page.write();
  EXPECT_NE(text.find("a less b: widest_crack_m differs by -0.01 (-0.01 to -0.01)."), std::string::npos)
      << text;
  EXPECT_EQ(text.find("less limits"), std::string::npos) << text;
  const std::string figure = read_text(scratch.file("page/figures/distributions.gp"));
  for (const char* panel : {"widest crack", "largest pressure", "critical value"})
    EXPECT_NE(figure.find(std::string("set xlabel '") + panel), std::string::npos) << panel;
}

TEST(EnsemblePage, ADifferenceShownComesBeforeOneThatIsNot) {
  const ScratchFolder scratch;
  StudyPage page("Two", scratch.file("page"));
  const std::string text = add_ensembles(two_ensembles(scratch, 0.0, 1), scratch.folder(), &page);
  EXPECT_EQ(text.find("a less b: widest_crack_m differs by -0.01 (-0.01 to -0.01)."), 0u) << text;
  EXPECT_NE(text.find("No difference shown. a and b: of 8"), std::string::npos) << text;
}

TEST(EnsemblePage, IsRedWhereAllFall) {
  const ScratchFolder scratch;
  StudyPage page("One", scratch.file("page"));
  add_ensembles({two_ensembles(scratch, 0.0, 8).back()}, scratch.folder(), &page);
  page.write();
  EXPECT_NE(read_text(scratch.file("page/study.html")).find("<p class=\"verdict bad\"><strong>b: 8 of 8 "),
            std::string::npos);
}

TEST(EnsemblePage, ADifferenceWithinItsIntervalIsTheHeadline) {
  const ScratchFolder scratch;
  StudyPage page("Two", scratch.file("page"));
  const std::string text = add_ensembles(two_ensembles(scratch, 0.05, 0), scratch.folder(), &page);
  page.write();
  EXPECT_NE(text.find("No difference shown. a less b: widest_crack_m differs by -0.01 ("), std::string::npos)
      << text;
  EXPECT_NE(read_text(scratch.file("page/study.html")).find("<strong>No difference shown.</strong>"),
            std::string::npos);
}

TEST(EnsemblePage, MembersWithoutAVerdictWidenTheInterval) {
  const ScratchFolder scratch;
  std::vector<SampledRuns> ensembles = two_ensembles(scratch, 0.0, 2);
  std::filesystem::remove_all(scratch.file(ensembles[1].runs[7].name));
  ensembles.erase(ensembles.begin());
  StudyPage page("One", scratch.file("page"));
  const std::string text = add_ensembles(ensembles, scratch.folder(), &page);
  EXPECT_NE(text.find("b: 1 of 8 members failed; in all it falls in 2, it stands in 5, missing in 1."),
            std::string::npos)
      << text;
  // 2 of 8: 3.19 to 65.1 %; 3 of 8: 8.52 to 75.5 %.
  EXPECT_NE(text.find("2 of 8 members fall, 1 without a verdict: probability 28.6 % (3.19 to 75.5 %)."),
            std::string::npos)
      << text;
}

/// 23 members whose thrust lines run at i on both beds; the last two fall.
SampledRuns members_with_tables(const ScratchFolder& scratch) {
  const Samples samples = draw_samples({23,
                                        1,
                                        Ensemble::Design::monte_carlo,
                                        KeptFiles::tables,
                                        {{"joints.friction", UniformValues{0.2, 0.6}}}});
  SampledRuns ensemble{"a", samples, Ensemble::Design::monte_carlo,
                       sampled_runs(samples, KeptFiles::tables, "s/a_", "dome", {})};
  for (size_t i = 0; i < 23; ++i) {
    const std::string& run = ensemble.runs[i].name;
    scratch.write(run + "/results/summary.json",
                  i >= 21 ? R"({"status": "moving"})" : R"({"status": "stable"})");
    scratch.write(run + "/post/summary.json",
                  fmt::format("{{\"widest_crack_m\": {}}}", 0.1 * static_cast<double>(i)));
    const double position = i >= 21 ? 99.0 : static_cast<double>(i);
    scratch.write(run + "/post/thrust_rib.csv",
                  fmt::format("bed,height_m,blocks,position\n0,0,1,{0}\n1,0.5,1,{0}\n", position));
  }
  return ensemble;
}

// The quantiles of 0 to 20 are 1, 10 and 19. What falls has no thrust line.
TEST(EnsemblePage, BandsOfThrustLinesAndConvergence) {
  const ScratchFolder scratch;
  StudyPage page("One", scratch.file("page"));
  add_ensembles({members_with_tables(scratch)}, scratch.folder(), &page);
  page.write();
  const std::string bands = read_text(scratch.file("page/a_bands_thrust_rib.csv"));
  EXPECT_EQ(bands.substr(0, bands.find('\n')), "bed,height_m,members,position_q05,position_q50,position_q95");
  EXPECT_NE(bands.find("\n0,0,21,1,10,19\n1,0.5,21,1,10,19\n"), std::string::npos) << bands;
  // The last point of the convergence is the answer of all members.
  const std::string figure = read_text(scratch.file("page/figures/a_convergence.gp"));
  const ConfidenceInterval all = clopper_pearson(2, 23);
  EXPECT_NE(figure.find(fmt::format("\n23 {:.9g} {:.9g} {:.9g}", 2.0 / 23.0, all.low, all.high)),
            std::string::npos)
      << figure;
}

// What falls throughout its bracket is not all that falls: the case of the first member does, too.
TEST(EnsemblePage, LimitsHaveNoProbabilityOfFalling) {
  const ScratchFolder scratch;
  const SampledRuns ensemble = members_with_tables(scratch);
  for (size_t i = 0; i < 21; ++i)
    scratch.write(ensemble.runs[i].name + "/results/summary.json",
                  fmt::format(R"({{"status": "stable", "critical_value": {}}})", 1.0 + i));
  for (size_t i = 21; i < 23; ++i)
    scratch.write(ensemble.runs[i].name + "/results/summary.json",
                  R"({"status": "moving", "stands_at_both_ends": false})");
  scratch.write(ensemble.runs[0].name + "/post/answers.json", R"({"verdict": {"words": "It falls"}})");
  StudyPage page("One", scratch.file("page"));
  const std::string text = add_ensembles({ensemble}, scratch.folder(), &page);
  EXPECT_NE(text.find(" Verdicts: it falls in 3, it stands in 20.\n"), std::string::npos) << text;
  EXPECT_FALSE(std::filesystem::exists(scratch.file("page/figures/a_convergence.gp")));
}

}  // namespace
}  // namespace cupola::ensemble_test
