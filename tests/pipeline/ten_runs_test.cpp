// The first screens of ten kinds of run: each says why it ended as it did, in sentences of its own.

#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/pipeline/program_run.hpp"

namespace cupola::ten_runs_test {
namespace {

using nlohmann::json;

constexpr const char* kDome =
    "geometry:\n  surface: {type: dome, span: 8, radius_ratio: 0.6, thickness: 0.6, crown_angle_deg: 60}\n"
    "  bond: {type: running, rings: 6, blocks_per_ring: 8, slices_per_block: 2}\n";
constexpr const char* kBarrel =
    "geometry:\n  surface: {type: vault, plan: {type: line, length: 2}, profile: {type: semicircle, span: "
    "6}, thickness: 0.7}\n  bond: {type: stack, rings: 11, blocks_per_ring: 2, slices_per_block: 1}\n";
constexpr const char* kWall =  // laid block by block; the second course slides off without mortar
    "geometry:\n  surface: {type: dome, span: 3, radius_ratio: 0.5, thickness: 0.15, crown_angle_deg: 85}\n"
    "  window: {height: 1.38581929877, course: 0.055, from_deg: 0, to_deg: 125, ends: free}\n"
    "  bond: {type: running, rings: 3, blocks_per_ring: 5, slices_per_block: 4}\n  support_width: 0.2\n";

/// A cube as an object of an OBJ file, with its lowest corner at (x, 0, z).
std::string cube(const std::string& name, double x, double z, int index) {
  std::string text = "o " + name + "\n";
  for (int i = 0; i < 8; ++i) text += fmt::format("v {} {} {}\n", x + (i & 1), (i >> 1) & 1, z + (i >> 2));
  constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 4, 6, 2},
                                {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}};
  for (const auto& face : kFaces) {
    text += "f";
    for (const int corner : face) text += fmt::format(" {}", 8 * index + corner + 1);
    text += "\n";
  }
  return text;
}

/// Runs a case through the three programs; returns post/answers.json and post/summary.json. `option`: of
/// cupola-post.
std::pair<json, json> answers_of(const ProgramFolder& folder, const std::string& name,
                                 const std::string& text, const std::string& option) {
  std::ofstream(folder.file(name + ".yaml")) << text;
  EXPECT_EQ(folder.run(fmt::format("cupola-generate {0}.yaml --output {0}.vtu", name)).code, 0) << name;
  folder.run(fmt::format("cupola-solve {0}.yaml --assembly {0}.vtu --output {0}/results", name));
  const ProgramRun post = folder.run(fmt::format(
      "cupola-post analyse {0}.yaml --assembly {0}.vtu --results {0}/results --output {0}/post {1}", name,
      option));
  EXPECT_EQ(post.code, 0) << name << post.err;
  return {json::parse(slurp(folder.file(name + "/post/answers.json"))),
          json::parse(slurp(folder.file(name + "/post/summary.json")))};
}

/// Sentences of a text: they end with a point and a blank.
std::set<std::string> sentences_of(const std::string& text) {
  std::set<std::string> out;
  for (size_t begin = 0; begin < text.size();) {
    size_t end = text.find(". ", begin);
    if (end == std::string::npos) end = text.size();
    out.insert(text.substr(begin, end - begin));
    begin = end + 2;
  }
  return out;
}

struct Kind {
  const char* name;
  const char* cause;  ///< of its verdict; runs of the same cause may share sentences
  std::string text, verdict;
};

std::vector<Kind> kinds() {
  const std::string rigid = "joints: {friction: 0.7, compliance: {per: area}}\n";
  const std::string fallen = "joints: {friction: 0.05, compliance: {per: area}}\n";
  return {
      {"dome", "statics", kDome + rigid, "It stands"},
      {"settled", "settlement",
       std::string(kDome) + "  base_blocks: 8\n" + rigid +
           "supports: {moves: [{blocks: [0], displacement: [0, 0, -0.001]}]}\n",
       "It stands"},
      {"barrel", "statics", kBarrel + rigid, "It stands"},
      {"bridge", "load",
       kBarrel + rigid +
           "loads: {forces: [{over: {course: 8}, force: [0, 0, -1e3]}]}\n"
           "analysis: {type: limit, limit: {parameter: load, low: 0, high: 1000}}\n",
       "It stands"},
      {"range", "range", kBarrel + rigid + "analysis: {type: range, range: {quantities: [thrust]}}\n",
       "It stands"},
      {"limit", "friction",
       kBarrel + rigid + "analysis: {type: limit, limit: {parameter: friction, low: 0.01, high: 1}}\n",
       "It stands"},
      {"collapse", "motion",
       kBarrel + fallen + "analysis: {type: dynamic, tolerance: 1e-4, time_step: 0.02, duration: 1.5}\n",
       "It falls"},
      {"construction", "stages",
       kWall + std::string(
                   "material: {unit_weight: 16000}\njoints: {friction: 0.7, cohesion: 50e3, tension: 20e3, "
                   "compliance: {normal: 2e-11, tangential: 5e-11, per: area},\n"
                   "         rings: [{from: 2, to: 2, kind: head, friction: 0, cohesion: 0, tension: 0}]}\n"
                   "analysis:\n  type: staged\n  friction_law: coulomb\n"
                   "  staged: {unit: block, first_ring: 2, last_ring: 2, hold_below: 0, least: cohesion, "
                   "relative_width: 0.005,\n"
                   "           fresh: {courses: 1, friction: 0.2, cohesion: 1000, tension: 0}}\n"),
       "It stands"},
      {"import", "parts", "geometry: {import: {file: blocks.obj, supports: [ground]}}\n" + rigid,
       "It stands, except for what falls"},
  };
}

/// An import of a tower and a loose stone.
void write_blocks(const ProgramFolder& folder) {
  std::ofstream(folder.file("blocks.obj"))
      << cube("ground", 0, -1, 0) << cube("low", 0, 0, 1) << cube("high", 0, 1, 2) << cube("stone", 5, 1, 3);
}

ProgramRun run_sweep(const ProgramFolder& folder) {
  std::ofstream(folder.file("sweep.yaml"))
      << kBarrel << "joints: {friction: 0.7, compliance: {per: area}}\n"
      << "sweep: [{key: joints.friction, values: [0.05, 0.1, 0.6, 0.7]}]\n";
  return folder.run("make -f " CUPOLA_SOURCE_DIR "/Makefile.run BIN=" CUPOLA_BIN_DIR
                    " FOLDER=. OUT=out sweep");
}

// What stands on the first screens of runs that ended differently differs: a sentence that two of them share
// explains neither.
TEST(TenRuns, RunsOfDifferentCauseShareNoSentence) {
  const ProgramFolder folder;
  write_blocks(folder);
  std::map<std::string, std::pair<std::string, std::string>> said;  // sentence: cause and name of its run
  const auto check = [&said](const std::string& sentence, const std::string& cause, const std::string& name) {
    const auto [found, is_new] = said.try_emplace(sentence, cause, name);
    EXPECT_TRUE(is_new || found->second.first == cause)
        << found->second.second << " and " << name << " both say: " << sentence;
  };
  for (const Kind& kind : kinds()) {
    const auto [answers, summary] = answers_of(folder, kind.name, kind.text, "--tables");
    EXPECT_EQ(answers["verdict"]["words"], kind.verdict) << kind.name << ": " << answers.dump(1);
    for (const std::string part : {answers["verdict"]["reason"], answers["certain"]}) {
      EXPECT_FALSE(part.empty()) << kind.name;
      EXPECT_EQ(part.find('`'), std::string::npos) << "no page prints Markdown";
      for (const std::string& sentence : sentences_of(part)) check(sentence, kind.cause, kind.name);
    }
    // The margin names a number of the case itself: fresh mortar of 1000 Pa, friction 0.7.
    if (kind.cause == std::string("stages")) {
      EXPECT_EQ(answers["margin"]["name"], "Critical fresh cohesion");
      EXPECT_NE(answers["margin"]["details"].dump().find("the case has 1 kPa"), std::string::npos);
      EXPECT_NEAR(double(summary["margin_factor"]), 1000.0 / double(summary["critical_value"]), 0.01);
    }
    if (kind.cause == std::string("friction")) {
      EXPECT_NE(answers["margin"]["details"].dump().find("the case has 0.7"), std::string::npos);
      EXPECT_EQ(std::string(answers["certain"]).find("friction of 0.7"), std::string::npos)
          << "is what varies";
    }
    if (kind.cause == std::string("load") || kind.cause == std::string("friction")) {
      EXPECT_NE(answers["thrust"]["details"].dump().find("at the critical value, not that of the case"),
                std::string::npos);
    }
    if (kind.cause == std::string("parts")) {
      EXPECT_NE(std::string(answers["verdict"]["reason"]).find("1 block, \"stone\""), std::string::npos);
    }
  }
  const ProgramRun run = run_sweep(folder);
  const std::string page = slurp(folder.file("out/sweep/study.html"));
  EXPECT_NE(page.find("<p class=\"verdict bad\"><strong>It stands in 2 of 4 runs</strong> <small>It falls at "
                      "joints.friction "
                      "0.05 to 0.1, it stands at 0.6 to 0.7. The limit lies between 0.1 and 0.6.</small>"),
            std::string::npos)
      << run.out << run.err;
  EXPECT_NE(page.find("Certain: the verdict of 4 of 4 runs"), std::string::npos);
}

TEST(TenRunsSlow, PagesHaveNoSeriousFindingsOfAxe) {
  const ProgramFolder folder;
  write_blocks(folder);
  std::string pages = "out/sweep/study.html";
  for (const Kind& kind : kinds()) {
    answers_of(folder, kind.name, kind.text, "");
    pages += fmt::format(" {}/post/report.html", kind.name);
  }
  run_sweep(folder);
  const ProgramRun run = folder.run("python3 " CUPOLA_SOURCE_DIR "/tests/postproc/accessibility.py " + pages);
  if (run.code == 77) GTEST_SKIP() << run.out;
  EXPECT_EQ(run.code, 0) << run.out << run.err;
}

}  // namespace
}  // namespace cupola::ten_runs_test
