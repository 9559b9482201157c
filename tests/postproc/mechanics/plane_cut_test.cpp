#include "postproc/mechanics/plane_cut.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "postproc/evaluation/quantity_text.hpp"
#include "postproc/figures/figures.hpp"
#include "postproc/report/report.hpp"
#include "postproc/tables/mesh_output.hpp"
#include "postproc/tables/post_summary.hpp"
#include "postproc/tables/result_tables.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::plane_cut_test {
namespace {

using test::kGravity;

const double kBlockWeight = 0.48 * 1800.0 * kGravity;

Evaluation column_with(const std::vector<CutPlane>& planes) {
  const Assembly a = test::column(3);
  Case scene = test::column_case();
  scene.postproc.planes = planes;
  return test::evaluated(a, {test::column_at_rest(a, kGravity, 0.0, 0.7, 0.3)}, test::column_summary(a),
                         scene, test::fresh_folder("results"));
}

TEST(PlaneCut, HorizontalPlaneCarriesTheWeightAbove) {
  const Evaluation e = column_with({{"level", {0, 0, 0.9}, {0, 0, 3}}});
  ASSERT_EQ(e.planes.size(), 1u);
  const PlaneCut& cut = e.planes[0];
  EXPECT_NEAR(cut.normal.norm(), 1.0, 1e-15);
  // Centroids at 0.25, 0.75 and 1.25 m: one block lies beyond, on one joint.
  ASSERT_EQ(cut.joints.size(), 1u);
  EXPECT_NEAR(cut.across.force.z(), kBlockWeight, 1e-12 * kBlockWeight);
  EXPECT_NEAR(cut.load_beyond.z(), -kBlockWeight, 1e-12 * kBlockWeight);
  EXPECT_LT(cut.relative_difference, 1e-14);
  EXPECT_EQ(cut.from_supports.norm(), 0.0);
  ASSERT_EQ(cut.polygons.size(), 1u);
  EXPECT_NEAR(polygon_area(cut.polygons[0].outline), 0.96, 1e-12);
  // The resultant acts at (0.7, 0.3); moment about the point of the plane.
  EXPECT_NEAR(cut.across.moment.x(), 0.3 * kBlockWeight, 1e-12 * kBlockWeight);
  EXPECT_NEAR(cut.across.moment.y(), -0.7 * kBlockWeight, 1e-12 * kBlockWeight);
}

TEST(PlaneCut, SupportForcesCountSeparatelyInTheBalance) {
  // All blocks lie beyond a horizontal plane below the ground: no joint crosses it, and the support carries
  // the load.
  const Evaluation e = column_with({{"ground", {0, 0, -0.2}, {0, 0, 1}}});
  EXPECT_TRUE(e.planes[0].joints.empty());
  EXPECT_NEAR(e.planes[0].from_supports.z(), 3.0 * kBlockWeight, 1e-12 * kBlockWeight);
  EXPECT_LT(e.planes[0].relative_difference, 1e-14);
}

TEST(PlaneCut, ReversingTheNormalReversesTheForces) {
  const Vec3 oblique(0.5, -0.2, 1.0);
  const Evaluation e = column_with({{"a", {0.6, 0.4, 0.6}, oblique}, {"b", {0.6, 0.4, 0.6}, -oblique}});
  const PlaneCut &a = e.planes[0], &b = e.planes[1];
  ASSERT_EQ(a.joints, b.joints);
  ASSERT_EQ(a.joints.size(), 1u);
  EXPECT_LT((a.across.force + b.across.force).norm(), 1e-12 * kBlockWeight) << "action and reaction";
  EXPECT_LT((a.across.moment + b.across.moment).norm(), 1e-12 * kBlockWeight);
  // Compression is positive seen from either side.
  EXPECT_NEAR(a.across.force.dot(a.normal), b.across.force.dot(b.normal), 1e-12 * kBlockWeight);
  EXPECT_LT(a.relative_difference, 1e-14);
  EXPECT_LT(b.relative_difference, 1e-14);
}

// Rounding, as of the corners of a dome, put one block of a symmetric pair beyond and the other not.
TEST(PlaneCut, ABlockWhoseCentroidIsOnThePlaneIsBeyondNeitherSide) {
  for (const double rounding : {-1e-15, 0.0, 1e-15}) {
    const Evaluation e = column_with(
        {{"up", {0, 0, 0.75 + rounding}, {0, 0, 1}}, {"down", {0, 0, 0.75 + rounding}, {0, 0, -1}}});
    EXPECT_NEAR(e.planes[0].load_beyond.z() / -kBlockWeight, 1.0, 1e-12) << "the upper block";
    EXPECT_NEAR(e.planes[1].load_beyond.z() / -kBlockWeight, 1.0, 1e-12) << "the lower block";
  }
}

TEST(PlaneCut, AppearsInTablesFiguresAndFiles) {
  Evaluation e = column_with({{"level", {0, 0, 0.9}, {0, 0, 1}}, {"upright", {0.6, 0.4, 0}, {1, 0, 0}}});
  const Table table = plane_table(e, e.planes[0]);
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_NEAR(std::get<double>(table.rows[0][10]), kBlockWeight, 1e-12 * kBlockWeight) << "through";
  EXPECT_NEAR(std::get<double>(table.rows[0][11]), 0.0, 1e-12 * kBlockWeight) << "along";
  const Figure figure = plane_figure(e, e.planes[0]);
  EXPECT_EQ(figure.name, "cut_level");
  EXPECT_NE(figure.commands.find("$presses w p"), std::string::npos);
  EXPECT_EQ(figure.commands.find("$pulls w p"), std::string::npos) << "no joint is in tension";
  const Mesh sections = sections_mesh(e);
  const auto what = sections.array<std::int32_t>(sections.cell_data, "what", 1);
  const auto cut = sections.array<std::int32_t>(sections.cell_data, "cut", 1);
  int segments = 0;
  for (size_t i = 0; i < what.size(); ++i) segments += what[i] == 0 && cut[i] == 1 ? 1 : 0;
  EXPECT_EQ(segments, 1) << "cut 0 is the section at 0.8 m";
  const auto says = [&e](const std::string& text) {
    std::string all = plane_figure(e, e.planes[0]).caption;
    for (const std::string& sentence : finding_sentences(e)) all += sentence;
    return all.find(text) != std::string::npos;
  };
  EXPECT_TRUE(says("1 joint exerts "));
  EXPECT_FALSE(says("ties")) << "there are none";
  e.planes[0].from_ties.z() = -2.0 * kBlockWeight;
  EXPECT_TRUE(says("The ties across it exert -" + force_text(2.0 * kBlockWeight) + " along the normal"));
  EXPECT_TRUE(says(", and the ties a pull of " + force_text(2.0 * kBlockWeight) + "."));
  EXPECT_NE(post_summary_json(e).find("\"upright\""), std::string::npos);
}

}  // namespace
}  // namespace cupola::plane_cut_test
