// The assessment of a case: make NAME_assessment.

#include "tests/pipeline/program_run.hpp"

namespace cupola::assessment_test {
namespace {

// An arch with a point load at a quarter of its span.
constexpr const char* kArch = R"(title: Arch with a point load
geometry:
  surface: {type: arch, span: 6, radius_ratio: 0.5, thickness: 0.8, width: 1}
  bond: {type: stack, rings: 9, blocks_per_ring: 1}
joints: {friction: 0.7, compliance: {per: area}}
loads: {forces: [{block: 3, force: [0, 0, -5000]}]}
)";

ProgramRun assess(const ProgramFolder& folder, const std::string& text) {
  std::ofstream(folder.file("bridge.yaml")) << text;
  return folder.run("make -f " CUPOLA_SOURCE_DIR "/Makefile.run BIN=" CUPOLA_BIN_DIR
                    " FOLDER=. OUT=out bridge_assessment");
}

/// The lines of a CSV file from the second one on.
std::vector<std::string> rows(const ProgramFolder& folder, const std::string& name) {
  std::istringstream text(slurp(folder.file("out/bridge_assessment/" + name)));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  if (!lines.empty()) lines.erase(lines.begin());
  return lines;
}

TEST(Assessment, AnswersOnOnePageAndComputesUnchangedPartsOnce) {
  const ProgramFolder folder;
  const ProgramRun first = assess(folder, kArch);
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_NE(first.out.find("It stands: The joint forces carry "), std::string::npos) << first.out;
  const std::string page = slurp(folder.file("out/bridge_assessment/study.html"));
  EXPECT_LT(page.find("<strong>It stands</strong>"), page.find("Least margin: Geometric safety factor"));
  EXPECT_NE(page.find("lantern</strong>: the case has no loads.lantern"), std::string::npos);
  EXPECT_EQ(page.find("load</strong>: the case has no"), std::string::npos);
  EXPECT_NE(page.find("certain for every history"), std::string::npos) << "the range of the thrust";
  const std::vector<std::string> margins = rows(folder, "margins.csv");
  ASSERT_EQ(margins.size(), 4u);
  EXPECT_EQ(margins[0].find("Geometric safety factor,2."), 0u) << margins[0];
  EXPECT_EQ(margins[1].find("Critical friction,"), 0u) << margins[1];
  EXPECT_EQ(margins[2].find("Critical load,"), 0u) << margins[2];
  EXPECT_EQ(margins[3].find("Horizontal acceleration,,0."), 0u) << "without a factor: " << margins[3];
  EXPECT_EQ(rows(folder, "settlements.csv").size(), 2u) << "two springings";

  const ProgramRun again = assess(folder, kArch);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.out.find("cupola-solve bridge.yaml"), std::string::npos) << again.out;
}

// Joints with a history admit no static analysis: the page says so, for every part.
TEST(Assessment, SaysWhyAPartWasNotComputed) {
  const ProgramFolder folder;
  std::string text = kArch;
  text.replace(text.find("friction: 0.7"), 13,
               "friction: 0.7, tension: 1e5, cohesion: 1e5, failure: brittle");
  const ProgramRun run = assess(folder, text + "analysis: {type: dynamic}\n");
  EXPECT_NE(run.code, 0);
  const std::string page = slurp(folder.file("out/bridge_assessment/study.html"));
  EXPECT_NE(page.find("<strong>Undecided</strong>"), std::string::npos);
  EXPECT_NE(page.find("statics</strong>: analysis = {...}: joints.failure: brittle or softening requires"),
            std::string::npos)
      << run.err;
}

// Keys that suit the analysis of the case, but not those of the page, leave no part out.
TEST(Assessment, ComputesAllPartsOfACaseWithKeysOfItsOwn) {
  const ProgramFolder folder;
  const ProgramRun run = assess(folder, std::string(kArch) +
                                            "analysis:\n"
                                            "  robustness: 4\n"
                                            "  accuracy: {wrench_error: 0.01}\n"
                                            "  limit: {method: bisection, joints: {from: 1}}\n");
  EXPECT_EQ(run.code, 0) << run.err;
  const std::vector<std::string> margins = rows(folder, "margins.csv");
  ASSERT_EQ(margins.size(), 4u);
  EXPECT_EQ(margins[1].find("Critical friction,"), 0u) << "of all joints: " << margins[1];
}

// On a path that lets the dead load grow from zero the stones weigh nothing at the time 0. An arch of a third
// of the thickness does not stand.
TEST(Assessment, TakesTheFullDeadLoadOfAPath) {
  const ProgramFolder folder;
  std::string text = kArch;
  text.replace(text.find("thickness: 0.8"), 14, "thickness: 0.2");
  text.replace(text.find("loads: {"), 8, "loads: {dead_load_time: {type: ramp}, ");
  const ProgramRun run = assess(folder, text + "analysis: {type: path}\n");
  EXPECT_NE(run.out.find("It falls: "), std::string::npos) << run.out << run.err;
}

// A case that moves its supports itself has no settlements: their table is left out.
TEST(Assessment, ShowsNoTableWithoutRuns) {
  const ProgramFolder folder;
  const std::string moves = "supports: {moves: [{blocks: [0], displacement: [0, 0, -0.001]}]}\n";
  EXPECT_EQ(assess(folder, kArch + moves).code, 0);
  const std::string page = slurp(folder.file("out/bridge_assessment/study.html"));
  EXPECT_NE(page.find("settled</strong>: the case moves its supports itself"), std::string::npos);
  EXPECT_EQ(page.find("<h2>settlements</h2>"), std::string::npos);
}

}  // namespace
}  // namespace cupola::assessment_test
