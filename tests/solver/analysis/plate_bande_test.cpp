#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/solver/construction_runs.hpp"

// Courses with parallel heads between two uprights, laid at once. theta: slope of the bed; L: clear length;
// d: depth; h: height.

namespace cupola::plate_bande_test {
namespace {

using testing::build;
using testing::Built;
using testing::course_case;
using testing::CourseSpec;
using testing::kFirstCourse;
using testing::kGamma;
using testing::make_course;

constexpr double kTheta = 38.7 * std::numbers::pi / 180.0;

// A course with parallel heads between uprights slides as a whole under Coulomb's law: nothing presses its
// heads, even where an arch could stand (mu_h > 4 d / L). Dilatancy jams it at any friction. In stiff and in
// rigid joints the jammed state, which a static solve finds that does not follow the path from the start,
// must not be taken for one of Coulomb's law.
TEST(Construction, PlateBandeBetweenUprightsJamsOnlyUnderTheAssociatedLaw) {
  const CourseSpec course{.bricks = 4, .length = 0.68, .uprights = true};  // L = 8 d
  const Assembly assembly = make_course(course);
  for (const double compliance : {1e-10, 1e-13, 0.0})
    for (const double share : {0.2, 0.98, 1.02})
      for (const FrictionLaw law : {FrictionLaw::associated, FrictionLaw::coulomb}) {
        Case scene = course_case(kTheta, 0.0);
        scene.analysis.staged.unit = StagedConstruction::Unit::ring;
        scene.analysis.friction_law = law;
        scene.joints.compliance = {compliance, compliance, Compliance::Per::area};
        scene.joints.head = testing::joint_law(share * 0.5);
        const Built built = build(scene, assembly);
        EXPECT_TRUE(law == FrictionLaw::associated ? stands(built.summary.status)
                                                   : moves(built.summary.status))
            << compliance << " m3/N, " << share << ", " << to_string(law) << ": " << built.summary.message;
      }
}

/// Four bricks between a held upright (y < 0) and a free one, which slides without friction along the course:
/// it stands on a fixed plinth, and a fixed stop takes its weight down the slope. The free upright is ring
/// kFirstCourse - 1, all that is held is ring 0.
struct FreeUprightScene {
  double L = 2.72, d = 0.34, h = 0.05;  // L = 8 d

  static constexpr int kUpright = 4;
  Assembly assembly() const {
    const double density = kGamma / testing::kG, width = 1.0;
    std::vector<testing::BoxSpec> boxes{
        {.center = {0, L + 0.5 * width, -0.05}, .size = {d, width, 0.1}, .fixed = true},
        {.center = {d, L + 0.5 * width, 0.5 * h}, .size = {d, width, h}, .fixed = true},
        {.center = {0, 0.5 * L, -0.05}, .size = {d, L, 0.1}},
        {.center = {0, -0.5 * width, 0.5 * h}, .size = {d, width, h}},
        // Heavy, so that the course does not turn it away from the stop.
        {.center = {0, L + 0.5 * width, 0.5 * h},
         .size = {d, width, h},
         .density = 100.0 * density,
         .ring = kFirstCourse - 1}};
    for (int k = 0; k < 4; ++k)
      boxes.push_back({.center = {0, (k + 0.5) * L / 4, 0.5 * h},
                       .size = {d, L / 4, h},
                       .density = density,
                       .ring = kFirstCourse});
    Assembly assembly = testing::make_boxes(boxes);
    assembly.num_rings = kFirstCourse + 1;
    return assembly;
  }
};

// With q = gamma d h (sin theta - mu_b cos theta) - c d the course needs N = q / min(2 mu_h / L, 8 d / L^2):
// its heads slide, or it opens as an arch from L = 4 d / mu_h on, here at mu_h = 0.5. The bed takes its share
// where the course slides as a whole, not where it turns about hinges: friction and cohesion of the bed are
// tried with mu_h below 0.5 only.
TEST(Construction, PlateBandeNeedsItsThrustAndSwitchesFromSlidingToHinging) {
  struct Row {
    double head, bed, cohesion;
  };
  const FreeUprightScene scene_of;
  const Assembly assembly = scene_of.assembly();
  for (const Row row :
       {Row{0.2, 0, 0}, {0.45, 0, 0}, {0.55, 0, 0}, {0.8, 0, 0}, {0.3, 0.2, 0}, {0.3, 0.2, 100}}) {
    const auto [L, d, h] = scene_of;
    const double q = kGamma * d * h * (std::sin(kTheta) - row.bed * std::cos(kTheta)) - row.cohesion * d;
    const double sliding = 2.0 * row.head / L, hinging = 8.0 * d / (L * L);
    ASSERT_EQ(sliding < hinging, L < 4.0 * d / row.head);
    const double needed = q / std::min(sliding, hinging);
    for (const double share : {0.98, 1.02}) {  // compliance moves lever arms by far less
      Case scene = course_case(kTheta, row.bed);
      scene.joints.head = testing::joint_law(row.head);
      scene.joints.base = testing::joint_law(0.0);
      scene.loads.forces = {{.block = FreeUprightScene::kUpright,
                             .point = assembly.blocks[FreeUprightScene::kUpright].centroid,
                             .force = Vec3(0, -share * needed, 0),
                             .time = {}}};
      StagedConstruction& staged = scene.analysis.staged;
      staged.unit = StagedConstruction::Unit::ring;
      staged.first_ring = kFirstCourse;
      staged.hold_below = 1;
      staged.fresh.cohesion = row.cohesion;
      const Built built = build(scene, assembly);
      EXPECT_TRUE(share < 1.0 ? moves(built.summary.status) : stands(built.summary.status))
          << fmt::format("mu_h {}, mu_b {}, c {} Pa, {} of the thrust needed: {}", row.head, row.bed,
                         row.cohesion, share, built.summary.message);
    }
  }
}

}  // namespace
}  // namespace cupola::plate_bande_test
