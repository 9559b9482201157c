#include "solver/analysis/motion/rest_window.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/solver/motion_scenes.hpp"

namespace cupola::rest_window_test {
namespace {

constexpr double kStep = 0.01, kEnd = 2.0;  // s

/// A window of 0.2 s over a motion of one block along x up to kEnd; `x`: m, as a function of time.
RestWindow follow(const std::function<double(double)>& x, const Analysis::Thresholds& thresholds) {
  const Assembly assembly = testing::box_on_floor({1, 1, 1});
  const Model model = make_model(testing::make_case(0.4, 1e-8, kStep), assembly);
  State state = state_at_rest(model);
  const CollisionModel shapes = make_collision_model(assembly);
  RestWindow window;
  for (int k = 1; k <= std::lround(kEnd / kStep); ++k) {
    state.time = k * kStep;
    state.poses[1].p_WB.x() = x(state.time);
    state.v[0] = (x(state.time) - x(state.time - 1e-6)) / 1e-6;
    window.include(shapes, model, state, std::abs(state.v[0]), thresholds);
  }
  return window;
}

TEST(RestWindow, ATurningPointIsNotRest) {
  const auto swing = [](double time) {
    return 0.01 * std::cos(2.0 * std::numbers::pi * time);
  };  // period 1 s
  const RestWindow window = follow(swing, {.window = 0.2});
  EXPECT_FALSE(window.is_slow({.window = 0.2})) << "its speed is zero at the end";
  // The last sample above 1 mm/s is one step before the turning point.
  EXPECT_NEAR(window.last_fast_time(), kEnd - kStep, 1e-9);
  EXPECT_TRUE(follow(swing, {.window = 0.0}).is_slow({.window = 0.0}))
      << "without a window it counts as rest";
}

TEST(RestWindow, SlowCreepIsNotRest) {
  const Analysis::Thresholds thresholds;
  const RestWindow window = follow([](double time) { return 5e-4 * time; }, thresholds);
  EXPECT_TRUE(window.is_slow(thresholds)) << "half of the threshold";
  EXPECT_NEAR(window.drift(), 5e-4, 1e-12);
  EXPECT_GT(window.drift(), RestWindow::largest_drift(thresholds));
}

TEST(RestWindow, ADecayedVibrationIsRest) {
  const Analysis::Thresholds thresholds;
  const auto vibration = [](double time) { return 0.01 * std::exp(-8.0 * time) * std::sin(60.0 * time); };
  const RestWindow window = follow(vibration, thresholds);
  EXPECT_TRUE(window.is_slow(thresholds));
  EXPECT_LT(window.drift(), RestWindow::largest_drift(thresholds));
}

}  // namespace
}  // namespace cupola::rest_window_test
