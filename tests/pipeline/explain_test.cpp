// `--explain` against the run: counts are equal, and the estimated time is within a factor of two of the time
// of the run (slow, because it is measured).

#include "solver/explain.hpp"

#include <gtest/gtest.h>

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

// A limit of zero ends every part that is timed: the same path as a static start that takes hours.
TEST(Explain, EndsAtItsTimeLimitAndNamesWhatItLeavesOut) {
  const Assembly wall = generate(case_of("wall_large", {}));
  const std::vector<std::string> motion{"analysis.type=dynamic", "analysis.duration=0.1"};
  std::vector<std::string> from_rest = motion;
  from_rest.emplace_back("analysis.start=static");
  for (const auto& [settings, left_out] :
       {std::pair{std::vector<std::string>{}, "a factorisation, which had"},
        std::pair{motion, "step 1, which had not ended after"},
        std::pair{from_rest, "the static start, which had not ended after"}}) {
    const Case input = case_of("wall_large", settings);
    const ModelExplanation e = explain_model(input, wall, 0.0);
    EXPECT_EQ(e.cost.left_out.find(left_out), 0u) << e.cost.left_out;
    EXPECT_NE(e.text.find("estimate    at least"), std::string::npos) << e.text;
    EXPECT_NE(e.text.find("left out    " + std::string(left_out)), std::string::npos) << e.text;
    EXPECT_EQ(e.counts.free_blocks, 10);
    EXPECT_EQ(explain_model(input, wall).cost.left_out, "");
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
                                                     std::vector<std::string>{"analysis.duration=0.3"}}),
                         [](const auto& run) { return std::string(run.param.first); });

}  // namespace
}  // namespace cupola::explain_test
