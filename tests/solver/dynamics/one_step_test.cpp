#include "tests/verification/one_step.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "tests/solver/motion_scenes.hpp"

// With rigid contacts (E = 0), closed joints and v = 0, the speed after one step from rest depends only on
// geometry and friction: |v| / (g h) is independent of density, scale and h. It is 0 exactly when forces
// within the friction cones balance the dead load. Nonzero speeds are rows of the verification manual.

namespace cupola::one_step_test {
namespace {

using verification::speed_after_one_step;

const Vec3 kDown(0.0, 0.0, -testing::kG);

// A hair inside the limits of linear programmes. 1e-5 is a thousandth of the speeds a hair outside.
TEST(OneStep, IsAtRestInsideTheLimits) {
  EXPECT_LT(speed_after_one_step(testing::make_arch({.thickness = 0.1068}), 0.8, kDown), 1e-5);
  EXPECT_LT(speed_after_one_step(testing::make_arch({.thickness = 0.25}), 0.31, kDown), 1e-5);
  const Vec3 tilted = testing::tilted_gravity(std::tan(8.2 * std::numbers::pi / 180.0));
  EXPECT_LT(speed_after_one_step(testing::make_arch({.thickness = 0.15}), 0.8, tilted), 1e-5);
  EXPECT_LT(speed_after_one_step(testing::ferris_wall(6, false), 0.65, testing::tilted_gravity(0.64)), 1e-5);
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
