// `--explain` builds the same objects as the run: equal counts, equal options, equal first steps. The
// estimated time is within a factor of two of the time of the run (slow, because it is measured).

#include "solver/explain.hpp"

#include <sstream>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "assembly/case/case_reader.hpp"
#include "generators/generate.hpp"
#include "solver/analysis/analysis.hpp"

namespace cupola::explain_test {
namespace {

Case case_of(const std::string& name, const std::vector<std::string>& settings) {
  return read_case(CUPOLA_SOURCE_DIR "/cases/" + name + ".yaml", settings);
}

TEST(Explain, CountsEqualThoseOfTheRun) {
  const Case input = case_of("wall_large", {});
  const Assembly wall = generate(input);
  const ModelExplanation e = explain_model(input, wall);
  const Summary run = run_analysis(input, wall, {}).value();
  EXPECT_EQ(e.counts.free_blocks, run.free_blocks);
  EXPECT_EQ(e.counts.unknowns, run.unknowns);
  EXPECT_EQ(e.counts.contacts, run.contacts);
  EXPECT_EQ(e.counts.joints, run.joints);
  EXPECT_EQ(e.counts.force_rows, 3 * run.contacts);
  EXPECT_EQ(e.counts.islands, 1);
  EXPECT_GT(e.cost.factor_entries, 0);
  for (const char* phrase : {"10 free, 1 fixed", "static", "friction    0.4", "estimate"})
    EXPECT_NE(e.text.find(phrase), std::string::npos) << phrase << "\n" << e.text;
}

TEST(Explain, InactiveFeaturesAddNothing) {
  const Assembly wall = generate(case_of("wall_large", {}));
  const ModelExplanation rough = explain_model(case_of("wall_large", {}), wall);
  const ModelExplanation smooth = explain_model(case_of("wall_large", {"joints.friction=0"}), wall);
  const ModelExplanation plane = explain_model(case_of("wall_large", {"analysis.plane=true"}), wall);
  EXPECT_EQ(smooth.counts.force_rows, smooth.counts.contacts);
  EXPECT_EQ(2 * plane.counts.unknowns, rough.counts.unknowns);
  EXPECT_LT(plane.counts.contacts, rough.counts.contacts);
  EXPECT_LT(3 * plane.cost.factor_entries, rough.cost.factor_entries);
  for (const char* phrase : {"sleep", "frames", "plane", "start ", "step ", "sectors"})
    EXPECT_EQ(rough.text.find(phrase), std::string::npos) << phrase << "\n" << rough.text;
}

/// Step and iterations of each row of history.csv.
std::vector<std::pair<double, int>> run_steps(const Case& input, const Assembly& assembly) {
  std::vector<std::pair<double, int>> steps;
  AnalysisSinks sinks;
  sinks.history = [&, header = true](const std::string& row) mutable {
    if (std::exchange(header, false)) return;
    std::vector<std::string> cells;
    std::istringstream in(row);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    steps.emplace_back(std::stod(cells.at(17)), std::stoi(cells.at(2)));
  };
  run_analysis(input, assembly, sinks);
  return steps;
}

// Each setting changes the first steps or is refused; an estimate with other options than the run would
// differ.
TEST(Explain, TimesTheFirstStepsOfTheRun) {
  const std::vector<std::string> motion{"analysis.type=dynamic", "analysis.duration=0.1",
                                        "output.frames_every=0.004"};
  const std::vector<std::vector<std::string>> variants{
      {},
      {"analysis.adaptive={smallest: 1e-5, largest: 0.05, displacement_error: 1e-6}"},
      {"analysis.sleep={speed: 10, time: 0.001}"},
      {"analysis.start=static"},
      {"analysis.damping=0.05", "analysis.friction_law=coulomb"}};
  const Assembly wall = generate(case_of("wall_large", {}));
  std::vector<std::vector<std::pair<double, int>>> all;
  for (const std::vector<std::string>& variant : variants) {
    std::vector<std::string> settings = motion;
    settings.insert(settings.end(), variant.begin(), variant.end());
    const Case input = case_of("wall_large", settings);
    const ModelExplanation e = explain_model(input, wall);
    std::vector<std::pair<double, int>> run = run_steps(input, wall);
    ASSERT_EQ(e.cost.steps.size(), 3u);
    ASSERT_GE(run.size(), 3u);
    run.resize(3);
    std::vector<std::pair<double, int>> timed;
    for (const TimedStep& step : e.cost.steps) timed.emplace_back(step.h, step.iterations);
    EXPECT_EQ(timed, run) << (variant.empty() ? "default" : variant.front());
    all.push_back(run);
  }
  EXPECT_NE(all[0], all[1]) << "adaptive steps";
  EXPECT_NE(all[0], all[3]) << "static start";
}

TEST(Explain, NamesTheOptionsOfAMotion) {
  const Assembly wall = generate(case_of("wall_large", {}));
  const auto explained = [&](const std::string& setting) {
    return explain_model(case_of("wall_large", {"analysis.type=dynamic", "analysis.duration=0.1", setting}),
                         wall)
        .text;
  };
  for (const auto& [setting, phrase] : std::initializer_list<std::pair<const char*, const char*>>{
           {"analysis.start=static", "start       static equilibrium"},
           {"analysis.start=static", "(static start, "},
           {"analysis.adaptive={smallest: 1e-5, largest: 0.05}", "step        adaptive, 1e-05 to 0.05 s"},
           {"analysis.sleep={speed: 0.001, time: 0.2}",
            "sleep       islands slower than 0.001 m/s for 0.2 s"},
           {"analysis.tangential=literal", "literal scheme"}}) {
    const std::string text = explained(setting);
    EXPECT_NE(text.find(phrase), std::string::npos) << phrase << "\n" << text;
  }
}

TEST(Explain, RefusesWhatTheRunRefuses) {
  const Assembly wall = generate(case_of("wall_large", {}));
  for (const std::vector<std::string>& settings : std::vector<std::vector<std::string>>{
           {"analysis.cyclic_sectors=3"},
           {"analysis.type=dynamic", "analysis.sleep={speed: 0.001, time: 0.2}",
            "loads.dead_load_time={type: ramp, duration: 1}"}}) {
    const Case input = case_of("wall_large", settings);
    EXPECT_THROW(run_analysis(input, wall, {}), InputError) << settings.back();
    EXPECT_THROW(explain_model(input, wall), InputError) << settings.back();
  }
}

class ExplainSlow : public ::testing::TestWithParam<std::pair<const char*, std::vector<std::string>>> {};

TEST_P(ExplainSlow, EstimatesTimeWithinAFactorOfTwo) {
  const Case input = case_of(GetParam().first, GetParam().second);
  const Assembly assembly = generate(input);
  const double estimated = explain_model(input, assembly).cost.seconds;
  const double started = cpu_seconds();
  run_analysis(input, assembly, {});
  const double taken = cpu_seconds() - started;
  EXPECT_LE(estimated, 2.0 * taken);
  EXPECT_GE(estimated, 0.5 * taken);
}

INSTANTIATE_TEST_SUITE_P(Cases, ExplainSlow,
                         ::testing::Values(std::pair{"dome_circular", std::vector<std::string>{}},
                                           std::pair{"brunelleschi", std::vector<std::string>{}},
                                           std::pair{"octagon_circular", std::vector<std::string>{}},
                                           std::pair{"wall_small", std::vector<std::string>{}},
                                           std::pair{"dome_circular_dynamic",
                                                     std::vector<std::string>{"analysis.duration=0.3"}}));

}  // namespace
}  // namespace cupola::explain_test
