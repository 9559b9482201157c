#include "solver/dynamics/simulation.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/solver/motion_scenes.hpp"

namespace cupola::simulation_test {
namespace {

using testing::kG;
using testing::make_case;
using testing::simulate;
using testing::tilted_gravity;

// Block 1.0 x 0.2 m on an incline with tan a = 0.5 > mu = 0.4. Closed form of the discrete associated scheme
// for the speed s_N after step N:
//
//     s_N = A h [N - mu^2 (1 - r^N)],   r = mu^2 / (1 + mu^2),   A = g (sin a - mu cos a)
//
// The gap after the step is h mu s_N.
TEST(Incline, SlidesAsTheClosedFormOfTheAssociatedScheme) {
  const Assembly assembly = testing::box_on_floor({1.0, 0.5, 0.2});
  const double h = 0.01, mu = 0.4;
  // m c / h^2 = 1e-12: the effect of the compliance is below the tolerance 1e-9.
  Case scene = make_case(mu, 1e-12 * h * h / assembly.blocks[1].mass, h);
  scene.loads.gravity = tilted_gravity(0.5);
  Simulation simulation = simulate(scene, assembly);
  const double a = std::atan(0.5);
  const double A = kG * (std::sin(a) - mu * std::cos(a));
  const double r = mu * mu / (1.0 + mu * mu);
  for (int N = 1; N <= 10; ++N) {
    const StepReport report = simulation.advance();
    ASSERT_EQ(report.solve.ending, SolveEnding::converged) << report.solve.message;
    const double speed = A * h * (N - mu * mu * (1.0 - std::pow(r, N)));
    EXPECT_NEAR(simulation.state().v[0] / speed, 1.0, 1e-9) << "step " << N;
    const double height = simulation.state().poses[1].p_WB.z() - assembly.blocks[1].centroid.z();
    EXPECT_NEAR(height / (h * mu * speed), 1.0, 1e-8) << "gap after step " << N;
  }
  EXPECT_NEAR(simulation.state().v[0], 0.086339414522, 1e-10);  // published digits of s_10
}

TEST(Incline, SticksBelowTheFrictionAngleAndSlidesAbove) {
  const Assembly assembly = testing::box_on_floor({1.0, 0.5, 0.2});
  for (const double angle_deg : {21.7, 21.9}) {  // atan 0.4 = 21.80 deg
    Case scene = make_case(0.4, 1e-18, 0.01);
    scene.loads.gravity = tilted_gravity(std::tan(angle_deg * M_PI / 180.0));
    Simulation simulation = simulate(scene, assembly);
    for (int step = 0; step < 20; ++step) simulation.advance();
    if (angle_deg < 21.8) {
      EXPECT_LT(simulation.state().v.norm(), 1e-8);
    } else {
      EXPECT_GT(simulation.state().v[0], 1e-3);
    }
  }
}

// Mass m on a spring of stiffness k = n / c for n contacts, implicit Euler, w2 = k / m:
//
//     v' = (v - g h - w2 h y) / (1 + w2 h (h + alpha)),   y' = y + h v'
TEST(NormalCompliance, IsTheImplicitEulerSpring) {
  const Assembly assembly = testing::box_on_floor({1, 1, 1}, 1000.0);
  const double h = 0.002, k = 2e6, w2 = k / 1000.0;
  for (const double alpha : {0.0, 0.01}) {
    Case scene = make_case(0.4, 4.0 / k, h, alpha);  // four corners
    Simulation simulation = simulate(scene, assembly);
    double v = 0.0, y = 0.0;
    for (int step = 1; step <= 7; ++step) {
      simulation.advance();
      v = (v - kG * h - w2 * h * y) / (1.0 + w2 * h * (h + alpha));
      y += h * v;
      EXPECT_NEAR(simulation.state().v[2] / v, 1.0, 1e-8) << "step " << step << ", alpha " << alpha;
      EXPECT_NEAR((simulation.state().poses[1].p_WB.z() - 0.5) / y, 1.0, 1e-8) << "step " << step;
    }
    if (alpha == 0.0) {
      EXPECT_NEAR(simulation.state().v[2], -0.1247186406, 1e-9);  // published v7
    }
  }
}

TEST(NormalCompliance, RestsAtItsElasticDepth) {
  const Assembly assembly = testing::box_on_floor({1, 1, 1}, 1000.0);
  Case scene = make_case(0.4, 2e-6, 0.002, 0.05);
  Simulation simulation = simulate(scene, assembly);
  for (int step = 0; step < 2000; ++step) simulation.advance();
  EXPECT_NEAR(simulation.state().poses[1].p_WB.z() - 0.5, -2e-6 * 1000.0 * kG / 4.0, 1e-9 * 5e-3);
}

// Tangential force T per contact on a sticking block. `literal` (paper): creeps at u = c T / h. `memory`:
// rests at the static offset c T.
TEST(TangentialSpring, CreepsWhenLiteralAndRestsWithMemory) {
  const Assembly assembly = testing::box_on_floor({4, 4, 0.5}, 1000.0);
  const double h = 0.01, c = 1e-10;
  Case scene = make_case(0.8, c, h, 0.02);
  scene.loads.gravity = tilted_gravity(0.3);
  const double T = assembly.blocks[1].mass * scene.loads.gravity.x() / 4.0;

  scene.analysis.tangential = TangentialSpring::literal;
  Simulation literal = simulate(scene, assembly);
  for (int step = 0; step < 400; ++step) literal.advance();
  // Damping enters E as h (h + alpha).
  EXPECT_NEAR(literal.state().v[0] / (c * T / (h + 0.02)), 1.0, 1e-6);

  scene.analysis.tangential = TangentialSpring::memory;
  Simulation memory = simulate(scene, assembly);
  for (int step = 0; step < 2000; ++step) memory.advance();
  EXPECT_LT(memory.state().v.norm(), 1e-10);
  // The foot moves by c T. The centroid moves further because the block tilts about y.
  const Pose& pose = memory.state().poses[1];
  const Vec3 foot = pose.p_WB + pose.q_WB * Vec3(0, 0, -0.25);
  EXPECT_NEAR(foot.x() / (c * T), 1.0, 1e-6);
}

// A compliant stack must keep its elastic depth c F under the recovery limit. Paper eq. 14 taken literally
// would limit the force to eps_u h / c = 5 kN, while the foot of the stack carries 5 MN.
TEST(RecoveryLimit, DoesNotChangeElasticDepth) {
  const Assembly assembly = testing::stack_of_cubes(2.0, std::vector<double>(5, 12742.0));
  Case scene = make_case(0.4, 1e-8, 0.01, 0.05);
  scene.analysis.recovery_speed = 0.005;
  Simulation simulation = simulate(scene, assembly);
  for (int step = 0; step < 600; ++step) simulation.advance();
  const double weight = assembly.blocks[1].mass * kG;
  double depth = 0.0;
  for (int k = 1; k <= 5; ++k) {
    depth += 1e-8 * (6 - k) * weight / 4.0;
    const double sunk = assembly.blocks[k].centroid.z() - simulation.state().poses[k].p_WB.z();
    EXPECT_NEAR(sunk / depth, 1.0, 1e-6) << "cube " << k;
  }
}

TEST(RecoveryLimit, LimitsTheRecoveryOfInitialOverlap) {
  Assembly assembly = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {20, 20, 1}, .fixed = true},
                                           {.center = {0, 0, 0.4999}, .size = {1, 1, 1}}});
  Case scene = make_case(0.4, 1e-12, 0.001);
  scene.analysis.recovery_speed = 0.01;
  Simulation simulation = simulate(scene, assembly);
  simulation.advance();
  EXPECT_NEAR(simulation.state().v[2], 0.01, 1e-4);
}

// Rigid plate on four legs at (+-1, +-1) with its weight W at (0.3, 0.2): F = W (0.375, 0.275, 0.225, 0.125)
// for any compliance. The feet have the half-width a, so that the contact points are at 1 +- a, which divides
// the deviations of the forces from W / 4 by 1 + a^2.
TEST(Table, SharesAnEccentricLoadAmongFourLegs) {
  const double a = 0.01;
  Assembly assembly = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {20, 20, 1}, .fixed = true}});
  const double plate_mass = 3.0 * 3.0 * 0.2, legs_mass = 4.0 * 4.0 * a * a * 1.0;
  const Vec3 shift = Vec3(0.3, 0.2, 0.0) * (plate_mass + legs_mass) / plate_mass;
  testing::add_box({.center = Vec3(0, 0, 1.1) + shift, .size = {3, 3, 0.2}}, &assembly);
  for (const double x : {1.0, -1.0})
    for (const double y : {1.0, -1.0}) {
      testing::add_box({.center = {x, y, 0.5}, .size = {2 * a, 2 * a, 1}}, &assembly);
      assembly.blocks.pop_back();
      assembly.parts.back().block = 1;
    }
  compute_mass_properties(&assembly);
  ASSERT_NEAR((assembly.blocks[1].centroid - Vec3(0.3, 0.2, 0)).head<2>().norm(), 0.0, 1e-12);

  for (const double c : {1e-8, 1e-10}) {
    Case scene = make_case(0.0, c, 1e4);
    Simulation simulation = simulate(scene, assembly);
    const StepReport report = simulation.advance();
    ASSERT_EQ(report.solve.ending, SolveEnding::converged) << report.solve.message;
    Eigen::Vector4d share = Eigen::Vector4d::Zero();  // ++, +-, -+, --
    for (size_t i = 0; i < report.forces.contacts.size(); ++i) {
      const Vec3 p = simulation.contacts().points[i].point_a;
      share[(p.x() > 0 ? 0 : 2) + (p.y() > 0 ? 0 : 1)] += report.forces.contacts[i].z();
    }
    share /= assembly.blocks[1].mass * kG;
    const Eigen::Vector4d point_legs(0.375, 0.275, 0.225, 0.125);
    const Eigen::Vector4d expected =
        Eigen::Vector4d::Constant(0.25) + (point_legs - Eigen::Vector4d::Constant(0.25)) / (1 + a * a);
    EXPECT_LT((share - expected).cwiseAbs().maxCoeff(), 1e-6) << "c = " << c << "\n" << share.transpose();
  }
}

TEST(FreeFlight, KeepsAngularMomentumDirectionAndFallsFreely) {
  const Assembly assembly = testing::make_boxes({{.center = {0, 0, 5}, .size = {1, 2, 3}}});
  Case scene = make_case(0.4, 1e-8, 1e-3);
  Simulation simulation = simulate(scene, assembly);
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

}  // namespace
}  // namespace cupola::simulation_test
