// Tables of studies on handwritten runs, and their places in pages.
#include "postproc/studies/study.hpp"

#include <filesystem>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "postproc/studies/docs_page.hpp"
#include "tests/assembly/case/case_scratch.hpp"

namespace cupola::study_test {
namespace {

/// Writes a finished run, of a search that found no limit.
void write_run(const ScratchFolder& scratch, const std::string& name, const std::string& status, double x,
               const std::string& version = "0.3 (abc)") {
  scratch.write(name + "/results/summary.json", "{\"status\": \"" + status +
                                                    "\", \"message\": \"lantern: no limit: it stands\", "
                                                    "\"sought\": {\"found\": \"no limit\"}, \"x\": " +
                                                    std::to_string(x) + ", \"program_version\": \"" +
                                                    version + "\", \"text_files\": {\"history.csv\": \"\"}}");
  scratch.write(name + "/results/history.csv", "time_s,moved_m\n0,0\n1,0.4\n2,0.6\n3,0.9\n");
  scratch.write(name + "/results/run.yaml", "joints:\n  friction: 0.4\n");
  scratch.write(name + "/post/summary.json", "{\"y\": 4}");
  scratch.write(name + "/post/chains.csv", "chain,force_N\nlow,1500\nhigh,2000.5\n");
}

StudyTable table_of(const ScratchFolder& scratch, const std::string& keys) {
  return read_study(scratch.write("study.yaml", "tables:\n  - name: t\n" + keys)).tables.front();
}

/// The table on a page.
std::string shown(const ScratchFolder& scratch, const std::string& keys) {
  const StudyTable table = table_of(scratch, keys);
  RunCache cache(scratch.folder());
  return to_markdown(table, measured_table(table, cache));
}

TEST(StudyTable, ShowsNumbersOfEveryKindOfSource) {
  const ScratchFolder scratch;
  write_run(scratch, "a", "stable", 3e6);
  write_run(scratch, "a_limit", "stable", 5e6);
  EXPECT_EQ(
      shown(scratch, R"(    runs: a
    columns:
      - {heading: run, text: run}
      - {heading: how, text: status}
      - {heading: given, texts: [about 3]}
      - {heading: friction, key: case.joints.friction}
      - {heading: MN, key: results.x, scale: 1e-6}
      - {heading: ratio, runs: "{run}_limit", key: results.x, over: {key: results.x}}
      - {heading: coarse, runs: "{run}_limit", key: results.x, over: {key: results.x}, digits: 1}
      - {heading: less, key: post.y, minus: {key: case.joints.friction}}
      - {heading: sum, runs: "{run} {run}_limit", key: results.x, take: sum}
      - {heading: reached, table: results/history, column: time_s, where: [{column: moved_m, from: 0.5}], take: first}
      - {heading: end, table: results/history, column: time_s, take: last}
      - {heading: rows, table: results/history, column: time_s, take: count}
      - {heading: limit, key: results.critical_value, absent: "{reason}"}
      - {heading: none, key: results.critical_value, absent: ""}
)"),
      "| run | how | given | friction | MN | ratio | coarse | less | sum | reached | end | rows | limit | "
      "none |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n"
      "| a | stable | about 3 | 0.4 | 3 | 1.67 | 2 | 3.6 | 8000000 | 2 | 3 | 4 | no limit |  |\n");
}

TEST(StudyTable, RowsMayBeThoseOfATableAndMayBecomeColumns) {
  const ScratchFolder scratch;
  write_run(scratch, "a", "stable", 1);
  const std::string keys =
      "    runs: a\n    rows: chains\n    digits: 5\n    columns:\n      - {heading: chain, cell: chain}\n"
      "      - {heading: kN, cell: force_N, scale: 1e-3}\n";
  EXPECT_EQ(shown(scratch, keys), "| chain | kN |\n|---|---|\n| low | 1.5 |\n| high | 2.0005 |\n");
  EXPECT_EQ(shown(scratch, "    transposed: true\n" + keys),
            "| chain | low | high |\n|---|---|---|\n| kN | 1.5 | 2.0005 |\n");
}

TEST(StudyTable, SaysWhichRunsAreMissingOrUnconverged) {
  const ScratchFolder scratch;
  write_run(scratch, "a", "unconverged", 1);
  const std::string keys =
      "    runs: a b\n    columns:\n      - {heading: run, text: run}\n      - {heading: how, text: status}\n"
      "      - {heading: x, key: results.x}\n";
  EXPECT_EQ(
      shown(scratch, keys),
      "| run | how | x |\n|---|---|---|\n| a | unconverged | unconverged |\n| b | not run | not run |\n");
}

// Tables of some runs lack a column, or all of it; a name that none has is misspelt, in `column` or `where`.
TEST(StudyTable, ColumnsThatNoRunHasAreNotAbsent) {
  const ScratchFolder scratch;
  for (const char* run : {"a", "b", "c"}) write_run(scratch, run, "stable", 1);
  scratch.write("a/post/chains.csv", "chain,force_N,use\nlow,1500,0.5\n");
  std::filesystem::remove(scratch.file("c/post/chains.csv"));
  const auto cells = [&](const std::string& column) {
    return shown(scratch, "    runs: a b c\n    columns:\n      - {heading: x, table: chains, column: " +
                              column + ", take: first, absent: '-'}\n");
  };
  EXPECT_EQ(cells("use"), "| x |\n|---|\n| 0.5 |\n| - |\n| - |\n");
  for (const char* column : {"force", "force_N, where: [{column: chain, is: none}, {column: force, to: 0}]"})
    try {
      ADD_FAILURE() << cells(column);
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("has no column force, did you mean force_N?"),
                std::string::npos)
          << error.what();
    }
}

TEST(StudyTable, NamesTheKeyThatWasProbablyMeant) {
  const ScratchFolder scratch;
  scratch.write("a/results/summary.json", R"({"status": "stable", "weight_N": 1})");
  scratch.write("a/post/summary.json", "{}");
  const StudyTable table =
      table_of(scratch, "    runs: a\n    columns:\n      - {heading: x, key: results.wieght_N}\n");
  RunCache cache(scratch.folder());
  try {
    measured_table(table, cache);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("has no number `wieght_N`; did you mean weight_N?"),
              std::string::npos)
        << error.what();
  }
}

// As after a new solution that was not evaluated: the thrust would be that of another model.
TEST(StudyTable, RefusesAnEvaluationOfAnotherRun) {
  const ScratchFolder scratch;
  scratch.write("a/results/summary.json", R"({"status": "stable", "case_hash": "new"})");
  scratch.write("a/post/summary.json", R"({"weight_N": 1, "case_hash": "old"})");
  try {
    shown(scratch, "    runs: a\n    columns:\n      - {heading: weight, key: post.weight_N}\n");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("a/post/summary.json: error: is of another run than results/"),
              std::string::npos)
        << error.what();
  }
}

TEST(Study, RunsAreTheProductOfCasesAndValues) {
  const ScratchFolder scratch;
  const Study study = read_study(scratch.write(
      "many.yaml",
      "runs:\n  - {cases: a b, name: \"{case}_range\", set: c.d=1, sweep: [{key: e.f, values: [2, 3]}]}\n"
      "  - {names: g}\n"));
  std::vector<std::string> names;
  for (const StudyRun& run : members_of(study)) names.push_back(run.name);
  EXPECT_EQ(names, (std::vector<std::string>{"many/a_range_f2", "many/a_range_f3", "many/b_range_f2",
                                             "many/b_range_f3", "g"}));
  EXPECT_EQ(study.runs[3].case_name, "b");
  EXPECT_EQ(study.runs[3].settings, (std::vector<std::string>{"c.d=1", "e.f=3"}));
}

// The row `dome` stands for the two runs whose names begin with it; no run has that name.
TEST(Study, ARowMayBeTheCommonPartOfTheNamesOfItsRuns) {
  const ScratchFolder scratch;
  const StudyTable table =
      table_of(scratch,
               "    runs: dome\n    columns:\n      - {heading: name, text: run}\n"
               "      - {heading: x, runs: \"{run}_thrust {run}_friction\", key: results.x, take: sum}\n");
  EXPECT_EQ(runs_of(table), (std::vector<std::string>{"dome_thrust", "dome_friction"}));
}

// Every study that comes with Cupola is read, and its members exist as cases or variants.
TEST(Study, EveryShippedStudyNamesRunsThatExist) {
  int studies = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CUPOLA_SOURCE_DIR "/cases/studies")) {
    const std::string path = entry.path().string();
    if (entry.is_directory()) continue;
    EXPECT_NO_THROW(EXPECT_FALSE(members_text(members_of(read_study(path)), path).empty())) << path;
    ++studies;
  }
  EXPECT_GE(studies, 16);
}

// Both would write to the folder arch_friction0.7.
TEST(Study, RefusesAMemberWithTheNameOfACase) {
  const ScratchFolder scratch;
  const std::string path = scratch.write("arch.yaml", "title: swept\n");
  const std::vector<StudyRun> members = {{"arch_friction0.7", "arch", {"joints.friction=0.7"}}};
  EXPECT_EQ(members_text(members, path), "arch_friction0.7 arch joints.friction=0.7\n");
  scratch.write("arch_friction0.7.yaml", "extends: arch.yaml\n");
  try {
    members_text(members, path);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("named arch_friction0.7, like a member"), std::string::npos)
        << error.what();
  }
}

TEST(DocsPage, RefusesRunsOfDifferentOrChangedRevisions) {
  const ScratchFolder scratch;
  write_run(scratch, "a", "stable", 1);
  write_run(scratch, "b", "stable", 1);
  write_run(scratch, "other", "stable", 1, "0.3 (def)");
  write_run(scratch, "changed", "stable", 1, "0.3 (abc-dirty)");
  write_run(scratch, "unknown", "stable", 1, "0.3 (unknown revision)");
  RunCache cache(scratch.folder());
  EXPECT_EQ(common_revision({"a", "b"}, cache), "abc");
  const auto error_of = [&cache](const std::vector<std::string>& runs) -> std::string {
    try {
      common_revision(runs, cache);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(error_of({"a", "b", "other"}).find("abc (a b); def (other)"), std::string::npos);
  EXPECT_NE(error_of({"changed"}).find("changed sources (revision abc-dirty)"), std::string::npos);
  EXPECT_NE(error_of({"unknown"}).find("unknown sources"), std::string::npos);
}

TEST(DocsPage, ReplacesTheTextBetweenTheMarkers) {
  const ScratchFolder scratch;
  const std::string page = scratch.write(
      "page.md", "before\n<!-- table t -->\nold\n<!-- end -->\n<!-- table u -->\n<!-- end -->\n");
  write_to_page(page, "t", "new");
  EXPECT_EQ(read_text(page),
            "before\n<!-- table t -->\n\nnew\n\n<!-- end -->\n<!-- table u -->\n<!-- end -->\n");
  EXPECT_THROW(write_to_page(page, "v", "new"), InputError);
}

}  // namespace
}  // namespace cupola::study_test
