#include <gtest/gtest.h>

#include "generators/generate.hpp"
#include "solver/analysis/analysis.hpp"

// Critical friction and thickness of domes against linear programmes over the friction cones. Domes with
// aligned joints are reduced to one lune by symmetry; half bond uses a reduction that was checked against the
// full three-dimensional programme. The programmes assume conical beds; ours consist of plane facets. Takes
// minutes, hence `slow`.

namespace cupola::dome_limit_test {
namespace {

Case friction_case(const DomeSurface& dome, const Bond& bond, double low, double high) {
  Case scene;
  scene.geometry.surface = dome;
  scene.geometry.bond = bond;
  scene.analysis.type = AnalysisType::limit;
  scene.analysis.limit.low = low;
  scene.analysis.limit.high = high;
  scene.analysis.limit.relative_width = 2e-3;
  return scene;
}

double critical_value(const Case& scene) {
  const Summary summary = run_limit(scene, generate(scene), {}).value();
  EXPECT_TRUE(summary.critical) << summary.message;
  return summary.critical ? summary.critical->value : 0.0;
}

RunningBond half_bond(int rings, int blocks_per_ring) {
  return {.rings = rings, .blocks_per_ring = blocks_per_ring, .slices_per_block = 4};
}
StackBond aligned(int rings, int blocks_per_ring) {
  return {.rings = rings, .blocks_per_ring = blocks_per_ring, .slices_per_block = 2};
}

// The paper's dome: inner radius 36 m, 39 rings of 33 blocks.
TEST(DomeLimitSlow, FrictionOfThePapersDomeInHalfBond) {
  EXPECT_NEAR(critical_value(friction_case({}, half_bond(39, 33), 0.05, 0.15)) / 0.0848, 1.0, 0.05);
}
TEST(DomeLimitSlow, FrictionOfThePapersDomeWithAlignedJoints) {
  EXPECT_NEAR(critical_value(friction_case({}, aligned(39, 33), 0.1, 0.2)) / 0.1446, 1.0, 0.01);
}

/// Hemisphere of centreline radius 1 m with a small oculus.
DomeSurface hemisphere(double thickness, double crown_angle_deg) {
  return {.span = 2.0 - thickness,
          .radius_ratio = 0.5,
          .thickness = thickness,
          .crown_angle_deg = crown_angle_deg};
}
constexpr double kToTheCrown = 89.5;
constexpr double kCutOff = 84.2704220486918;  // 0.1 rad below

// A faceted bed is effectively thicker than a conical one by the share 1 - cos(pi / blocks); narrow blocks
// keep it small.
constexpr int kNarrow = 96;

TEST(DomeLimitSlow, MinimumThicknessOfTheHemisphere) {
  Case scene = friction_case(hemisphere(0.06, kToTheCrown), aligned(20, kNarrow), 0.5, 1.2);
  scene.joints.friction = 1.0;
  scene.analysis.limit.parameter = LimitSearch::Parameter::thickness;
  EXPECT_NEAR(critical_value(scene) * 0.06 / 0.04268, 1.0, 0.02);
}

TEST(DomeLimitSlow, FrictionOfTheHemisphereWithAlignedJoints) {
  const Case scene = friction_case(hemisphere(0.06, kToTheCrown), aligned(20, kNarrow), 0.15, 0.3);
  EXPECT_NEAR(critical_value(scene) / 0.2253, 1.0, 0.02);
}

TEST(DomeLimitSlow, FrictionOfTheHemisphereInHalfBond) {
  EXPECT_NEAR(critical_value(friction_case(hemisphere(0.1, kCutOff), half_bond(15, 20), 0.05, 0.3)) / 0.1359,
              1.0, 0.05);
  EXPECT_NEAR(critical_value(friction_case(hemisphere(0.15, kCutOff), half_bond(15, 20), 0.05, 0.3)) / 0.1352,
              1.0, 0.05);
  EXPECT_NEAR(critical_value(friction_case(hemisphere(0.1, kCutOff), half_bond(20, 20), 0.05, 0.3)) / 0.1233,
              1.0, 0.05);
  EXPECT_NEAR(critical_value(friction_case(hemisphere(0.1, kCutOff), half_bond(20, 40), 0.05, 0.3)) / 0.1531,
              1.0, 0.05);
}

}  // namespace
}  // namespace cupola::dome_limit_test
