#include <gtest/gtest.h>

#include "tests/solver/motion_scenes.hpp"

// With rigid contacts (E = 0), closed joints and v = 0, the speed after one step from rest depends only on
// geometry and friction: |v| / (g h) is independent of density, scale and h. It is 0 exactly when forces
// within the friction cones balance the dead load. The reference values come from another program, which
// solved a non-negative least squares problem over the edges of the plane cones. They are the larger of the
// horizontal and the vertical component of the block velocities, not the norm.

namespace cupola::one_step_test {
namespace {

/// Largest component of a block's velocity after one step, over g h.
double speed_after_one_step(const Assembly& assembly, double friction, const Vec3& gravity) {
  Case scene = testing::make_case(friction, 0.0, 0.01);
  scene.analysis.tolerance = 1e-9;
  scene.loads.gravity = gravity;
  Simulation simulation = testing::simulate(scene, assembly);
  const StepReport report = simulation.advance();
  EXPECT_EQ(report.solve.ending, SolveEnding::converged) << report.solve.message;
  double largest = 0.0;
  for (Eigen::Index i = 0; i < simulation.state().v.size(); i += 6)
    largest = std::max(largest, simulation.state().v.segment<3>(i).cwiseAbs().maxCoeff());
  return largest / (gravity.norm() * scene.analysis.time_step);
}

struct Row {
  double at, speed;
};

void expect_speed(double found, double expected, double at) {
  if (expected == 0.0)
    EXPECT_LT(found, 1e-5) << "at " << at;
  else
    EXPECT_NEAR(found / expected, 1.0, 1e-3) << "at " << at << ": " << found << ", expected " << expected;
}

const Vec3 kDown(0.0, 0.0, -testing::kG);

// Thickness relative to the minimum thickness, on whose fifth digit the speeds near the limit depend.
TEST(OneStep, SpeedOfASemicircleTooThin) {
  constexpr double kMinimum = 0.10672;  // t/R
  for (const Row& row : std::initializer_list<Row>{{1.0008 * kMinimum, 0.0},
                                                   {0.99 * kMinimum, .006331},
                                                   {0.98 * kMinimum, .01264},
                                                   {0.95 * kMinimum, .03142},
                                                   {0.90 * kMinimum, .06221},
                                                   {0.08, .1587}})
    expect_speed(speed_after_one_step(testing::make_arch({.thickness = row.at}), 0.8, kDown), row.speed,
                 row.at);
}

TEST(OneStep, SpeedOfASemicircleWithTooLittleFriction) {
  for (const Row& row : std::initializer_list<Row>{{.31, 0}, {.30, .01635}, {.28, .05213}, {.20, .2091}})
    expect_speed(speed_after_one_step(testing::make_arch({.thickness = .25}), row.at, kDown), row.speed,
                 row.at);
}

TEST(OneStep, SpeedOfASemicircleOnATiltingGround) {
  for (const Row& row : std::initializer_list<Row>{{8.2, 0}, {8.4, .002830}, {8.7, .009331}, {9.5, .02664}}) {
    const Vec3 gravity = testing::tilted_gravity(std::tan(row.at * std::numbers::pi / 180.0));
    expect_speed(speed_after_one_step(testing::make_arch({.thickness = .15}), 0.8, gravity), row.speed,
                 row.at);
  }
}

TEST(OneStep, SpeedOfTheWallOfFerrisAndTinLoi) {
  for (const Row& row : std::initializer_list<Row>{{.64, 0}, {.65, .005775}, {.66, .01250}, {.70, .03543}})
    expect_speed(speed_after_one_step(testing::ferris_wall(6, false), 0.65, testing::tilted_gravity(row.at)),
                 row.speed, row.at);
}

TEST(OneStep, SpeedDependsOnlyOnGeometryAndFriction) {
  const testing::ArchSpec arch{.voussoirs = 11, .thickness = 0.09};
  const double speed = speed_after_one_step(testing::make_arch(arch), 0.8, kDown);
  EXPECT_GT(speed, 1e-2);
  testing::ArchSpec heavy = arch;
  heavy.density = 3e4;
  EXPECT_NEAR(speed_after_one_step(testing::make_arch(heavy), 0.8, kDown) / speed, 1.0, 1e-6);
  testing::ArchSpec wide = arch;
  wide.width = 2.0;
  EXPECT_NEAR(speed_after_one_step(testing::make_arch(wide), 0.8, kDown) / speed, 1.0, 1e-6);
  const Assembly large = testing::transformed(testing::make_arch(arch), Eigen::Isometry3d::Identity(), 40.0);
  EXPECT_NEAR(speed_after_one_step(large, 0.8, kDown) / speed, 1.0, 1e-6);
}

}  // namespace
}  // namespace cupola::one_step_test
