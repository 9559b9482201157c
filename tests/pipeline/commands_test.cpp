// The commands besides the three stages, run as a user runs them: reports, bond maps, studies, comparisons,
// explanations, pictures.

#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "assembly/case/bundled.hpp"
#include "assembly/files/atomic_file.hpp"
#include "tests/pipeline/program_run.hpp"

namespace cupola::commands_test {
namespace {

const std::string kWall = CUPOLA_SOURCE_DIR "/cases/wall_large.yaml";

/// A dome of 48 blocks. Its title contains characters that HTML must escape.
constexpr const char* kSmallDome = R"(title: Six rings <b>& a crown
geometry:
  surface: {type: dome, span: 45, radius_ratio: 0.8, thickness: 2.2, crown_angle_deg: 60}
  bond: {type: running, rings: 6, blocks_per_ring: 8, slices_per_block: 2}
material: {unit_weight: 18000}
joints: {friction: 0.4, compliance: {normal: 1e-8, tangential: 1e-8, per: point}}
sweep:
  - {key: joints.friction, values: [0.4, 0.5]}
postproc:
  meridians: [{name: east, azimuth_deg: 0}]
  sections: [10]
)";

/// A folder that contains the case of the dome.
struct DomeFolder : ProgramFolder {
  DomeFolder() { std::ofstream(file("dome.yaml")) << kSmallDome; }
};

/// Runs the three stages into runs/NAME.
void run_dome(const ProgramFolder& folder, const std::string& name, const std::string& set) {
  const std::string run = "runs/" + name, dome = " dome.yaml --quiet " + set;
  for (const std::string& stage :
       {"cupola-generate" + dome + " --output " + run + "/assembly.vtu",
        "cupola-solve" + dome + " --assembly " + run + "/assembly.vtu --output " + run + "/results",
        "cupola-post analyse" + dome + " --assembly " + run + "/assembly.vtu --results " + run +
            "/results --output " + run + "/post"}) {
    const ProgramRun done = folder.run(stage);
    ASSERT_EQ(done.code, 0) << stage << "\n" << done.err;
  }
}

size_t count(const std::string& text, const std::string& part) {
  size_t found = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++found;
  return found;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Commands, ReportTheStereotomy) {
  const ProgramFolder folder;
  const std::string generate = "cupola-generate " + kWall + " --output wall.vtu --quiet";
  ASSERT_EQ(folder.run(generate + " --report new/wall.json").code, 0);
  const auto report = nlohmann::json::parse(slurp(folder.file("new/wall.json")));
  EXPECT_EQ(report["blocks"], 10);
  EXPECT_EQ(report["volume_m3"], 12.0 * 6.0 * 1.0);  // exact: every side is a multiple of 0.25 m
  EXPECT_EQ(report["sizes_by_kind"]["standard"]["mean_m3"], 7.2);
  int blocks = 0;
  for (const auto& ring : report["sizes_by_ring"]) blocks += ring["blocks"].get<int>();
  EXPECT_EQ(blocks, 10);
  ASSERT_EQ(folder.run(generate + " --report wall.txt").code, 0);
  const std::string text = slurp(folder.file("wall.txt"));
  for (const char* part : {"Wall of large blocks", "10 blocks", "standard", "ring 3"})
    EXPECT_TRUE(contains(text, part)) << part << " in\n" << text;
}

TEST(Commands, DrawTheBondMap) {
  const DomeFolder folder;
  // Background, clip path and one rectangle per block. In a closed ring, blocks across the seam are drawn at
  // both ends.
  ASSERT_EQ(folder.run("cupola-generate " + kWall + " --output wall.vtu --quiet --bond-map wall.svg").code,
            0);
  EXPECT_EQ(count(slurp(folder.file("wall.svg")), "<rect "), 2u + 10u);
  ASSERT_EQ(folder.run("cupola-generate dome.yaml --output dome.vtu --quiet --bond-map dome.svg").code, 0);
  EXPECT_EQ(count(slurp(folder.file("dome.svg")), "<rect "), 2u + 48u + 3u) << "every other ring is shifted";
}

TEST(Commands, RefuseInterfacesOfGeneratedBlocks) {
  const ProgramFolder folder;
  const ProgramRun run = folder.run("cupola-generate " + kWall + " --output w.vtu --contacts c.csv");
  EXPECT_EQ(run.code, 2);
  EXPECT_TRUE(contains(run.err, "generated blocks have no interfaces")) << run.err;
}

// A case whose members cannot be named would be refused only when somebody runs it.
TEST(Commands, NameTheMembersOfEveryShippedSweepAndStudy) {
  const ProgramFolder folder;
  int found = 0;
  for (const char* where : {"", "/gallery", "/studies"})
    for (const auto& entry : std::filesystem::directory_iterator(bundled_folder() + where)) {
      if (entry.path().extension() != ".yaml") continue;
      const std::string text = read_text(entry.path());
      const bool has_members = text.find("\nsweep:") != std::string::npos ||
                               text.find("\nensemble:") != std::string::npos ||
                               text.find("\nruns:") != std::string::npos;
      if (!has_members) continue;
      const ProgramRun run =
          folder.run("cupola-post study " + entry.path().string() + " --members members.txt");
      EXPECT_EQ(run.code, 0) << entry.path() << ": " << run.err;
      ++found;
    }
  EXPECT_GT(found, 10);
}

TEST(Commands, TabulateASweepAndReportMissingMembers) {
  const DomeFolder folder;
  ASSERT_EQ(folder.run("cupola-post study dome.yaml --members members.txt").code, 0);
  std::istringstream members(slurp(folder.file("members.txt")));
  std::string first, second, case_name, setting;
  members >> first >> case_name >> setting >> second;
  EXPECT_EQ(case_name + " " + setting, "dome joints.friction=0.4");
  run_dome(folder, first, "--set " + setting);
  const std::string tabulate = "cupola-post study dome.yaml --runs runs --output table";
  const ProgramRun half = folder.run(tabulate);
  EXPECT_EQ(half.code, 1) << half.err;
  EXPECT_TRUE(contains(half.out, "2 runs: it stands in 1, missing in 1")) << half.out;
  EXPECT_TRUE(contains(half.out, "no assembly: see the output of the run")) << half.out;
  EXPECT_TRUE(contains(half.err, "not run: " + second)) << half.err;
  run_dome(folder, second, "--set joints.friction=0.5");
  EXPECT_EQ(folder.run(tabulate).code, 0);
  EXPECT_EQ(count(slurp(folder.file("table/sweep.csv")), ",stable,"), 2u);
  const std::string page = slurp(folder.file("table/study.html"));
  EXPECT_TRUE(contains(page, "Six rings &lt;b&gt;&amp; a crown"));
  EXPECT_FALSE(contains(page, "Six rings <b>"));
  EXPECT_EQ(folder.run("cupola-post study dome.yaml").code, 2);
}

TEST(Commands, EvaluateClaims) {
  const DomeFolder folder;
  run_dome(folder, "low", "");
  std::ofstream(folder.file("variants.txt")) << "low  dome\nhigh  dome  joints.friction=0.5\n";
  std::ofstream(folder.file("statements.yaml")) << R"(claims:
  - says: All blocks <i>are there.
    quote: The model has 48 blocks.
    value: {runs: low, key: results.free_blocks}
    paper: {at_least: 48, at_most: 48}
  - says: There are 49.
    quote: The model has 49 blocks.
    value: {runs: low, key: results.free_blocks}
    paper: {at_least: 49}
  - says: Two runs sink.
    value: {runs: low high, key: results.max_displacement_m, take: mean}
    ours: {at_least: 1, reason: visible}
)";
  ASSERT_EQ(folder.run("cupola-post study statements.yaml --members members.txt").code, 0);
  EXPECT_EQ(slurp(folder.file("members.txt")), "low\nhigh\n");
  const ProgramRun run = folder.run("cupola-post study statements.yaml --runs runs --output told");
  EXPECT_EQ(run.code, 1) << "a run is missing";
  EXPECT_TRUE(contains(run.err, "not run: high")) << run.err;
  const std::string table = slurp(folder.file("told/claims.csv"));
  EXPECT_EQ(count(table, ",reproduced"), 1u) << table;
  EXPECT_EQ(count(table, ",not reproduced"), 1u) << table;
  EXPECT_EQ(count(table, ",not run,Not run: high."), 1u) << table;
  EXPECT_TRUE(contains(slurp(folder.file("told/study.html")), "All blocks &lt;i&gt;are there."));
}

// Both folders have a summary.json, and the results would be lost.
TEST(Commands, RefuseToEvaluateIntoTheFolderOfTheResults) {
  const DomeFolder folder;
  run_dome(folder, "low", "");
  const auto before = folder.contents();
  const ProgramRun run = folder.run(
      "cupola-post analyse dome.yaml --assembly runs/low/assembly.vtu --results runs/low/results --output "
      "runs/low/post/../results");
  EXPECT_EQ(run.code, 2) << run.out;
  EXPECT_TRUE(contains(run.err, "--output: is the folder of the results; give another")) << run.err;
  EXPECT_EQ(folder.contents(), before);
}

TEST(Commands, RefuseAStudyOfUnknownRunsBeforeAnythingIsWritten) {
  const DomeFolder folder;
  std::filesystem::create_directories(folder.file("runs/low"));
  std::ofstream(folder.file("variants.txt")) << "high  dome  joints.friction=0.5\n";
  std::ofstream(folder.file("statements.yaml")) << "claims:\n"
                                                   "  - says: It sinks.\n"
                                                   "    value: {runs: hihg, key: results.free_blocks}\n"
                                                   "    ours: {at_least: 1, reason: visible}\n";
  const ProgramRun typo = folder.run("cupola-post study statements.yaml --runs runs --output told");
  EXPECT_EQ(typo.code, 2);
  EXPECT_EQ(typo.err,
            "cupola-post: statements.yaml: error: hihg: no case and no variant has this name, and no run in "
            "runs; did you mean high?\n");
  const ProgramRun elsewhere = folder.run("cupola-post study statements.yaml --runs rnus --output told");
  EXPECT_EQ(elsewhere.code, 2);
  EXPECT_EQ(elsewhere.err, "cupola-post: rnus: error: --runs: no such folder\n");
  EXPECT_FALSE(std::filesystem::exists(folder.file("told")));
}

TEST(Commands, CompareATradeoffWithItsReference) {
  const DomeFolder folder;
  run_dome(folder, "study/dome/exact", "--set analysis.tolerance=1e-10");
  run_dome(folder, "study/dome/coarse", "--set analysis.tolerance=1e-2");
  std::ofstream(folder.file("study.yaml")) << R"(case: dome
tradeoff:
  - knob: method
    reference: exact
    runs:
      - {name: exact, set: analysis.tolerance=1e-10}
      - {name: coarse, set: analysis.tolerance=1e-2}
      - {name: absent, set: analysis.tolerance=1e-4}
)";
  ASSERT_EQ(folder.run("cupola-post study study.yaml --members members.txt").code, 0);
  EXPECT_TRUE(contains(slurp(folder.file("members.txt")),
                       "study/dome/coarse dome analysis.tolerance=1e-2 --tables\n"));
  const ProgramRun run = folder.run("cupola-post study study.yaml --runs runs --output study");
  ASSERT_EQ(run.code, 1) << run.err;
  EXPECT_TRUE(contains(run.err, "not run: study/dome/absent")) << run.err;
  EXPECT_TRUE(std::filesystem::exists(folder.file("study/study.html")));
  std::istringstream table(slurp(folder.file("study/tradeoff.csv")));
  std::vector<std::string> rows;
  for (std::string row; std::getline(table, row);) rows.push_back(row);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_TRUE(contains(rows[2], ",stable,")) << rows[2];
  EXPECT_TRUE(contains(rows[3], ",not run,")) << rows[3];
}

// Two runs that a study defines, one of them missing, and a comparison of two.
TEST(Commands, TabulateTheRunsOfAStudy) {
  const DomeFolder folder;
  std::ofstream(folder.file("two.yaml")) << R"(title: Two frictions
runs:
  - {cases: dome, sweep: [{key: joints.friction, values: [0.4, 0.5]}]}
tables:
  - name: frictions
    columns:
      - {heading: run, text: run}
      - {heading: friction, key: case.joints.friction}
      - {heading: blocks of ring 0, table: blocks, column: block, where: [{column: ring, is: "0"}], take: count}
comparisons:
  - {name: pair, runs: two/dome_friction0.4 two/dome_friction0.5}
)";
  ASSERT_EQ(folder.run("cupola-post study two.yaml --members members.txt").code, 0);
  EXPECT_EQ(slurp(folder.file("members.txt")),
            "two/dome_friction0.4 dome joints.friction=0.4\ntwo/dome_friction0.5 dome joints.friction=0.5\n");
  run_dome(folder, "two/dome_friction0.4", "--set joints.friction=0.4");
  const std::string measure = "cupola-post study two.yaml --runs runs --output runs/two";
  EXPECT_EQ(folder.run(measure).code, 1);
  EXPECT_EQ(slurp(folder.file("runs/two/frictions.csv")),
            "run,friction,blocks of ring 0\ndome_friction0.4,0.4,8\ndome_friction0.5,not run,not run\n");
  run_dome(folder, "two/dome_friction0.5", "--set joints.friction=0.5");
  EXPECT_EQ(folder.run(measure + " --quiet").out, "");
  EXPECT_TRUE(contains(slurp(folder.file("runs/two/frictions.csv")), "dome_friction0.5,0.5,8\n"));
  EXPECT_TRUE(std::filesystem::exists(folder.file("runs/two/pair/comparison.csv")));
}

TEST(Commands, ErrorsOfAStudyNameThePlaceAndWhatWasMeant) {
  const DomeFolder folder;
  const auto error_of = [&folder](const std::string& text) {
    std::ofstream(folder.file("bad.yaml")) << text;
    const ProgramRun run = folder.run("cupola-post study bad.yaml --members members.txt");
    EXPECT_EQ(run.code, 2);
    return run.err;
  };
  for (const auto& [text, error] : std::vector<std::pair<std::string, std::string>>{
           {"tables:\n  - {name: t, runs: dome, colums: []}\n",
            "bad.yaml:2:27: error: tables[0].colums: unknown key; did you mean columns?"},
           {"tables:\n  - {name: t, runs: dome, columns: [{heading: h, key: post.x, take: men}]}\n",
            "did you mean mean?"},
           {"runs: [{names: dom}]\n",
            "bad.yaml: error: dom: no case and no variant has this name; did you mean dome?"},
           {"runs: [{cases: dome, set: a=$(touch x)}]\n", "bad.yaml:1:27: error: runs[0].set"},
           {"runs: [{names: ../dome}]\n", "names consist of letters, digits"},
           {"title: nothing\n", "contains no runs"}})
    EXPECT_TRUE(contains(error_of(text), error)) << error_of(text);
}

TEST(Commands, CompareRuns) {
  const DomeFolder folder;
  run_dome(folder, "thick", "");
  run_dome(folder, "thin", "--set geometry.surface.thickness=2");
  const std::string compare = "cupola-post compare runs/thick/post ";
  const ProgramRun run = folder.run(compare + "runs/thin/post --output both");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(
      contains(run.out, "B: Six rings <b>& a crown (with geometry.surface.thickness=2) (runs/thin/post)"))
      << run.out;
  EXPECT_TRUE(contains(run.out,
                       "The smallest ratio of half the thickness to the eccentricity of the thrust lines is"))
      << run.out;
  const std::string page = slurp(folder.file("both/comparison.html"));
  EXPECT_TRUE(contains(page, "Six rings &lt;b&gt;&amp; a crown"));
  EXPECT_FALSE(contains(page, "Six rings <b>"));
  EXPECT_EQ(folder.run(compare + "--output one").code, 2);
  EXPECT_EQ(folder.run(compare + "runs/none/post --output one").code, 2);
}

TEST(Commands, ExplainTheModelWithoutSolvingIt) {
  const DomeFolder folder;
  ASSERT_EQ(folder.run("cupola-generate dome.yaml --output dome.vtu --quiet").code, 0);
  const auto explained = [&folder](const std::string& set) {
    const ProgramRun run = folder.run("cupola-solve dome.yaml --assembly dome.vtu --explain" + set);
    EXPECT_EQ(run.code, 0) << run.err;
    return run.out;
  };
  const std::string statics = explained("");
  for (const char* part :
       {"48 free, 1 fixed", "288 velocities, 1728 force components at 576 contacts in 136 joints",
        "static, newton", "friction    0.4, associated", "one factorisation"})
    EXPECT_TRUE(contains(statics, part)) << part << " in\n" << statics;
  const std::string motion = explained(
      " --set analysis.type=dynamic --set analysis.duration=0.1 --set joints.friction=0 "
      "--set contact.method=perturbed_gjk");
  for (const char* part : {"none: normal forces only", "dynamic, newton: 10 steps of 0.01 s",
                           "perturbed GJK, 16 queries", "3 steps, the last"})
    EXPECT_TRUE(contains(motion, part)) << part << " in\n" << motion;
  // Two ends, then seven halvings of 0.3 down to a hundredth of 0.4.
  const std::string limit = explained(
      " --set analysis.type=limit --set analysis.limit.parameter=friction --set analysis.limit.low=0.1 "
      "--set analysis.limit.high=0.4 --set analysis.limit.relative_width=0.01");
  EXPECT_TRUE(
      contains(limit, "limit, direct: conic programmes over all admissible states between 0.1 and 0.4"))
      << limit;
  const std::string stress =
      explained(" --set analysis.type=limit --set analysis.limit.parameter=peak_stress");
  EXPECT_TRUE(contains(stress, "limit, direct: a conic programme over all admissible states\n")) << stress;
  EXPECT_EQ(folder.contents().size(), 2u) << "case and assembly";
}

TEST(Commands, DrawTheFiguresOfTheCase) {
  const DomeFolder folder;
  run_dome(folder, "drawn", "");
  for (const char* figure : {"thrust_east", "hoop_east", "levels", "rings", "section_10m", "map_forces"}) {
    const std::string picture = slurp(folder.file(std::string("runs/drawn/post/figures/") + figure + ".svg"));
    EXPECT_TRUE(contains(picture, "</svg>")) << figure;
    EXPECT_FALSE(contains(picture, "nan")) << figure;
  }
  const std::string report = slurp(folder.file("runs/drawn/post/report.html"));
  EXPECT_TRUE(contains(report, "Six rings &lt;b&gt;&amp; a crown"));
  EXPECT_FALSE(contains(report, "Six rings <b>"));
}

}  // namespace
}  // namespace cupola::commands_test
