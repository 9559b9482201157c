#include "solver/dynamics/simulation.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/solver/accounted_simulation.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::simulation_test {
namespace {

using testing::kG;
using testing::make_case;
using testing::tilted_gravity;

TEST(NormalCompliance, RestsAtItsElasticDepth) {
  const Assembly assembly = testing::box_on_floor({1, 1, 1}, 1000.0);
  Case scene = make_case(0.4, 2e-6, 0.002, 0.05);
  testing::AccountedSimulation simulation(scene, assembly);
  for (int step = 0; step < 2000; ++step) simulation.advance();
  EXPECT_NEAR(simulation.state().poses[1].p_WB.z() - 0.5, -2e-6 * 1000.0 * kG / 4.0, 1e-9 * 5e-3);
}

// A compliant stack must keep its elastic depth c F under the recovery limit. Paper eq. 14 taken literally
// would limit the force to eps_u h / c = 5 kN, while the foot of the stack carries 5 MN.
TEST(RecoveryLimit, DoesNotChangeElasticDepth) {
  const Assembly assembly = testing::stack_of_cubes(2.0, std::vector<double>(5, 12742.0));
  Case scene = make_case(0.4, 1e-8, 0.01, 0.05);
  scene.analysis.recovery_speed = 0.005;
  testing::AccountedSimulation simulation(scene, assembly);
  for (int step = 0; step < 600; ++step) simulation.advance();
  const double weight = assembly.blocks[1].mass * kG;
  double depth = 0.0;
  for (int k = 1; k <= 5; ++k) {
    depth += 1e-8 * (6 - k) * weight / 4.0;
    const double sunk = assembly.blocks[k].centroid.z() - simulation.state().poses[k].p_WB.z();
    EXPECT_NEAR(sunk / depth, 1.0, 1e-6) << "cube " << k;
  }
}

/// Velocity and depth of a block of weight W = 9810 N on four contacts of c = 1e-8 m/N after 60 steps of the
/// literal scheme.
struct Sinking {
  double velocity, depth;
};
Sinking sink_literally(double h, double alpha, double recovery_speed) {
  const Assembly assembly = testing::box_on_floor({1, 1, 1}, 1000.0);
  Case scene = make_case(0.4, 1e-8, h, alpha);
  scene.analysis.recovery = Recovery::literal;
  scene.analysis.recovery_speed = recovery_speed;
  testing::AccountedSimulation simulation(scene, assembly);
  for (int step = 0; step < 60; ++step) simulation.advance();
  return {simulation.state().v[2], 0.5 - simulation.state().poses[1].p_WB.z()};
}

// Paper eq. 14, 15 at a contact that has penetrated by more than eps_u (h + alpha): b_n = -eps_u, so that u_n
// - eps_u + E gamma_n = 0 with E = c / (h (h + alpha)). Four contacts balance the weight with gamma_n = W h /
// 4, so that the block sinks at -u_n = c W / (4 (h + alpha)) - eps_u, whatever its depth. The way to that
// speed shrinks by 1 + 4 h (h + alpha) / (c m), at least 11, in every step.
TEST(RecoveryLimit, LetsLoadedContactsSinkInTheLiteralScheme) {
  const double W = 1000.0 * kG;
  for (const double h : {0.01, 0.005})
    for (const double alpha : {0.0, 0.002}) {
      const double exact = 1e-8 * W / (4.0 * (h + alpha)) - 5e-4;
      EXPECT_GT(exact, 1e-3);
      // Digits of a position of 0.5 m from which the depth is computed anew.
      EXPECT_NEAR(sink_literally(h, alpha, 5e-4).velocity / -exact, 1.0, 1e-9)
          << h << " s, " << alpha << " s";
    }
}

// Below the limit, cW/4h = 2.5 mm/s, nothing is limited: the block rests at its elastic depth.
TEST(RecoveryLimit, DoesNotChangeLightlyLoadedContactsInTheLiteralScheme) {
  const Sinking rest = sink_literally(0.01, 0.0, 3e-3);
  EXPECT_NEAR(rest.velocity, 0.0, 1e-12);
  EXPECT_NEAR(rest.depth / (1e-8 * 1000.0 * kG / 4.0), 1.0, 1e-9);
}

TEST(RecoveryLimit, LimitsTheRecoveryOfInitialOverlap) {
  Assembly assembly = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {20, 20, 1}, .fixed = true},
                                           {.center = {0, 0, 0.4999}, .size = {1, 1, 1}}});
  Case scene = make_case(0.4, 1e-12, 0.001);
  scene.analysis.recovery_speed = 0.01;
  testing::AccountedSimulation simulation(scene, assembly);
  simulation.advance();
  EXPECT_NEAR(simulation.state().v[2], 0.01, 1e-4);
}

TEST(FreeFlight, KeepsAngularMomentumDirectionAndFallsFreely) {
  const Assembly assembly = testing::make_boxes({{.center = {0, 0, 5}, .size = {1, 2, 3}}});
  Case scene = make_case(0.4, 1e-8, 1e-3);
  testing::AccountedSimulation simulation(scene, assembly);
  simulation.mutable_state()->v << 0, 0, 0, 0.3, 2.0, 0.1;
  const double energy = simulation.energy().total();
  for (int step = 0; step < 200; ++step) simulation.advance();
  EXPECT_NEAR(simulation.state().v[2], -kG * 0.2, 1e-12);
  // Explicit gyroscopic term and implicit fall: energy drifts by O(h); g^2 h t / 2 m of it is the fall's.
  EXPECT_NEAR(simulation.energy().total() / energy, 1.0, 0.02);
}

TEST(SimulationOptions, IncludeAdaptiveStepsSleepAndStaticStart) {
  Case scene = make_case(0.4, 1e-8, 0.01);
  EXPECT_FALSE(simulation_options(scene).static_start);
  scene.analysis.adaptive = AdaptiveStep{};
  scene.analysis.sleep = Sleep{.speed = 2e-3, .time = 0.5};
  scene.joints.friction_time = RampInTime{};
  const SimulationOptions options = simulation_options(scene);
  EXPECT_TRUE(options.adaptive);
  ASSERT_TRUE(options.sleep);
  EXPECT_EQ(options.sleep->speed, 2e-3);
  EXPECT_TRUE(options.static_start) << "automatic: friction varies in time";
  scene.analysis.start = Analysis::Start::rest;
  EXPECT_FALSE(simulation_options(scene).static_start);
}

// A force of 100 N through the centroid pushes a slab of 800 kg and a load of 1200 kg on it over ice. The
// load stands 0.1 m above the centroid, so that the slab tilts on its joints while it starts.
TEST(MassOnTop, IsAcceleratedWithItsBlock) {
  Assembly assembly = testing::box_on_floor({2.0, 2.0, 0.2});
  assembly.face_kinds[static_cast<size_t>(assembly.parts[1].face_start) + 1] = FaceKind::top;
  for (const TimeIntegrator integrator : {TimeIntegrator::euler, TimeIntegrator::generalized_alpha}) {
    Case scene = make_case(0.0, 1e-9, 0.01);
    scene.analysis.integrator = integrator;
    scene.loads.gravity = {0, 0, -kG};
    scene.loads.top_load = TopLoad{.mass = 1200.0};
    scene.loads.forces = {{.block = 1, .point = {}, .force = {100, 0, 0}, .time = {}}};
    testing::AccountedSimulation simulation(scene, assembly);
    for (int step = 0; step < 50; ++step) simulation.advance();
    EXPECT_NEAR(simulation.linear_momentum().x(), 50.0, 1e-9 * 50.0) << "F t, to rounding";
    // It still rocks by the 3 N per corner of the moment on 1e-9 m/N, at 200 Hz.
    EXPECT_NEAR(simulation.state().v[0], 100.0 * 0.5 / 2000.0, 1e-4 * 0.025) << to_string(integrator);
  }
}

}  // namespace
}  // namespace cupola::simulation_test
