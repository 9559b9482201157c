#include "solver/collision/fast_blocks.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/solver/scenes.hpp"

namespace cupola::fast_blocks_test {
namespace {

constexpr double kStep = 0.1;  // s

/// A fixed plate 0.1 m thick, whose top is at z = 0, and a cube of 0.2 m whose lower face starts `above` it
/// and moves by `way`.
std::optional<FastPair> falling(double above, const Vec3& way, double middle) {
  const Assembly assembly =
      testing::make_boxes({{.center = {0, 0, -0.05}, .size = {4, 4, 0.1}, .fixed = true},
                           {.center = {0, 0, above + 0.1}, .size = Vec3::Constant(0.2)}});
  const std::vector<Pose> from = initial_poses(assembly);
  std::vector<Pose> to = from;
  to[1].p_WB += way;
  return fast_pair(make_collision_model(assembly), from, to, kStep, middle);
}

TEST(FastBlocks, AreThoseThatPassWhatIsOutOfReach) {
  const double radius = 0.1 * std::sqrt(3.0);  // of the cube
  const auto fast = falling(0.3, Vec3(0, 0, -1), 0.0);
  ASSERT_TRUE(fast);
  EXPECT_EQ(fast->block, 1);
  EXPECT_EQ(fast->other, 0);
  EXPECT_NEAR(fast->way, 1.0, 1e-12);
  EXPECT_NEAR(fast->longest, kStep * radius, 1e-12) << "moves by its radius";
  EXPECT_FALSE(falling(0.3, Vec3(0, 0, -0.25), 0.0)) << "does not reach the plate";
  EXPECT_FALSE(falling(0.1, Vec3(0, 0, -1), 0.0)) << "the plate is within its radius";
  EXPECT_FALSE(falling(0.3, Vec3(1, 0, 0), 0.0)) << "passes above it";
}

// Half-way through the step it would be beyond the middle of the plate.
TEST(FastBlocks, AreSlowerWhereContactsAreFoundInTheMiddleOfTheStep) {
  EXPECT_FALSE(falling(0.01, Vec3(0, 0, -0.15), 0.0));
  const auto fast = falling(0.01, Vec3(0, 0, -0.15), 0.5);
  ASSERT_TRUE(fast);
  EXPECT_NEAR(fast->longest, kStep * 0.1 / 0.15, 1e-12) << "moves by the thickness of the plate";
  EXPECT_FALSE(falling(0.01, Vec3(0, 0, -0.09), 0.5));
  EXPECT_FALSE(falling(0.0, Vec3(0.15, 0, 0), 0.5)) << "slides on it";
}

}  // namespace
}  // namespace cupola::fast_blocks_test
