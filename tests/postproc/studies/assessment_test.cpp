// Studies of any case: groups of supports, groups of runs that do not apply, and answers of handwritten runs.

#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/case/bundled.hpp"
#include "postproc/studies/study.hpp"
#include "postproc/studies/support_groups.hpp"
#include "tests/assembly/case/case_scratch.hpp"
#include "tests/postproc/models.hpp"

namespace cupola::assessment_study_test {
namespace {

using Groups = std::vector<std::vector<int>>;

/// Fixed cubes of 1 m at these places along x, in a row if `step` is 1.
Assembly cubes(const std::vector<double>& places) {
  Assembly a;
  for (int b = 0; b < static_cast<int>(places.size()); ++b) {
    a.blocks.emplace_back();
    a.blocks.back().fixed = true;
    a.blocks.back().centroid = {places[b] + 0.5, 0.5, 0.5};
    test::add_box(&a, b, -1, {places[b], 0, 0}, {places[b] + 1, 1, 1}, FaceKind::bed);
  }
  return a;
}

TEST(SupportGroups, BlocksThatTouchSettleTogether) {
  EXPECT_EQ(support_groups(cubes({0, 1, 6, 7, 12})), (Groups{{0, 1}, {2, 3}, {4}}));
}

// Turned by 45 degrees in plan, with gaps of 0.2 m between pairs whose boxes along x and y overlap.
TEST(SupportGroups, BlocksThatTouchAreTheSameInATurnedPlan) {
  Assembly a = cubes({0, 1, 2.2, 3.2});
  const Eigen::AngleAxisd turn(0.25 * std::numbers::pi, Vec3::UnitZ());
  for (Vec3& vertex : a.vertices) vertex = turn * vertex;
  EXPECT_EQ(support_groups(a), (Groups{{0, 1}, {2, 3}}));
}

TEST(SupportGroups, EachBlockOfARingSettlesByItself) {
  EXPECT_EQ(support_groups(cubes({0, 1, 2})), (Groups{{0}, {1}, {2}}));
}

TEST(SupportGroups, AreSixteenAtMost) {
  std::vector<double> places;
  for (int i = 0; i < 40; ++i) places.push_back(2.0 * i);
  const Groups groups = support_groups(cubes(places));
  EXPECT_EQ(groups.size(), 16u);
  size_t blocks = 0;
  for (const auto& group : groups) blocks += group.size();
  EXPECT_EQ(blocks, places.size());
}

// Names that are numbers, or no names of folders, would be taken for others.
TEST(SupportGroups, RunsHaveTheNamesOfImportedBlocks) {
  Assembly a = cubes({0, 6, 12, 18, 24});
  const char* names[] = {"pier/west", "pier_east", "3", "", "stone"};
  for (size_t b = 0; b < 5; ++b) a.blocks[b].name = names[b];
  a.blocks[4].fixed = false;
  RunGroup group;
  group.name = "settled";
  group.cases = {"a"};
  group.settle = 1e-4;
  std::string reason;
  std::vector<std::string> runs;
  for (const StudyRun& run : settlement_runs(group, "safe", {}, a, &reason)) runs.push_back(run.name);
  EXPECT_EQ(runs, (std::vector<std::string>{"safe/settled_0", "safe/settled_pier_east", "safe/settled_2",
                                            "safe/settled_3"}));
}

// Runs of the study "safe" of the case "a"; b failed, and the case gives no lantern.
struct Page {
  ScratchFolder scratch;
  std::string text, html;

  Page() {
    scratch.write("a.yaml", "geometry: {surface: {type: wall}}\n");
    write_run("verdict", "null", "It stands", "yes");
    write_run("small", "1.5", "It stands", "yes");
    write_run("large", "12.0", "It stands", "yes");
    write_run("none", "null", "It stands", "yes");
    scratch.write("a_safe/b/errors.txt",
                  "a.yaml:1: warning: odd\na.yaml:7:3: error: not with this key\nmake: *** Error 2\n");
    const Study study = read_study(scratch.write("per_case/safe.yaml", R"(
runs:
  - {cases: "{case}", name: verdict}
  - {cases: "{case}", name: large}
  - {cases: "{case}", name: lantern, needs: loads.lantern}
answers:
  verdict: "{case}_safe/verdict"
  margins: "{case}_safe/none {case}_safe/large {case}_safe/small {case}_safe/b {case}_safe/lantern"
)"),
                                   {scratch.file("a.yaml"), ""});
    RunCache runs(scratch.folder());
    StudyPage page("Safe", scratch.file("page"));
    text = add_answers(study.answers, study.left_out, scratch.folder(), runs, &page);
    page.write();
    html = read_text(scratch.file("page/study.html"));
  }

  void write_run(const std::string& name, const std::string& factor, const std::string& words,
                 const std::string& stands) const {
    std::string warnings = "\"odd load\"";
    for (int i = 1; i < 30; ++i) warnings += fmt::format(", \"blocks {} and {} overlap: too far\"", i, i + 1);
    scratch.write("a_safe/" + name + "/results/summary.json", R"({"status": "stable"})");
    scratch.write("a_safe/" + name + "/post/summary.json",
                  fmt::format("{{\"margin_factor\": {}, \"warnings\": [{}]}}", factor, warnings));
    scratch.write("a_safe/" + name + "/post/answers.json",
                  R"({"verdict": {"words": ")" + words + R"(", "reason": "because", "stands": ")" + stands +
                      R"("}, "margin": {"name": ")" + name + R"(", "value": "1 N", "detail": "hinges"}})");
  }
};

TEST(StudyAnswers, SortMarginsAndSayWhatWasNotComputed) {
  const Page page;
  EXPECT_EQ(page.text.find("It stands: because\n"), 0u) << page.text;
  EXPECT_EQ(page.text.find("  warning: odd load\n"), std::string("It stands: because\n").size()) << page.text;
  const size_t small = page.text.find("\nsmall"), large = page.text.find("\nlarge"),
               none = page.text.find("\nnone");
  EXPECT_LT(small, large) << page.text;
  EXPECT_LT(large, none) << page.text;
  EXPECT_NE(page.html.find("or the structure stands, or falls, at every value."), std::string::npos);
  EXPECT_NE(page.text.find("Least margin: small: factor 1.5"), std::string::npos) << page.text;
  EXPECT_NE(page.text.find("not computed: lantern: the case has no loads.lantern\n"), std::string::npos)
      << page.text;
  EXPECT_NE(page.text.find("not computed: b: not with this key\n"), std::string::npos) << page.text;
}

// Fill is not multiplied: a case with no other load has no critical load to look for.
TEST(StudyAnswers, FillIsNoLoadToMultiply) {
  const auto left_out = [](const std::string& loads) {
    const ScratchFolder scratch;
    scratch.write("a.yaml", "geometry: {surface: {type: wall}}\nloads: {" + loads + "}\n");
    return read_study(bundled_folder() + "/studies/per_case/assessment.yaml", {scratch.file("a.yaml"), ""})
        .left_out;
  };
  const std::string fill = "{kind: extrados, fill: {level: 2, unit_weight: 18000}}";
  const std::vector<NotComputed> of_fill = left_out("faces: [" + fill + "]");
  ASSERT_EQ(of_fill.size(), 2u);
  EXPECT_EQ(of_fill[0].what, "load");
  EXPECT_EQ(of_fill[0].why,
            "the case has no loads.forces and no loads.faces.traction and no loads.faces.pressure");
  EXPECT_EQ(of_fill[1].what, "lantern");
  EXPECT_EQ(left_out("faces: [" + fill + ", {kind: extrados, pressure: 1000}]").size(), 1u);
  EXPECT_EQ(left_out("faces: [{kind: top, traction: [0, 0, -1000]}]").size(), 1u);
  EXPECT_EQ(left_out("forces: [{block: 1, force: [0, 0, -1]}]").size(), 1u);
}

// Of the 30 warnings of the run that gives the verdict, 29 are alike.
TEST(StudyAnswers, WarningsFollowTheVerdictAsOnThePageOfARun) {
  const Page page;
  const size_t verdict = page.html.find("<strong>It stands</strong>"),
               first = page.html.find("<strong>Warning:</strong> odd load"),
               others = page.html.find("<strong>29 warnings</strong> like this: blocks 1 and 2 overlap");
  ASSERT_NE(others, std::string::npos) << page.html;
  EXPECT_LT(verdict, first);
  EXPECT_LT(first, others);
  EXPECT_EQ(page.html.find("<strong>Warning:</strong> blocks"), std::string::npos);
  EXPECT_NE(page.text.find("  warning: 29 like this: blocks 1 and 2 overlap: too far\n"), std::string::npos)
      << page.text;
}

}  // namespace
}  // namespace cupola::assessment_study_test
