// Levels and sections of arches and walls are seen from the side, whichever way they run.

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "postproc/figures/figures.hpp"
#include "postproc/tables/mesh_output.hpp"
#include "tests/postproc/figures/figure_data.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::elevation_test {
namespace {

using test::data_of;
using test::kGravity;

const double kBlockWeight = 0.48 * 1800.0 * kGravity;

TEST(LevelsFigure, DrawsSegmentsAndScaleBarToOneScale) {
  const Evaluation e = test::column_evaluation(0.9, 0.3, 10.0);
  const Figure figure = levels_figure(e);
  const auto flat = data_of(figure, "flat"), measure = data_of(figure, "measure");
  ASSERT_EQ(flat.size(), 1u);
  ASSERT_EQ(measure.size(), 1u);
  EXPECT_TRUE(data_of(figure, "upright").empty());
  // A wall is seen along y: the segment starts at (x, z) and points straight up.
  EXPECT_NEAR(flat[0][0], 0.9, 1e-8);
  EXPECT_NEAR(flat[0][1], 1.0, 1e-8);
  EXPECT_NEAR(flat[0][2], 0.0, 1e-8);
  const double metres_per_newton = flat[0][3] / (31.0 * kBlockWeight);
  EXPECT_NEAR(metres_per_newton, segment_scale(e.assembly, 31.0 * kBlockWeight), 1e-8 * metres_per_newton);
  // 262.8 kN are shown in MN; the scale bar is the largest round force below, 0.2 MN.
  EXPECT_NEAR(measure[0][3], 2e5 * metres_per_newton, 1e-8);
  EXPECT_NE(figure.commands.find("'0.2 MN'"), std::string::npos);
  // Faces of the three free blocks: five rows each, since outlines are closed.
  EXPECT_EQ(data_of(figure, "outlines").size(), 15u);
}

TEST(SectionFigure, StatesScaleAndSum) {
  const Evaluation e = test::column_evaluation(0.9, 0.3, 10.0);
  const Figure figure = section_figure(e, e.sections[0]);
  const auto norms = data_of(figure, "norms");
  ASSERT_EQ(norms.size(), 1u);
  EXPECT_NEAR(norms[0][0], 0.9, 1e-8);
  EXPECT_NEAR(1e6 * norms[0][1], 31.0 * kBlockWeight, 1e-8 * 31.0 * kBlockWeight);
  EXPECT_NE(figure.caption.find("nearest course 2, on the part above"), std::string::npos);
  EXPECT_NE(figure.caption.find(fmt::format("add up to {:.5g} MN", 31e-6 * kBlockWeight)), std::string::npos)
      << figure.caption;
}

/// The column with its resultants at (0.9, 0.3), a push along its courses and the sheet of a wall or an arch,
/// turned about the z axis and moved.
Evaluation turned(Sheet::ThrustLines lines, double turn, const Vec3& origin) {
  Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, kGravity, 0.0, 0.9, 0.3);
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
  for (Vec3& vertex : a.vertices) vertex = origin + rotation * vertex;
  compute_mass_properties(&a);
  ContactTable& c = frame.contacts;
  for (int i = 0; i < c.size(); ++i) {
    c.point[i] = origin + rotation * c.point[i];
    c.force[i] = rotation * Vec3(0.2 * c.normal_force[i], 0.0, c.normal_force[i]);
  }
  for (size_t b = 0; b < a.blocks.size(); ++b) frame.blocks.position[b] = a.blocks[b].centroid;
  Sheet& sheet = a.sheets.front();
  sheet.thrust_lines = lines;
  sheet.origin = origin;
  sheet.turn = turn;
  return test::evaluated(a, {frame}, test::column_summary(a), test::column_case(),
                         test::fresh_folder("results"));
}

// Turned by 30 and 90 degrees, and by 180, both figures show the same places as unturned.
TEST(Elevation, IsSeenAcrossTheSpanOrTheCourses) {
  using enum Sheet::ThrustLines;
  constexpr double kDigits = 1e-5;  // that figures keep, relative to numbers near 1
  for (const auto lines : {one, none}) {
    for (const double turn : {0.0, 30.0, 90.0, 180.0}) {
      const Evaluation e = turned(lines, turn / kDegrees, turn == 0.0 ? Vec3::Zero() : Vec3(5.0, -3.0, 0.0));
      const auto flat = data_of(levels_figure(e), "flat"), outlines = data_of(levels_figure(e), "outlines");
      ASSERT_EQ(flat.size(), 1u);
      EXPECT_NEAR(flat[0][2], 0.2 * flat[0][3], kDigits) << turn << ": the push";
      double low = 1e300, high = -low;
      for (const auto& row : outlines) {
        low = std::min(low, row[0]);
        high = std::max(high, row[0]);
      }
      EXPECT_NEAR(high - low, 1.2, kDigits) << turn;
      EXPECT_NEAR(flat[0][0] - low, 0.9, kDigits) << turn;
      const Figure section = section_figure(e, e.sections.at(0));
      EXPECT_NEAR(data_of(section, "norms").at(0)[0], 0.9, kDigits) << turn << ": in the frame of the member";
      EXPECT_NE(section.commands.find(lines == one ? "set xlabel 'x (m)'\nset ylabel 'res"
                                                   : "set xlabel 'along the wall (m)'\nset ylabel 'res"),
                std::string::npos);
    }
  }
}

// Of two arches at right angles neither is drawn edge-on.
TEST(Elevation, IsNotThatOfArchesThatSpanSeveralWays) {
  Evaluation e = turned(Sheet::ThrustLines::one, 0.0, Vec3::Zero());
  const double upright = data_of(levels_figure(e), "flat").at(0)[1];
  EXPECT_NEAR(upright, 1.0, 1e-5) << "the height of the bed; figures keep six digits";
  e.assembly.sheets.insert(e.assembly.sheets.begin(), e.assembly.sheets.front());
  e.assembly.sheets.front().turn = 90.0 / kDegrees;
  EXPECT_GT(std::abs(data_of(levels_figure(e), "flat").at(0)[1] - upright), 0.1);
  e.assembly.sheets.front().turn = 180.0 / kDegrees;
  EXPECT_EQ(data_of(levels_figure(e), "flat").at(0)[1], upright);
}

}  // namespace
}  // namespace cupola::elevation_test
