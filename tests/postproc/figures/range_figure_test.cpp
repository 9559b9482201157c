// Bars of ranges: groups by unit, marks, open ends.

#include <algorithm>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "postproc/figures/figures.hpp"
#include "tests/postproc/ranges.hpp"

namespace cupola::range_figure_test {
namespace {

Evaluation with_ranges(std::vector<ForceRange> ranges) {
  Evaluation e;
  e.summary.analysis = AnalysisType::range;
  e.summary.ranges = std::move(ranges);
  e.summary.weight_N = 100e6;
  return e;
}

/// Rows of all data blocks of a name, one list per panel.
std::vector<std::vector<std::vector<double>>> blocks_of(const Figure& figure, const std::string& name) {
  std::vector<std::vector<std::vector<double>>> blocks;
  const std::string head = "$" + name + " << EOD\n";
  for (size_t at = figure.commands.find(head); at != std::string::npos;
       at = figure.commands.find(head, at + 1)) {
    std::istringstream lines(figure.commands.substr(at + head.size()));
    auto& rows = blocks.emplace_back();
    for (std::string line; std::getline(lines, line) && line != "EOD";) {
      std::istringstream numbers(line);
      auto& row = rows.emplace_back();
      for (double number = 0.0; numbers >> number;) row.push_back(number);
    }
  }
  return blocks;
}

TEST(RangeFigure, QuantitiesOfOneUnitShareAnAxis) {
  const Figure figure = range_figure(with_ranges(test::some_ranges()));
  const auto bars = blocks_of(figure, "bars"), marks = blocks_of(figure, "marks");
  ASSERT_EQ(bars.size(), 3u) << "MN, ratios and kN";
  ASSERT_EQ(bars[0].size(), 2u) << "thrust and hoop force";
  EXPECT_NEAR(bars[0][0][2], 12.1, 1e-9);
  EXPECT_NEAR(bars[0][0][3], 40.0, 1e-9);
  EXPECT_NEAR(bars[1][0][3], 1.0, 1e-12);
  EXPECT_NEAR(bars[2][0][3], 4.0, 1e-12);
  EXPECT_NEAR(marks[0][0][0], 20.0, 1e-9);
  EXPECT_NEAR(marks[0][1][0], 0.1, 1e-9);
  EXPECT_TRUE(marks[2].empty()) << "no chosen state";
  for (const char* text :
       {"'MN'", "'ratio'", "'kN'", "'12.1'", "'40'", "'0.15?'", "'outward thrust' 2", "times the weight"})
    EXPECT_NE(figure.commands.find(text), std::string::npos) << text;
}

TEST(RangeFigure, AnUnboundedEndIsAnArrowBeyondAllBars) {
  const auto arrows = blocks_of(range_figure(with_ranges(test::some_ranges())), "arrows");
  ASSERT_EQ(arrows[0].size(), 1u);
  EXPECT_NEAR(arrows[0][0][0], 40.0, 1e-9) << "starts at the largest value of its axis";
  EXPECT_GT(arrows[0][0][2], 0.0);
  EXPECT_TRUE(arrows[1].empty());
}

TEST(RangeFigure, DrawsWhatHasNoValue) {
  ForceRange none{"tie 3", "N", {}, {}, {}}, open = none;
  open.min.outcome = open.max.outcome = RangeOutcome::unbounded;
  const Figure figure = range_figure(with_ranges({none, open}));
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) GTEST_SKIP() << "gnuplot is not installed";
  const std::string folder = test::fresh_folder("figures");
  EXPECT_TRUE(draw_figures(folder, {figure, range_figure(with_ranges(test::some_ranges()))}).empty());
  EXPECT_TRUE(std::filesystem::exists(folder + "/ranges.svg"));
}

TEST(RangeFigure, SaysHowManyQuantitiesItLeavesOut) {
  const Figure figure = range_figure(with_ranges(std::vector<ForceRange>(40, test::some_ranges()[0])));
  EXPECT_EQ(blocks_of(figure, "bars")[0].size(), 30u);
  EXPECT_NE(figure.caption.find("The first 30 of 40"), std::string::npos);
}

TEST(ThrustFigure, DrawsTheEndsOfTheRangeBesideTheChosenLine) {
  Assembly a = test::column(3);
  a.sheets.front().thrust_lines = Sheet::ThrustLines::one;
  const Evaluation e = test::evaluated(a, test::range_frames(a), test::range_summary(a), test::column_case(),
                                       test::fresh_folder("results"));
  const Figure figure = thrust_figure(e, e.meridians[0]);
  EXPECT_EQ(blocks_of(figure, "least").at(0).size(), 3u);
  EXPECT_EQ(blocks_of(figure, "greatest").at(0).size(), 3u);
  for (const char* title :
       {"title 'thrust line (chosen)'", "title 'least thrust'", "title 'greatest thrust'"})
    EXPECT_NE(figure.commands.find(title), std::string::npos) << title;
  Evaluation of_static = e;
  of_static.summary.ranges.clear();
  MeridianEvaluation plain = e.meridians[0];
  plain.least_thrust.reset();
  plain.greatest_thrust.reset();
  const Figure without = thrust_figure(of_static, plain);
  EXPECT_NE(without.commands.find("title 'thrust line'"), std::string::npos);
  EXPECT_EQ(without.commands.find("least thrust"), std::string::npos);
}

ForceRange joint_range(int a, int b, RangeEnd min, RangeEnd max) {
  return {fmt::format("normal force of joint {}-{}", a, b), "N", min, max, {}, std::pair{a, b}};
}

// A column of three blocks on block 0: the joint with the support at the foot, the others between rings.
TEST(CertaintyMap, ColoursEachJointByTheWidthOfItsRangeOverItsMean) {
  const Assembly a = test::column(3);
  Summary summary = test::range_summary(a);
  summary.ranges = {joint_range(0, 1, test::bounded_end(2.0, 2.0, 1), test::bounded_end(2.0, 2.0, 2)),
                    joint_range(1, 2, test::bounded_end(1.0, 1.0, 1), test::bounded_end(3.0, 3.0, 2)),
                    joint_range(2, 3, test::bounded_end(1.0, 1.0, 1), {RangeOutcome::unbounded, {}, {}, {}})};
  const Evaluation e =
      test::evaluated(a, test::range_frames(a), summary, test::column_case(), test::fresh_folder("results"));
  const Figure figure = certainty_map(e, shell_maps(e).front());
  const auto joints = blocks_of(figure, "joints").at(0), unlimited = blocks_of(figure, "unlimited").at(0);
  ASSERT_EQ(joints.size(), 2u);
  EXPECT_EQ(joints[0][1], 0.0) << "the foot";
  EXPECT_EQ(joints[0][4], 0.0) << "certain";
  EXPECT_EQ(joints[1][1], 1.0);
  EXPECT_EQ(joints[1][4], 1.0) << "from 1 to 3 about 2";
  EXPECT_GT(joints[1][2], 0.0) << "level";
  EXPECT_EQ(joints[1][3], 0.0) << "level";
  ASSERT_EQ(unlimited.size(), 1u);
  EXPECT_EQ(unlimited[0][1], 2.0);
  EXPECT_EQ(blocks_of(figure, "unknown").at(0).size(), 0u);
  EXPECT_NE(figure.commands.find("set xlabel 'along the wall (m)'"), std::string::npos)
      << "it may run along y";
}

}  // namespace
}  // namespace cupola::range_figure_test
