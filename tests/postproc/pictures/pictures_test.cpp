// The standard views, drawn on a private X server. CUPOLA_REQUIRE_PYTHON is set where Xvfb must be there.

#include "postproc/pictures/pictures.hpp"

#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "assembly/files/atomic_file.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::pictures_test {
namespace {

bool has_xvfb() {
  return std::getenv("CUPOLA_REQUIRE_PYTHON") != nullptr ||
         std::system("command -v Xvfb >/dev/null 2>&1") == 0;
}

// A picture of 2000 x 1000 pixels without content has about 12 kB, one of 2000 x 700 pixels 8 kB.
TEST(Pictures, ShowBlocksForcesAndMotion) {
  if (!has_xvfb()) GTEST_SKIP() << "Xvfb is not installed";
  const Evaluation e = test::column_evaluation(0.5, 0.3);
  const std::string folder = test::fresh_folder("drawn");
  EXPECT_EQ(draw_pictures(e, {e.last.frame}, folder), "");
  for (const char* name : {"overview", "forces", "motion"}) {
    const std::string png = read_text(folder + "/" + name + ".png");
    EXPECT_EQ(png.substr(1, 3), "PNG") << name;
    EXPECT_GT(png.size(), 15'000u) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(folder + "/inside.png")) << "a column has no inside";
  EXPECT_FALSE(std::filesystem::exists(folder + "/exploded.png")) << "it has one wythe";
  EXPECT_FALSE(std::filesystem::exists(folder + "/pictures.log"));
}

// A block of an open course that has no joints is not laid.
TEST(Pictures, ShowOfAnOpenCourseTheBlocksThatAreLaid) {
  if (!has_xvfb()) GTEST_SKIP() << "Xvfb is not installed";
  const Evaluation e = test::column_evaluation(0.5, 0.3);
  const auto picture = [&](double time) {
    Frame stage;
    stage.time = time;
    stage.role = FrameRole::failed_stage;
    stage.blocks = e.last.frame.blocks;
    const std::string folder = test::fresh_folder("stage");
    EXPECT_EQ(draw_pictures(e, {stage}, folder), "");
    return read_text(folder + "/motion.png");
  };
  EXPECT_TRUE(picture(0.5) == picture(0.0));
}

TEST(Pictures, TakeAShellWithWythesApart) {
  if (!has_xvfb()) GTEST_SKIP() << "Xvfb is not installed";
  const Assembly a = test::column_with_wythes();
  const Evaluation e = test::evaluated(a, {test::column_with_a_tie(a)}, test::column_summary(a),
                                       test::column_case(), test::fresh_folder("results"));
  const std::string folder = test::fresh_folder("drawn");
  EXPECT_EQ(draw_pictures(e, {}, folder), "");
  for (const char* name : {"cut_open", "exploded"})
    EXPECT_GT(read_text(folder + "/" + name + ".png").size(), 15'000u) << name;
}

TEST(Pictures, SaysWhatIsMissing) {
  const std::string folder = test::fresh_folder("undrawn"), path = std::getenv("PATH");
  ::setenv("PATH", folder.c_str(), 1);
  const std::string problem = draw_pictures(test::column_evaluation(0.5, 0.3), {}, folder);
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_NE(problem.find("Xvfb is not installed (Debian: apt install xvfb libgl1-mesa-dri)"),
            std::string::npos)
      << problem;
  EXPECT_FALSE(std::filesystem::exists(folder + "/overview.png"));
}

}  // namespace
}  // namespace cupola::pictures_test
