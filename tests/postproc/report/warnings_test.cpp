// What a page shows of its warnings, and in which order.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "postproc/report/first_screen.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::warnings_page_test {
namespace {

size_t count(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(Warnings, ManyThatDifferInBlocksAndNumbersAreOneLineThatOpens) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  for (int i = 0; i < 3; ++i)
    e.warnings.push_back(fmt::format("blocks A{} and rib: their joint is only {}e-06 m wide", i, i));
  EXPECT_EQ(count(first_screen(e, {}, nullptr, ""), "<p class=\"warning\">"), 3u);
  for (int i = 3; i < 85; ++i)
    e.warnings.push_back(fmt::format("blocks A{} and sail {}: their joint is only {}e-06 m wide", i, i, i));
  const std::string html = first_screen(e, {}, nullptr, "");
  EXPECT_EQ(count(html, "<p class=\"warning\">"), 0u);
  EXPECT_NE(html.find("<strong>85 warnings</strong> like this: blocks A0 and rib: their"), std::string::npos);
  EXPECT_EQ(count(html, "<li>blocks "), 85u) << "all are in the page";
}

TEST(Warnings, OthersStayOpenBesideMany) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  for (int i = 0; i < 58; ++i)
    e.warnings.push_back(fmt::format("blocks {} and {} overlap by {}e-06 m: too far", i, i + 1, i));
  e.warnings.emplace_back(
      "the case has changed since it was solved: its loads, joints or analysis may differ");
  for (int i = 0; i < 27; ++i)
    e.warnings.push_back(fmt::format("blocks {} and {}: their joint is ignored", i, i + 1));
  const std::string html = first_screen(e, {}, nullptr, "");
  EXPECT_EQ(count(html, "class=\"warning\""), 3u);
  EXPECT_NE(html.find("<strong>Warning:</strong> the case has changed since"), std::string::npos);
}

// The results are of another case; the doubt comes from the blocks.
TEST(Warnings, OfTheResultsComeBeforeDoubtsAboutTheBlocks) {
  const Assembly a = test::column(3);
  Summary summary = test::column_summary(a);
  summary.case_hash = "another";
  const std::string folder = test::fresh_folder("results");
  ResultsWriter writer(folder, content_hash(a));
  test::write_frames({test::column_at_rest(a, test::kGravity, 0.0, 0.6, 0.4)}, summary, &writer);
  writer.write_summary(summary);
  const Evaluation e =
      evaluate(test::column_case(), a, ResultsReader(folder, content_hash(a)), {"blocks overlap"});
  ASSERT_EQ(e.warnings.size(), 2u);
  EXPECT_TRUE(e.warnings[0].starts_with("the case has changed")) << e.warnings[0];
  EXPECT_EQ(e.warnings[1], "blocks overlap");
}

}  // namespace
}  // namespace cupola::warnings_page_test
