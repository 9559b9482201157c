// The report in a headless browser and the files for ParaView in pvbatch, opened as a user opens them. A test
// is skipped if the program that it needs is not installed.

#include "postproc/report/report.hpp"

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/files/atomic_file.hpp"
#include "assembly/files/content_hash.hpp"
#include "assembly/files/hash.hpp"
#include "assembly/files/summary_file.hpp"
#include "postproc/analyse.hpp"
#include "postproc/compare/compare.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::report_test {
namespace {

bool on_path(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// Writes the assembly and results of a column, analyses them and returns the folder post/.
std::string analysed_column(const std::string& name, const std::string& pvbatch = "",
                            Status status = Status::stable, const ForcesUnique& unique = {}) {
  const std::string folder = test::fresh_folder(name);
  const Assembly a = test::column(3);
  write_assembly(folder + "/assembly.vtu", a);
  ResultsWriter writer(folder + "/results", content_hash(a));
  for (const double time : {0.0, 0.5}) {
    Frame frame =
        test::column_at_rest(a, test::kGravity, 0.0, 1.2, 0.4);  // at the edge: half of the joint opens
    frame.time = time;
    for (int i = 0; i < frame.contacts.size(); ++i)
      if (frame.contacts.normal_force[i] == 0.0) frame.contacts.gap[i] = 1e-3;
    writer.write_frame(frame);
  }
  Summary summary = test::column_summary(a);
  summary.status = status;
  summary.forces_unique = unique;
  if (status == Status::unconverged) summary.message = "equilibrium residual 0.1 > 1e-9 asked";
  writer.write_text("run.yaml", "title: column\n");
  writer.write_summary(summary);
  const AnalyseRequest request{.scene = test::column_case(),
                               .assembly_path = folder + "/assembly.vtu",
                               .results_folder = folder + "/results",
                               .output_folder = folder + "/post",
                               .pvbatch = pvbatch,
                               .quiet = true};
  EXPECT_EQ(analyse(request), ExitCode::done);
  return folder + "/post";
}

/// Loads a page in headless Chromium, `width` pixels wide, and returns "width overflow images broken" as the
/// page measures them, followed by the console messages. The page is loaded in a frame because a window is at
/// least 500 pixels wide.
std::string measured_in_browser(const std::string& page, int width) {
  const std::string folder = test::fresh_folder("browser" + std::to_string(width));
  std::string text = read_text(page);
  text.insert(
      text.rfind("</body>"),
      "<script>addEventListener('load',()=>{const d=document.documentElement;parent.postMessage('MEASURED '"
      "+innerWidth+' '+Math.max(0,d.scrollWidth-d.clientWidth)+' '+document.images.length+' '+"
      "[...document.images].filter(i=>!i.complete||!i.naturalWidth).length,'*')})</script>");
  write_text_atomically(folder + "/page.html", text);
  write_text_atomically(
      folder + "/frame.html",
      "<!DOCTYPE html><title>wait</title><link rel=icon href='data:,'><iframe src=page.html width=" +
          std::to_string(width) +
          " height=900 style='border:0'></iframe><script>addEventListener('message',"
          "e=>{document.title=e.data})</script>");
  const std::string command =
      "chromium --headless --no-sandbox --disable-gpu --window-size=1600,1000 "
      "--virtual-time-budget=10000 --enable-logging=stderr --user-data-dir=" +
      folder + "/profile --dump-dom file://" + folder + "/frame.html >" + folder + "/dom.html 2>" + folder +
      "/log";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const std::string dom = read_text(folder + "/dom.html"), log = read_text(folder + "/log");
  const size_t at = dom.find("MEASURED ");
  std::string measured =
      at == std::string::npos ? "nothing measured" : dom.substr(at + 9, dom.find('<', at) - at - 9);
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);)
    if (line.find(":CONSOLE") != std::string::npos) measured += " " + line;
  return measured;
}

TEST(Report, OpensInABrowserWideAndNarrow) {
  if (!on_path("chromium")) GTEST_SKIP() << "chromium is not installed";
  const std::string post = analysed_column("column");
  int figures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(post + "/figures"))
    figures += entry.path().extension() == ".png" ? 1 : 0;
  EXPECT_EQ(figures > 0, on_path("gnuplot"));
  for (const int width : {1280, 400})
    EXPECT_EQ(measured_in_browser(post + "/report.html", width), fmt::format("{} 0 {} 0", width, figures));
}

TEST(Report, EscapesTheTitleAndStatesTheVerdict) {
  const std::string html = read_text(analysed_column("column") + "/report.html");
  EXPECT_EQ(html.find("<b>&amp; \""), std::string::npos);
  EXPECT_NE(html.find("Column &lt;b&gt;&amp;amp; &quot;beds&quot;"), std::string::npos);
  EXPECT_NE(html.find("The structure is at rest."), std::string::npos);
  EXPECT_EQ(html.find("http"), std::string::npos) << "the page loads no external resources";
}

// The quality section is generated from the typed values: quantity, norm, what is bounded, and why not.
TEST(Report, StatesWhatIsBoundedAndWhetherForcesAreUnique) {
  Summary s;
  s.status = Status::stable;
  s.accuracy = {"force balance of the blocks", "largest, over the weight", 1e-8, 2e-9, 2e-9};
  s.certified_force_error = {1.4e-14, "the distance of the forces from the exact ones"};
  s.largest_law_violation = {0.88, 5, 12, 31, 0.0};
  const std::string good = quality_text(s);
  for (const char* said : {"Error of the force balance of the blocks: 2.00e-09 reached, 1.00e-08 requested",
                           "Certified to be at most 1.4e-14: the distance of the forces from the exact ones.",
                           "between the blocks 12 and 31, the law holds to within 8.8e-01"})
    EXPECT_NE(good.find(said), std::string::npos) << good;
  EXPECT_EQ(good.find("unbalanced force on a free block"), std::string::npos)
      << "the run has no such residual";
  s.certified_force_error = {{}, "some compliance is zero"};
  EXPECT_NE(quality_text(s).find("No error bound is certified: some compliance is zero."), std::string::npos);
  s.analysis = AnalysisType::limit;
  s.critical = CriticalValue{"friction", 0.25, 0.26, 0.24};
  EXPECT_NE(quality_text(s).find("those of the equilibrium at 0.26"), std::string::npos);
}

TEST(Report, StatesBesideTheVerdictThatForcesMayNotBeUnique) {
  EXPECT_EQ(read_text(analysed_column("column") + "/report.html").find("may not be unique"),
            std::string::npos);
  const std::string html = read_text(
      analysed_column("rigid", "", Status::stable, {false, "some compliance is zero"}) + "/report.html");
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
    const AnalyseRequest request{.scene = scene,
                                 .assembly_path = folder + "/assembly.vtu",
                                 .results_folder = folder + "/results",
                                 .output_folder = folder + "/post",
                                 .pvbatch = "",
                                 .quiet = true,
                                 .force = true};
    ASSERT_EQ(analyse(request), ExitCode::done);
    const std::string html = read_text(folder + "/post/report.html");
    EXPECT_EQ(html.find("<script"), std::string::npos);
    EXPECT_NE(html.find("<h1>&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;</h1>"), std::string::npos);
    EXPECT_NE(html.find("&lt;script&gt;"), html.rfind("&lt;script&gt;")) << "title and message both show";
  }
  const std::string out = test::fresh_folder("markup_comparison");
  ASSERT_EQ(compare({folder + "/post", analysed_column("b")}, out, true), ExitCode::done);
  const std::string html = read_text(out + "/comparison.html");
  EXPECT_EQ(html.find("<script"), std::string::npos);
}

TEST(Report, AnUnconvergedRunIsReportedFirst) {
  const std::string html = read_text(analysed_column("column", "", Status::unconverged) + "/report.html");
  const size_t warning = html.find("the solver did not reach the requested accuracy");
  ASSERT_NE(warning, std::string::npos);
  EXPECT_LT(warning, html.find("<h2>"));
  EXPECT_NE(html.find("No verdict"), std::string::npos);
}

TEST(Report, AFailingPvbatchOnlyLosesThePictures) {
  const std::string post = analysed_column("column", "/nowhere/pvbatch");
  EXPECT_NE(read_text(post + "/report.html").find("the 3-D pictures are incomplete"), std::string::npos);
}

TEST(Comparison, OpensInABrowserAndNamesTheRuns) {
  const std::string a = analysed_column("a"), b = analysed_column("b");
  const std::string out = test::fresh_folder("comparison");
  EXPECT_EQ(compare({a, b}, out, true), ExitCode::done);
  EXPECT_NE(read_text(out + "/comparison.html").find("equal to within 0.1 %"), std::string::npos);
  EXPECT_NE(read_text(out + "/comparison.csv").find("kern_use"), std::string::npos);
  if (!on_path("chromium")) GTEST_SKIP() << "chromium is not installed";
  for (const int width : {1280, 400}) {
    std::istringstream measured(measured_in_browser(out + "/comparison.html", width));
    int seen_width = 0, overflow = -1, images = -1, broken = -1;
    measured >> seen_width >> overflow >> images >> broken;
    EXPECT_EQ(seen_width, width);
    EXPECT_EQ(overflow, 0);
    EXPECT_EQ(broken, 0);
    EXPECT_TRUE(images > 0 || !on_path("gnuplot"));
  }
}

TEST(ParaViewSlow, DrawsEveryKindOfFile) {
  const std::string pvbatch = CUPOLA_SOURCE_DIR "/postproc/pictures/pvbatch.sh";
  if (!on_path("pvbatch")) GTEST_SKIP() << "ParaView is not installed";
  if (!on_path("xvfb-run") && !std::getenv("DISPLAY"))
    GTEST_SKIP() << "neither a display nor Xvfb is available";
  const std::string post = analysed_column("column", pvbatch);
  for (const char* name : {"blocks_meridional", "blocks_hoop", "blocks_friction", "joints", "sections",
                           "cracks", "motion_1", "motion_4"})
    EXPECT_TRUE(std::filesystem::exists(post + "/pictures/" + name + ".png")) << name;
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
