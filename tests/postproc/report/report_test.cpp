// The report in a headless browser and the files for ParaView in ParaView, opened as a user opens them. A
// test is skipped if the program that it needs is not installed.

#include "postproc/report/report.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/files/atomic_file.hpp"
#include "assembly/files/content_hash.hpp"
#include "assembly/files/hash.hpp"
#include "assembly/files/summary_file.hpp"
#include "postproc/analyse.hpp"
#include "postproc/compare/compare.hpp"
#include "postproc/tables/post_summary.hpp"
#include "tests/postproc/browser.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::report_test {
namespace {

using test::Browser;
using test::on_path;

/// The text of a page: without scripts, styles and comments.
std::string text_of(std::string html) {
  for (const auto& [start, end] :
       {std::pair{"<script", "</script>"}, {"<style", "</style>"}, {"<!--", "-->"}})
    for (size_t at = 0; (at = html.find(start, at)) != std::string::npos;)
      html.erase(at, html.find(end, at) + std::string(end).size() - at);
  return html;
}

/// Writes the assembly and results of a column, analyses them and returns the folder post/.
std::string analysed_column(const std::string& name, Status status = Status::stable,
                            const ForcesUnique& unique = {}) {
  const std::string folder = test::fresh_folder(name);
  const Assembly a = test::column(3);
  write_assembly(folder + "/assembly.vtu", a);
  ResultsWriter writer(folder + "/results", content_hash(a));
  std::vector<Frame> frames;
  for (const double time : {0.0, 0.5}) {
    Frame frame =
        test::column_at_rest(a, test::kGravity, 0.0, 1.2, 0.4);  // at the edge: half of the joint opens
    frame.time = time;
    for (int i = 0; i < frame.contacts.size(); ++i)
      if (frame.contacts.normal_force[i] == 0.0) frame.contacts.gap[i] = 1e-3;
    frames.push_back(frame);
  }
  Summary summary = test::column_summary(a);
  summary.status = status;
  test::write_frames(frames, summary, &writer);
  summary.forces_unique = unique;
  if (status == Status::unconverged) summary.message = "equilibrium residual 0.1 > 1e-9 asked";
  writer.write_text("run.yaml", "title: column\n");
  writer.write_summary(summary);
  const AnalyseRequest request{.run = {.scene = test::column_case(),
                                       .assembly_path = folder + "/assembly.vtu",
                                       .results_folder = folder + "/results"},
                               .output_folder = folder + "/post",
                               .quiet = true};
  EXPECT_EQ(analyse(request), ExitCode::done);
  return folder + "/post";
}

/// Opens a page `width` pixels wide and expects that it fits, that all its images load, and that it complains
/// of nothing. Returns the number of images.
int images_in_browser(Browser* browser, const std::string& page, int width) {
  browser->start_anew();
  browser->resize(width, 900, false);
  browser->open(page);
  browser->value("window.cupolaView && window.cupolaView.then(() => true)");
  EXPECT_EQ(browser->value("innerWidth"), width);
  EXPECT_EQ(browser->value("document.documentElement.scrollWidth - document.documentElement.clientWidth"), 0);
  EXPECT_EQ(browser->value("[...document.images].filter((i) => !i.complete || !i.naturalWidth).length"), 0);
  EXPECT_EQ(fmt::format("{}", fmt::join(browser->complaints(), "\n")), "");
  return browser->value("document.images.length");
}

TEST(Report, OpensInABrowserWideAndNarrow) {
  if (!test::has_browser()) GTEST_SKIP() << "chromium is not installed";
  const std::string post = analysed_column("column");
  int figures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(post + "/figures"))
    figures += entry.path().extension() == ".gp" ? 1 : 0;
  EXPECT_EQ(figures > 0, on_path("gnuplot"));
  Browser browser;
  for (const int width : {1280, 400})
    EXPECT_EQ(images_in_browser(&browser, post + "/report.html", width), figures);
}

TEST(Report, EscapesTheTitleAndStatesTheVerdict) {
  const std::string html = read_text(analysed_column("column") + "/report.html");
  EXPECT_EQ(html.find("<b>&amp; \""), std::string::npos);
  EXPECT_NE(html.find("Column &lt;b&gt;&amp;amp; &quot;beds&quot;"), std::string::npos);
  EXPECT_NE(html.find("The joint forces carry the weight of 3 blocks"), std::string::npos);
  EXPECT_EQ(text_of(html).find("http"), std::string::npos) << "the page loads no external resources";
  EXPECT_EQ(html.find("<script src"), std::string::npos);
}

std::string quality_of(const Summary& summary) {
  Evaluation e;
  e.summary = summary;
  return fmt::format("{}", fmt::join(quality_sentences(e), " "));
}

// The quality section is generated from the typed values: quantity, norm, what is bounded, and why not.
TEST(Report, StatesWhatIsBoundedAndWhetherForcesAreUnique) {
  Summary s;
  s.status = Status::stable;
  s.accuracy = {"force balance of the blocks", "largest, over the weight", 1e-8, 2e-9, 2e-9};
  s.certified_force_error = {1.4e-14, "the distance of the forces from the exact ones"};
  s.largest_law_violation = {0.88, 5, 12, 31, 0.0};
  const std::string good = quality_of(s);
  for (const char* said : {"Error of the force balance of the blocks: 2.00e-09 reached, 1.00e-08 requested",
                           "Certified to be at most 1.4e-14: the distance of the forces from the exact ones.",
                           "between the blocks 12 and 31, the law holds to within 8.8e-01"})
    EXPECT_NE(good.find(said), std::string::npos) << good;
  EXPECT_EQ(good.find("unbalanced force on a free block"), std::string::npos)
      << "the run has no such residual";
  s.certified_force_error = {{}, "some compliance is zero"};
  EXPECT_NE(quality_of(s).find("No error bound is certified: some compliance is zero."), std::string::npos);
  s.critical = CriticalValue{"friction", 0.25, 0.26, 0.24};
  EXPECT_NE(quality_of(s).find("those of the equilibrium at 0.26"), std::string::npos);
}

TEST(Report, StatesBesideTheVerdictThatForcesMayNotBeUnique) {
  EXPECT_EQ(read_text(analysed_column("column") + "/report.html").find("may not be unique"),
            std::string::npos);
  const std::string html = read_text(
      analysed_column("rigid", Status::stable, {false, "some compliance is zero"}) + "/report.html");
  const size_t said = html.find("The forces may not be unique: some compliance is zero.");
  ASSERT_NE(said, std::string::npos);
  EXPECT_LT(said, html.find("<h2>"));
}

// Markup in every text that comes from a file, in the report and in a comparison of two runs.
TEST(Report, TextsFromFilesNeverBecomeMarkup) {
  const std::string markup = "<script>alert('x')</script>";
  const std::string folder = std::filesystem::path(analysed_column("markup")).parent_path().string();
  const Assembly a = test::column(3);
  Summary summary = test::column_summary(a);
  for (std::string* text :
       {&summary.message, &summary.program_version, &summary.case_hash, &summary.geometry_hash})
    *text = markup;
  write_text_atomically(folder + "/results/run.yaml", markup);
  summary.text_files["run.yaml"] = hash_text(markup);
  for (const Status status : {Status::stable, Status::unconverged}) {
    summary.status = status;
    write_text_atomically(folder + "/results/summary.json", to_json(summary));
    Case scene = test::column_case();
    scene.title = markup;
    const AnalyseRequest request{.run = {.scene = scene,
                                         .assembly_path = folder + "/assembly.vtu",
                                         .results_folder = folder + "/results",
                                         .force = true},
                                 .output_folder = folder + "/post",
                                 .quiet = true};
    ASSERT_EQ(analyse(request), ExitCode::done);
    const std::string html = read_text(folder + "/post/report.html");
    EXPECT_EQ(html.find("<script>alert"), std::string::npos);
    EXPECT_NE(html.find("<h1>&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;</h1>"), std::string::npos);
    EXPECT_NE(html.find("&lt;script&gt;"), html.rfind("&lt;script&gt;")) << "title and message both show";
  }
  const std::string out = test::fresh_folder("markup_comparison");
  ASSERT_EQ(compare({folder + "/post", analysed_column("b")}, out, true), ExitCode::done);
  const std::string html = read_text(out + "/comparison.html");
  EXPECT_EQ(html.find("<script>alert"), std::string::npos);
  EXPECT_NE(html.find("&lt;script&gt;alert"), std::string::npos) << "the title shows";
}

TEST(Report, AnUnconvergedRunIsReportedFirst) {
  const std::string html = read_text(analysed_column("column", Status::unconverged) + "/report.html");
  const size_t warning = html.find("the solver did not reach the requested accuracy");
  ASSERT_NE(warning, std::string::npos);
  EXPECT_LT(warning, html.find("<h2>"));
  EXPECT_NE(html.find("No verdict"), std::string::npos);
}

/// Analyses a column whose upper two blocks slide away, and returns the folder post/.
std::string sliding_column(Status status, AnalysisType analysis) {
  const std::string folder = test::fresh_folder("sliding");
  const Assembly a = test::column(3);
  write_assembly(folder + "/assembly.vtu", a);
  ResultsWriter writer(folder + "/results", content_hash(a));
  const bool in_time = analysis == AnalysisType::dynamic;
  std::string history =
      "time_s,support_reaction_x_N,support_reaction_y_N,support_reaction_z_N,max_speed_m_per_s,max_"
      "displacement_m\n";
  for (int i = 0; i <= 100; ++i) history += fmt::format("{},0,0,100,{},{}\n", 0.02 * i, 0.01 * i, 0.008 * i);
  const bool staged = analysis == AnalysisType::staged;  // the last of three rings slides
  std::vector<Frame> frames;
  for (const double time : {0.0, 1.0, 2.0}) {
    if (!in_time && !staged && time > 0.0) break;
    Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.6, 0.4);
    frame.time = time;
    for (const size_t b : {2u, 3u}) {
      if (staged && time < 2.0) continue;
      frame.blocks.velocity[b] = Vec3(1.0, 0, 0);
      if (in_time) frame.blocks.displacement[b] = Vec3(0.4 * time, 0, 0);
      if (in_time) frame.blocks.position[b].x() += 0.4 * time;
    }
    frames.push_back(frame);
  }
  writer.write_text("run.yaml", "title: column\n");
  if (in_time) writer.write_text("history.csv", history);
  if (staged)
    writer.write_text(
        "construction.csv",
        "stage,ring,laid,blocks,weight_N,verdict,speed_ratio,least_stands,least_moves,head_squeeze_m,"
        "displacement_m,note\n"
        "0,0,1,1,50,equilibrium,1e-9,,,,,\n1,1,1,2,100,equilibrium,1e-9,,,,,\n2,2,1,3,150,moving,0.3,,,,,\n");
  Summary summary = test::column_summary(a);
  summary.status = status;
  summary.analysis = analysis;
  summary.message = "largest displacement 0.8 m > threshold 0.5 m";
  summary.steps = 100;
  summary.certified_force_error = {0.011, "the distance of the impulses of a step from the exact ones"};
  summary.max_displacement_m.reset();
  if (in_time) {
    summary.max_displacement_m = 0.8;
    summary.max_speed_m_per_s = 1.0;
  }
  test::write_frames(frames, summary, &writer);
  writer.write_summary(summary);
  Case scene = test::column_case();
  scene.analysis.thresholds.displacement = 0.5;
  const AnalyseRequest request{.run = {.scene = scene,
                                       .assembly_path = folder + "/assembly.vtu",
                                       .results_folder = folder + "/results"},
                               .output_folder = folder + "/post",
                               .quiet = true};
  EXPECT_EQ(analyse(request), ExitCode::done);
  return folder + "/post";
}

// Nothing that interprets an equilibrium: neither safety, balance, certificate nor a displacement without
// amplitude.
TEST(Report, ShowsTheMotionOfARunThatFoundNoEquilibrium) {
  for (const auto& [status, analysis, says] :
       {std::tuple{Status::collapsed, AnalysisType::dynamic,
                   "At the end, 2 s, the largest displacement is 0.8 m, of "
                   "block 2 in ring 1; 2 of 3 free blocks"},
        {Status::moving, AnalysisType::dynamic, "at 1.26 s"},
        {Status::moving, AnalysisType::static_,
         "The fastest is block 2 in ring 1. A mechanism has directions but no amplitude"},
        {Status::moving, AnalysisType::staged,
         "The table of stages shows which stages do not stand, the 3-D view how their blocks begin"},
        {Status::unconverged, AnalysisType::static_, "Neither forces nor motion are known"}}) {
    const std::string post = sliding_column(status, analysis);
    const std::string html = text_of(read_text(post + "/report.html"));
    EXPECT_NE(html.find("<h2>Motion</h2>"), std::string::npos);
    EXPECT_NE(html.find(says), std::string::npos) << says;
    EXPECT_EQ(html.find("Not every stage of the construction stands.") != std::string::npos,
              analysis == AnalysisType::staged);
    for (const char* wrong :
         {"safety", "Certified", "certified", "thrust line", "balance the load above", "unbalanced force",
          "Findings", "largest displacement of a block", "Map", "may not be unique"})
      EXPECT_EQ(html.find(wrong), std::string::npos) << to_string(status) << ": " << wrong;
    EXPECT_EQ(std::filesystem::exists(post + "/figures/history.gp"), analysis == AnalysisType::dynamic);
    EXPECT_EQ(html.find("Courses over the height"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(post + "/rings.csv"))
        << "studies of accuracy read what a solve had reached";
    EXPECT_FALSE(read_post_summary(post).thrust_over_weight);
  }
}

TEST(Report, HistoryHasEveryStepAndNotOnlyTheFrames) {
  const std::string script =
      read_text(sliding_column(Status::collapsed, AnalysisType::dynamic) + "/figures/history.gp");
  const size_t start = script.find("$history << EOD\n") + 16;
  const std::string rows = script.substr(start, script.find("EOD\n", start) - start);
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 101) << "the run has 3 frames";
}

// A folder that held the output of an equilibrium keeps nothing of it.
TEST(Report, RemovesTablesAndFiguresOfAnEarlierRun) {
  const std::string post = analysed_column("column");
  write_text_atomically(post + "/section_7m.csv", "of a section that the case no longer has\n");
  write_text_atomically(post + "/.written", read_text(post + "/.written") + "section_7m.csv\n");
  write_text_atomically(post + "/section_mine.csv", "of the user\n");
  const std::string folder = std::filesystem::path(post).parent_path().string();
  const Assembly a = test::column(3);
  Summary summary = test::column_summary(a);
  summary.status = Status::unconverged;
  ResultsWriter writer(folder + "/results", content_hash(a));
  test::write_frames({test::column_at_rest(a, test::kGravity, 0.0, 0.6, 0.4)}, summary, &writer);
  writer.write_text("run.yaml", "title: column\n");
  writer.write_summary(summary);
  EXPECT_EQ(analyse({.run = {.scene = test::column_case(),
                             .assembly_path = folder + "/assembly.vtu",
                             .results_folder = folder + "/results"},
                     .output_folder = post,
                     .quiet = true}),
            ExitCode::done);
  EXPECT_FALSE(std::filesystem::exists(post + "/section_7m.csv"));
  EXPECT_TRUE(std::filesystem::exists(post + "/section_mine.csv"));
  EXPECT_FALSE(std::filesystem::exists(post + "/figures/rings.gp"));
  EXPECT_TRUE(std::filesystem::exists(post + "/joints.csv"));
}

TEST(Report, LimitsHaveAUnit) {
  Summary s;
  s.critical = CriticalValue{"tilt", 6.99, 6.9873, 6.9934};
  EXPECT_EQ(
      verdict_text(s, FrameRole::equilibrium),
      "The structure stands at a tilt of 6.9873 degrees and moves at 6.9934. The forces on this page are "
      "those at 6.9873, not those of the case.");
  s.critical = CriticalValue{"tilt", 9.46232221, 9.46232220, 9.46232222};
  EXPECT_EQ(
      verdict_text(s, FrameRole::equilibrium),
      "The structure stands up to a tilt of 9.4623 degrees and moves beyond it. The forces on this page "
      "are those at this value, not those of the case.");
  s.critical = CriticalValue{"friction", 0.1, 0.1 + 1e-9, 0.1 - 1e-9};
  EXPECT_EQ(verdict_text(s, FrameRole::equilibrium),
            "The structure stands down to a friction of 0.1 and moves below it. The forces on this page "
            "are those at this value, not those of the case.");
  EXPECT_EQ(phrase("load", 1.5), "a load factor of 1.5");
  EXPECT_EQ(phrase("acceleration", 0.1), "an acceleration of 0.1 g");
}

// Block wrenches and strips are different resultants; a report that gives one largest couple contradicts its
// captions.
TEST(Report, NamesTheResultantOfEveryCoupleLength) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.last.fields[1].couple_length = 0.173;
  MeridianEvaluation rib;
  rib.thrust.points.resize(1);
  rib.thrust.points[0].couple_length = 0.294;
  e.meridians.push_back(rib);
  const std::vector<std::string> said = finding_sentences(e);
  EXPECT_TRUE(
      std::find(said.begin(), said.end(),
                "The largest couple length of the wrench on a block from the course below is 173 mm, that of "
                "the resultant of a strip of a thrust line 294 mm.") != said.end());
}

TEST(Report, CallsWhatIsBelowTheFloorNegligible) {
  const std::vector<std::string> said = finding_sentences(test::column_evaluation(0.6, 0.4));
  const std::string all = fmt::format("{}", fmt::join(said, "\n"));
  for (const char* text : {"course below is negligible", "mean eccentricity is negligible",
                           "coefficient of variation is negligible"})
    EXPECT_NE(all.find(text), std::string::npos) << all;
  EXPECT_EQ(all.find("at its limit"), std::string::npos);
  EXPECT_EQ(all.find("e-1"), std::string::npos) << "no rounding errors: " << all;
}

TEST(Comparison, OpensInABrowserAndNamesTheRuns) {
  const std::string a = analysed_column("a"), b = analysed_column("b");
  const std::string out = test::fresh_folder("comparison");
  EXPECT_EQ(compare({a, b}, out, true), ExitCode::done);
  EXPECT_NE(read_text(out + "/comparison.html").find("equal to within 0.1 %"), std::string::npos);
  EXPECT_NE(read_text(out + "/comparison.csv").find("kern_use"), std::string::npos);
  EXPECT_NE(read_text(out + "/comparison.html").find("forces over the wall</h3>"), std::string::npos);
  EXPECT_NE(
      read_text(out + "/comparison.html").find("OpensInABrowserAndNamesTheRuns.a/post/report.html\">Column"),
      std::string::npos)
      << "a link to the report";
  EXPECT_EQ(read_text(out + "/comparison.html").find("Uniformity of the bed pressure"), std::string::npos)
      << "one block per ring: nothing to plot";
  if (!test::has_browser()) GTEST_SKIP() << "chromium is not installed";
  Browser browser;
  for (const int width : {1280, 400}) {
    const int images = images_in_browser(&browser, out + "/comparison.html", width);
    EXPECT_TRUE(images > 0 || !on_path("gnuplot"));
  }
}

TEST(ParaViewSlow, DrawsEveryKindOfFile) {
  const std::string pvbatch = CUPOLA_SOURCE_DIR "/tests/postproc/pvbatch.sh";
  if (!on_path("pvbatch")) GTEST_SKIP() << "ParaView is not installed";
  if (!on_path("xvfb-run") && !std::getenv("DISPLAY"))
    GTEST_SKIP() << "neither a display nor Xvfb is available";
  const std::string post = analysed_column("column");
  ASSERT_EQ(std::system(("CUPOLA_POST=" + post + " " + pvbatch + " " + post + "/open_in_paraview.py >" +
                         post + "/log 2>&1")
                            .c_str()),
            0)
      << read_text(post + "/log");
  // ParaView also opens the assembly and the results of the solver.
  const std::string folder = std::filesystem::path(post).parent_path().string();
  write_text_atomically(folder + "/draw.py", R"python(
import sys
from paraview.simple import *
for name in sys.argv[1:]:
    source = OpenDataFile(name)
    source.UpdatePipeline()
    assert source.GetDataInformation().GetNumberOfCells() > 0, name
    view = CreateView("RenderView")
    Show(source, view)
    Render(view)
    SaveScreenshot(name + ".png", view, ImageResolution=[300, 200])
)python");
  const std::string files = folder + "/assembly.vtu " + folder + "/results/contacts.pvd " + folder +
                            "/results/blocks.pvd " + post + "/blocks.pvd " + post + "/wrenches.vtp";
  ASSERT_EQ(std::system((pvbatch + " " + folder + "/draw.py " + files + " >" + folder + "/log 2>&1").c_str()),
            0)
      << read_text(folder + "/log");
  EXPECT_GT(std::filesystem::file_size(folder + "/results/contacts.pvd.png"), 500u);
}

}  // namespace
}  // namespace cupola::report_test
