// The graphs of a comparison.

#include "postproc/compare/compare.hpp"

#include <gtest/gtest.h>

#include "assembly/files/atomic_file.hpp"
#include "postproc/tables/post_summary.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::compare_test {
namespace {

// Two walls below a springing at 0, and two that go on above it.
TEST(Compare, GraphsOverTheHeightShowCoursesBelowZero) {
  for (const double top : {-0.5, 1.5}) {
    std::vector<std::string> folders;
    for (const char* name : {"one", "two"}) {
      folders.push_back(test::fresh_folder(name));
      write_text_atomically(folders.back() + "/summary.json",
                            post_summary_json(test::column_evaluation(0.6, 0.4)));
      write_text_atomically(folders.back() + "/rings.csv",
                            "height_m,largest_friction_use\n-2.5,0.25\n" + std::to_string(top) + ",0.5\n");
    }
    const std::string page = test::fresh_folder("page");
    compare(folders, page, true);
    const std::string figure = read_text(page + "/figures/rings_largest_friction_use.gp");
    // 3 % of the height beyond each end.
    EXPECT_NE(figure.find(top < 0.0 ? "set yrange [-2.56:-0.44]" : "set yrange [-2.62:1.62]"),
              std::string::npos)
        << figure;
  }
}

// Constructions whose fresh mortar needs cohesion, up to 2 and 3 kPa, and friction.
TEST(Compare, GraphsShowWhatStagesNeed) {
  for (const auto& [column, scale] :
       {std::pair<std::string, double>{"least_stands_Pa", 1e3}, {"least_stands", 0.1}}) {
    std::vector<std::string> folders;
    for (const double most : {2.0, 3.0}) {
      folders.push_back(test::fresh_folder("run" + std::to_string(folders.size())));
      write_text_atomically(folders.back() + "/summary.json",
                            post_summary_json(test::column_evaluation(0.6, 0.4)));
      write_text_atomically(folders.back() + "/stages.csv",
                            "height_m," + column + "\n0.5,0\n1.5," + std::to_string(scale * most) + "\n");
    }
    const std::string page = test::fresh_folder("page");
    compare(folders, page, true);
    const std::string figure = read_text(page + "/figures/stages_" + column + ".gp");
    EXPECT_NE(figure.find(scale > 1.0 ? "\n1.5 3 " : "\n1.5 0.3 "), std::string::npos) << figure;
  }
}

}  // namespace
}  // namespace cupola::compare_test
