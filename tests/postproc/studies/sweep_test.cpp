// The table of a sweep: finished members with their numbers, missing members with a remark.
#include "postproc/studies/sweep.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/files/atomic_file.hpp"
#include "postproc/figures/gnuplot.hpp"
#include "postproc/studies/ensemble.hpp"
#include "postproc/studies/sweep_figure.hpp"
#include "tests/assembly/case/case_scratch.hpp"

namespace cupola::sweep_test {
namespace {

Table::Cell cell_of(const Table& table, size_t row, const std::string& key) {
  for (size_t k = 0; k < table.columns.size(); ++k)
    if (table.columns[k].key == key) return table.rows[row][k];
  return "no column " + key;
}

TEST(SweepTable, ReportsMissingMembersAndHowFarTheyGot) {
  const ScratchFolder scratch;
  const std::vector<SweptKey> sweep = {{"joints.friction", {"0.1", "0.2", "0.3", "x"}}};
  std::vector<StudyRun> members;
  for (const SweepMember& member : members_of(sweep, "dome"))
    members.push_back({member.name, "dome", member.settings});
  scratch.write("dome_friction0.1/results/summary.json",
                R"({"status": "stable", "equilibrium_residual": 1e-9, "max_displacement_m": 0.5})");
  scratch.write("dome_friction0.2/assembly.vtu", "");
  scratch.write("dome_friction0.3/results/checkpoint", "");
  const Table table = sweep_table({"joints.friction"}, members, scratch.folder());
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(table.columns[2].key, "status");
  EXPECT_EQ(table.rows[0][2], Table::Cell(std::string("stable")));
  EXPECT_EQ(cell_of(table, 0, "max_displacement_m"), Table::Cell(0.5));
  EXPECT_EQ(cell_of(table, 0, "thrust_N"), Table::Cell(std::string())) << "not evaluated";
  EXPECT_EQ(to_display(cell_of(table, 1, "remark")), "no results: see the output of the run");
  EXPECT_EQ(to_display(cell_of(table, 2, "remark")), "interrupted: repeat the command to resume");
  EXPECT_EQ(to_display(cell_of(table, 3, "remark")), "no assembly: see the output of the run");
  scratch.write(members[3].name + "/errors.txt",
                "cupola-generate: error: joints.friction = x: not a number\n");
  EXPECT_EQ(to_display(cell_of(sweep_table({"joints.friction"}, members, scratch.folder()), 3, "remark")),
            "no assembly: joints.friction = x: not a number");
  scratch.write(members[2].name + "/errors.txt", "cupola-solve: checkpoint: error: is damaged: remove it\n");
  EXPECT_EQ(to_display(cell_of(sweep_table({"joints.friction"}, members, scratch.folder()), 2, "remark")),
            "no assembly: is damaged: remove it")
      << "repeating the command does not help";
}

// Bands of an ensemble that kept its tables would stay beside the page of one that does not.
TEST(StudyPage, RemovesWhatTheLastPageWrote) {
  const ScratchFolder scratch;
  const Table bands{"stat_bands", "", {{"x", "", ""}}, {{1.0}}};
  for (const bool with_bands : {true, false}) {
    StudyPage page("Domes", scratch.folder());
    if (with_bands) page.add_table(bands);
    page.write();
    scratch.write("notes.csv", "of the user\n");
    EXPECT_EQ(std::filesystem::exists(scratch.file("stat_bands.csv")), with_bands);
  }
}

// "moving" of a motion in time is no verdict, unlike that of statics.
TEST(SweepTable, AMotionThatGoesOnHasNoVerdict) {
  const ScratchFolder scratch;
  scratch.write("a/results/summary.json", R"({"status": "moving", "max_speed_m_per_s": 0.004})");
  scratch.write("b/results/summary.json", R"({"status": "moving"})");
  const Table table = sweep_table({}, {{"a", "dome", {}}, {"b", "dome", {}}}, scratch.folder());
  EXPECT_EQ(cell_of(table, 0, "status"), Table::Cell(std::string("not at rest")));
  EXPECT_EQ(cell_of(table, 1, "status"), Table::Cell(std::string("moving")));
}

TEST(SweepTable, AMotionAtRestProvesNoVerdict) {
  const ScratchFolder scratch;
  const std::vector<SweptKey> sweep = {{"joints.friction", {"0.5", "0.6"}}};
  const std::vector<StudyRun> members{{"a", "dome", {"joints.friction=0.5"}},
                                      {"b", "dome", {"joints.friction=0.6"}}};
  scratch.write("a/results/summary.json", R"({"status": "stable", "max_speed_m_per_s": 1e-6})");
  for (const bool motion : {true, false}) {
    scratch.write("b/results/summary.json",
                  motion ? R"({"status": "stable", "max_speed_m_per_s": 1e-6})" : R"({"status": "stable"})");
    StudyPage page("Domes", scratch.file("page"));
    add_sweep(sweep, members, scratch.folder(), &page);
    page.write();
    EXPECT_NE(read_text(scratch.file("page/study.html"))
                  .find(motion ? "Certain: no verdict. Not known"
                               : "Certain: the verdict of 1 of 2 runs, which is proven."),
              std::string::npos);
  }
}

// Thrust, margin, crack and critical value, each with its unit; failed members in an amber banner, no link to
// a report that does not exist, and the table for LaTeX.
TEST(SweepTable, HasTheResultsOfTheMembers) {
  const ScratchFolder scratch;
  const std::vector<SweptKey> sweep = {{"joints.friction", {"0.1", "0.2"}}};
  std::vector<StudyRun> members;
  for (const SweepMember& member : members_of(sweep, "dome"))
    members.push_back({member.name, "dome", member.settings});
  scratch.write("dome_friction0.1/results/summary.json",
                R"({"status": "stable", "critical_value": 0.3, "critical_parameter": "acceleration"})");
  scratch.write(
      "dome_friction0.1/post/summary.json",
      R"({"thrust_over_weight": 0.25, "weight_N": 800, "margin_factor": 1.5, "widest_crack_m": 0.002})");
  scratch.write("dome_friction0.1/post/report.html", "");
  const Table table = sweep_table({"joints.friction"}, members, scratch.folder());
  EXPECT_EQ(cell_of(table, 0, "thrust_N"), Table::Cell(200.0));
  EXPECT_EQ(cell_of(table, 0, "margin_factor"), Table::Cell(1.5));
  EXPECT_EQ(cell_of(table, 0, "widest_crack_m"), Table::Cell(0.002));
  for (const Table::Column& column : table.columns)
    if (column.key == "critical_value") {
      EXPECT_EQ(column.unit, "g");
    }
  StudyPage page("Sweep", scratch.file("page"));
  add_sweep(sweep, members, scratch.folder(), &page);
  page.write();
  const std::string html = read_text(scratch.file("page/study.html"));
  EXPECT_NE(html.find("<p class=\"verdict bad\"><strong>1 of 2 runs failed</strong>"), std::string::npos);
  EXPECT_NE(html.find("dome_friction0.1/post/report.html\""), std::string::npos);
  EXPECT_NE(html.find("<th>outward thrust: at the critical value, if any<small>kN</small></th>"),
            std::string::npos)
      << html;
  EXPECT_NE(html.find("<th>widest crack: at the critical value, if any<small>mm</small></th>"),
            std::string::npos);
  EXPECT_NE(html.find("<td class=\"text\">It stands</td>"), std::string::npos)
      << "not the name of the status";
  EXPECT_NE(read_text(scratch.file("page/sweep.csv")).find(",stable,It stands,,0.3,"), std::string::npos);
  EXPECT_EQ(html.find("dome_friction0.2/post/report.html\""), std::string::npos);
  const std::string latex = read_text(scratch.file("page/sweep.tex"));
  EXPECT_NE(latex.find("outward thrust: at the critical value, if any (N)"), std::string::npos) << latex;
  EXPECT_NE(latex.find("dome\\_friction0.1 & 0.1 & stable"), std::string::npos) << latex;
}

// Of two keys, where there is no sentence about where it stands.
TEST(SweepTable, IsRedWhereMembersFall) {
  const ScratchFolder scratch;
  const std::vector<SweptKey> sweep = {{"joints.friction", {"0.1", "0.2"}}, {"loads.gravity[0]", {"1"}}};
  std::vector<StudyRun> members;
  for (const SweepMember& member : members_of(sweep, "block"))
    members.push_back({member.name, "block", member.settings});
  scratch.write(members[0].name + "/results/summary.json", R"({"status": "moving"})");
  for (const bool one : {true, false}) {
    scratch.write(members[1].name + "/results/summary.json",
                  one ? R"({"status": "stable"})" : R"({"status": "moving"})");
    StudyPage page("Sweep", scratch.file("page"));
    add_sweep(sweep, members, scratch.folder(), &page);
    page.write();
    const std::string html = read_text(scratch.file("page/study.html"));
    EXPECT_NE(html.find(fmt::format("<p class=\"verdict bad\"><strong>Of 2 runs: {}.</strong>",
                                    one ? "it falls in 1, it stands in 1" : "it falls in 2")),
              std::string::npos);
  }
}

// A limit lies between a run that falls and one that stands, not beside one that was not made or decided.
TEST(SweepTable, NamesALimitOnlyBetweenVerdicts) {
  const ScratchFolder scratch;
  const std::vector<SweptKey> sweep = {{"joints.friction", {"0.1", "0.2"}}};
  std::vector<StudyRun> members;
  for (const SweepMember& member : members_of(sweep, "dome"))
    members.push_back({member.name, "dome", member.settings});
  scratch.write(members[1].name + "/results/summary.json", R"({"status": "stable"})");
  const auto expect = [&](const std::string& sentence) {
    StudyPage page("Domes", scratch.file("page"));
    add_sweep(sweep, members, scratch.folder(), &page);
    page.write();
    const std::string html = read_text(scratch.file("page/study.html"));
    EXPECT_NE(html.find(sentence + "</small>"), std::string::npos) << html;
  };
  expect("It was not run at joints.friction 0.1, it stands at 0.2.");
  scratch.write(members[0].name + "/results/summary.json", R"({"status": "unconverged"})");
  expect("It is undecided at joints.friction 0.1, it stands at 0.2.");
  scratch.write(members[0].name + "/results/summary.json", R"({"status": "moving"})");
  expect("It falls at joints.friction 0.1, it stands at 0.2. The limit lies between 0.1 and 0.2.");
}

// An axle at three places: the least factor governs, and the page begins with it. Of frictions the greatest
// does, by the least margin.
TEST(SweepTable, BeginsWithTheMemberThatGoverns) {
  for (const bool friction : {false, true}) {
    const ScratchFolder scratch;
    const std::vector<SweptKey> sweep = {{"loads.forces[0].point[0]", {"-3", "-2", "-1"}}};
    std::vector<StudyRun> members;
    for (const SweepMember& member : members_of(sweep, "axle"))
      members.push_back({member.name, "axle", member.settings});
    const double critical[] = {9.5, 7.25, 8.0};
    for (size_t i = 0; i < members.size(); ++i) {
      scratch.write(members[i].name + "/results/summary.json",
                    fmt::format(R"({{"status": "stable", "critical_value": {}, "critical_parameter": "{}"}})",
                                critical[i], friction ? "friction" : "load"));
      scratch.write(members[i].name + "/post/summary.json",
                    fmt::format(R"({{"margin_factor": {}}})", friction ? 10.0 / critical[i] : critical[i]));
    }
    StudyPage page("Axles", scratch.file("page"));
    const std::string text = add_sweep(sweep, members, scratch.folder(), &page);
    page.write();
    const std::string governs =
        fmt::format("What governs: critical value {} at loads.forces[0].point[0] = {} ({}).",
                    friction ? "9.5" : "7.25", friction ? "-3" : "-2", members[friction ? 0 : 1].name);
    EXPECT_NE(text.find(governs), std::string::npos) << text;
    EXPECT_NE(read_text(scratch.file("page/study.html")).find("<strong>" + governs + "</strong>"),
              std::string::npos);
    const std::vector<SampledRuns> file{{"axles", {{sweep[0].key}, {{"-3"}, {"-2"}, {"-1"}}}, {}, members}};
    StudyPage table_page("Axles", scratch.file("table"));
    add_ensembles(file, scratch.folder(), &table_page);
    table_page.write();
    const std::string html = read_text(scratch.file("table/study.html"));
    EXPECT_NE(html.find("<strong>" + governs + "</strong>"), std::string::npos) << html;
    EXPECT_LT(html.find("<td class=\"text\">" + members[2].name), html.find("Statistics of the results"));
  }
}

// Limits without a margin, of which the second bracket says that less is safer, or that more is.
TEST(SweepTable, TheSideOfTheBracketSaysWhichCriticalValueGoverns) {
  for (const bool more : {false, true}) {
    const ScratchFolder scratch;
    const std::vector<SweptKey> sweep = {{"geometry.thickness", {"0.9", "0.8", "0.7"}}};
    std::vector<StudyRun> members;
    for (const SweepMember& member : members_of(sweep, "arch"))
      members.push_back({member.name, "arch", member.settings});
    const double critical[] = {0.4, 0.45, 0.5};
    for (size_t i = 0; i < members.size(); ++i)
      scratch.write(members[i].name + "/results/summary.json",
                    fmt::format(R"({{"status": "stable", "critical_value": {}, "bracket": [{}, {}]}})",
                                critical[i], critical[i] + (more ? -0.01 : 0.01), critical[i]));
    StudyPage page("Arches", scratch.file("page"));
    const std::string text = add_sweep(sweep, members, scratch.folder(), &page);
    const std::string thick = "0.4 at geometry.thickness = 0.9", thin = "0.5 at geometry.thickness = 0.7";
    const std::string governs = "What governs: critical value " + (more ? thick : thin);
    EXPECT_NE(text.find(governs), std::string::npos) << text;
    EXPECT_NE(text.find("At the other end: " + (more ? thin : thick)), std::string::npos) << text;
    const std::vector<SampledRuns> file{
        {"arches", {{sweep[0].key}, {{"0.9"}, {"0.8"}, {"0.7"}}}, {}, members}};
    StudyPage table_page("Arches", scratch.file("table"));
    const std::string of_file = add_ensembles(file, scratch.folder(), &table_page);
    EXPECT_NE(of_file.find(governs), std::string::npos) << of_file;
  }
}

// A block that slides above 10 kN has no critical acceleration at 12 and 16 kN.
TEST(SweepTable, MembersThatFallThroughoutTheirBracketGovern) {
  const ScratchFolder scratch;
  const std::vector<SweptKey> sweep = {{"loads.push", {"5", "8", "12", "16"}}};
  std::vector<StudyRun> members;
  for (const SweepMember& member : members_of(sweep, "box"))
    members.push_back({member.name, "box", member.settings});
  const char* results[] = {R"({"status": "stable", "critical_value": 0.25})",
                           R"({"status": "stable", "critical_value": 0.1})", R"({"status": "moving"})",
                           R"({"status": "moving"})"};
  for (size_t i = 0; i < members.size(); ++i)
    scratch.write(members[i].name + "/results/summary.json", results[i]);
  StudyPage page("Boxes", scratch.file("page"));
  const std::string text = add_sweep(sweep, members, scratch.folder(), &page);
  page.write();
  const std::string governs =
      fmt::format("What governs: 2 of 4 runs fall throughout the bracket, first at loads.push = 12 ({}).",
                  members[2].name);
  EXPECT_NE(text.find(governs + " Of the others: critical value 0.1 at loads.push = 8"), std::string::npos)
      << text;
  EXPECT_NE(read_text(scratch.file("page/study.html"))
                .find("<p class=\"verdict bad\"><strong>" + governs + "</strong>"),
            std::string::npos);
}

// A tower that bears no push without friction, then 1.8 and 2.4 times its own, and last more than the bracket.
TEST(SweepTable, MembersThatStandThroughoutTheirBracketAreTheOtherEnd) {
  const ScratchFolder scratch;
  const std::vector<SweptKey> sweep = {{"joints.friction", {"0", "0.3", "0.4", "0.6"}}};
  std::vector<StudyRun> members;
  for (const SweepMember& member : members_of(sweep, "tower"))
    members.push_back({member.name, "tower", member.settings});
  const char* results[] = {R"({"status": "moving"})", R"({"status": "stable", "critical_value": 1.8})",
                           R"({"status": "stable", "critical_value": 2.4})", R"({"status": "stable"})"};
  for (size_t i = 0; i < members.size(); ++i)
    scratch.write(members[i].name + "/results/summary.json", results[i]);
  StudyPage page("Towers", scratch.file("page"));
  const std::string text = add_sweep(sweep, members, scratch.folder(), &page);
  EXPECT_NE(
      text.find("Of the others: critical value 1.8 at joints.friction = 0.3 (tower_friction0.3). At the "
                "other end: 1 of 4 runs stand throughout the bracket, first at joints.friction = 0.6"),
      std::string::npos)
      << text;
}

// With its own mortar the construction falls, and it has the least mortar with which it stands.
TEST(SweepTable, ConstructionsWithALeastMortarDoNotFallThroughout) {
  const ScratchFolder scratch;
  const std::vector<SweptKey> sweep = {{"joints.friction", {"0.1", "0.3"}}};
  std::vector<StudyRun> members;
  for (const SweepMember& member : members_of(sweep, "dome"))
    members.push_back({member.name, "dome", member.settings});
  for (size_t i = 0; i < members.size(); ++i)
    scratch.write(members[i].name + "/results/summary.json",
                  i == 0 ? R"({"status": "moving", "critical_value": 5703, "bracket": [5703, 5650]})"
                         : R"({"status": "stable", "critical_value": 4000, "bracket": [4000, 3960]})");
  StudyPage page("Domes", scratch.file("page"));
  const std::string text = add_sweep(sweep, members, scratch.folder(), &page);
  EXPECT_NE(text.find("What governs: critical value 5703 at joints.friction = 0.1"), std::string::npos)
      << text;
  EXPECT_EQ(text.find("fall throughout"), std::string::npos) << text;
}

// Of limits whose ends were found, the first case has less friction than it needs, and the second no value to
// compare: neither stands.
TEST(SweepTable, TheVerdictOfALimitIsThatOnItsCase) {
  const ScratchFolder scratch;
  const std::vector<SweptKey> sweep = {{"geometry.thickness", {"0.5", "0.6"}}};
  std::vector<StudyRun> members;
  for (const SweepMember& member : members_of(sweep, "arch"))
    members.push_back({member.name, "arch", member.settings});
  for (size_t i = 0; i < members.size(); ++i) {
    scratch.write(members[i].name + "/results/summary.json",
                  fmt::format(R"({{"status": "stable", "critical_value": {}}})", i == 0 ? 0.345 : 0.319));
    scratch.write(members[i].name + "/post/summary.json", "{}");
    scratch.write(
        members[i].name + "/post/answers.json",
        fmt::format(R"({{"verdict": {{"words": "{}"}}}})", i == 0 ? "It falls, not proven" : "Limit found"));
  }
  StudyPage page("Arches", scratch.file("page"));
  const std::string text = add_sweep(sweep, members, scratch.folder(), &page);
  page.write();
  EXPECT_NE(text.find("2 runs: it falls, not proven in 1, limit found in 1\n"), std::string::npos) << text;
  const std::string html = read_text(scratch.file("page/study.html"));
  EXPECT_NE(html.find("<p class=\"verdict bad\">"), std::string::npos) << html;
  EXPECT_NE(html.find("<td class=\"text\">It falls, not proven</td>"), std::string::npos) << html;
  EXPECT_EQ(html.find("t stands"), std::string::npos) << html;
  EXPECT_NE(read_text(scratch.file("page/figures/sweep.gp")).find("\n0.5 0.345 6 \n0.6 0.319 6 \n"),
            std::string::npos);
}

// A factor on the load and a coefficient of friction share no unit, and neither governs.
TEST(SweepTable, CriticalValuesOfSeveralParametersAreNotCompared) {
  const ScratchFolder scratch;
  const std::vector<SweptKey> sweep = {{"analysis.limit.parameter", {"load", "friction"}}};
  std::vector<StudyRun> members;
  for (const SweepMember& member : members_of(sweep, "arch"))
    members.push_back({member.name, "arch", member.settings});
  for (size_t i = 0; i < members.size(); ++i)
    scratch.write(members[i].name + "/results/summary.json",
                  fmt::format(R"({{"status": "stable", "critical_value": {}, "critical_parameter": "{}"}})",
                              i == 0 ? 3.995 : 0.3591, sweep[0].values[i]));
  const Table table = sweep_table({sweep[0].key}, members, scratch.folder());
  EXPECT_EQ(table.columns[table.column_named("critical_value")].unit, "");
  EXPECT_EQ(cell_of(table, 1, "critical_parameter"), Table::Cell(std::string("friction")));
  EXPECT_EQ(cell_of(table, 1, "critical_value"), Table::Cell(0.3591));
  StudyPage page("Arch", scratch.file("page"));
  const std::string text = add_sweep(sweep, members, scratch.folder(), &page);
  EXPECT_EQ(text.find("What governs"), std::string::npos) << text;
}

/// A sweep over friction and thickness of four members with a critical value each.
Table table_of_four() {
  Table table{"sweep", "", {}, {}};
  for (const char* key : {"member", "joints.friction", "geometry.thickness", "status", "verdict",
                          "cpu_time_seconds", "critical_value"})
    table.columns.push_back({key, "", ""});
  for (const char* friction : {"0.2", "0.4"})
    for (const char* thickness : {"1", "2"})
      table.rows.push_back({std::string("m"), std::string(friction), std::string(thickness),
                            std::string("stable"), std::string(friction[2] == '2' ? "It falls" : "It stands"),
                            3.0 * static_cast<double>(table.rows.size()),
                            10.0 + static_cast<double>(table.rows.size())});
  return table;
}

// One curve per thickness, named by it; times are no results; members that stand have filled points (7),
// others open ones (6).
TEST(SweepFigure, DrawsResultsOverTheFirstKey) {
  const Figure f = sweep_figure({{"joints.friction", {"0.2", "0.4"}}, {"geometry.thickness", {"1", "2"}}},
                                table_of_four());
  EXPECT_NE(f.commands.find("$column6_0 << EOD\n0.2 10 6 \n0.4 12 7 \nEOD"), std::string::npos) << f.commands;
  EXPECT_NE(f.commands.find("$column6_1 << EOD\n0.2 11 6 \n0.4 13 7 \nEOD"), std::string::npos) << f.commands;
  EXPECT_NE(f.commands.find("'thickness 2'"), std::string::npos);
  EXPECT_EQ(f.commands.find("cpu_time"), std::string::npos);
}

// A curve is named at its last point that has a value, here of the stable member, and not at all without one:
// gnuplot crashes on a label at no place.
TEST(SweepFigure, NamesCurvesWhereTheyHaveAValue) {
  const std::vector<SweptKey> sweep{{"joints.friction", {"0.2", "0.4"}}, {"geometry.thickness", {"1", "2"}}};
  Table table = table_of_four();
  table.rows[2].back() = std::string();
  const Figure f = sweep_figure(sweep, table);
  EXPECT_NE(f.commands.find("$column6_0 every ::0::0 using ($1):($2):('thickness 1')"), std::string::npos)
      << f.commands;
  EXPECT_NE(f.commands.find("$column6_1 every ::1::1 using ($1):($2):('thickness 2')"), std::string::npos);
  const ScratchFolder scratch;
  EXPECT_TRUE(draw_figures(scratch.folder(), {f}).empty());
  table.rows[0].back() = std::string();
  EXPECT_EQ(sweep_figure(sweep, table).commands.find("'thickness 1'"), std::string::npos);
}

TEST(SweepFigure, NeedsNumbersThatVary) {
  Table table = table_of_four();
  EXPECT_EQ(sweep_figure({{"joints.friction", {"low", "high"}}, {"geometry.thickness", {"1", "2"}}}, table)
                .commands,
            "");
  for (auto& row : table.rows) row.back() = 1.0;
  EXPECT_EQ(
      sweep_figure({{"joints.friction", {"0.2", "0.4"}}, {"geometry.thickness", {"1", "2"}}}, table).commands,
      "");
}

}  // namespace
}  // namespace cupola::sweep_test
