#include "solver/dynamics/integrator.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "solver/analysis/statics/static_start.hpp"
#include "tests/solver/accounted_simulation.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::integrator_test {
namespace {

using testing::kG;
using testing::make_case;

Case second_order(Case scene) {
  scene.analysis.integrator = TimeIntegrator::generalized_alpha;
  return scene;
}

/// log2 of the error at twice the step over the error at the step.
double observed_order(double h, const std::function<double(double)>& error) {
  return std::log2(std::abs(error(2.0 * h) / error(h)));
}

void advance(testing::AccountedSimulation* simulation, double time) {
  while (simulation->state().time < time * (1.0 - 1e-9)) simulation->advance();
}

/// Error of the height of a cube on springs, w = 20 rad/s, released at rest, after 0.2 s.
double spring_error(double h, double alpha) {
  const Assembly assembly = testing::box_on_floor({1, 1, 1});
  testing::AccountedSimulation simulation(second_order(make_case(0.4, 1e-5, h, alpha)), assembly);
  const double time = 0.2, w = 20.0, zeta = 0.5 * alpha * w, wd = w * std::sqrt(1.0 - zeta * zeta);
  advance(&simulation, time);
  const double exact =
      -kG / (w * w) *
      (1.0 - std::exp(-zeta * w * time) * (std::cos(wd * time) + zeta * w / wd * std::sin(wd * time)));
  return simulation.state().poses[1].p_WB.z() - 0.5 - exact;
}

// The exact motion is smooth. The first two steps are of first order, which costs a constant number of local
// errors h^2.
TEST(GeneralizedAlpha, ASpringIsOfSecondOrder) {
  EXPECT_NEAR(observed_order(1e-3, [](double h) { return spring_error(h, 0.0); }), 2.0, 0.1);
  EXPECT_NEAR(observed_order(1e-3, [](double h) { return spring_error(h, 5e-3); }), 2.0, 0.1);
}

/// A free body with three moments of inertia after half a second: relative error of its energy.
double tumbling_error(double h) {
  const Assembly assembly = testing::make_boxes({{.center = {0, 0, 50}, .size = {1, 2, 3}}});
  Case scene = second_order(make_case(0.4, 1e-8, h));
  scene.loads.gravity.setZero();
  testing::AccountedSimulation simulation(scene, assembly);
  simulation.mutable_state()->v << 1, 0, 0, 0.3, 2.0, 0.1;
  const double start = simulation.energy().total();
  advance(&simulation, 0.5);
  return simulation.energy().total() / start - 1.0;
}

TEST(GeneralizedAlpha, AFreeRotationIsOfSecondOrder) {
  EXPECT_GT(observed_order(2e-3, tumbling_error), 1.9);
}

/// Angle of a block of 0.4 m x 2 m that rocks on a nearly rigid edge, 0.4 s after its release.
double rocking_angle(double h, bool euler) {
  const Assembly assembly = testing::box_on_floor({0.4, 1.0, 2.0});
  Case scene = make_case(0.8, 1e-10, h);
  if (!euler) scene = second_order(scene);
  testing::AccountedSimulation simulation(scene, assembly);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.5 * std::atan(0.2), Vec3::UnitY()));
  const Vec3 edge(0.2, 0, 0);
  simulation.mutable_state()->poses[1] = {edge + turn * Vec3(-0.2, 0, 1.0), turn};
  advance(&simulation, 0.4);
  const Eigen::Quaterniond q = simulation.state().poses[1].q_WB;
  return 2.0 * std::atan2(q.y(), q.w());
}

// Between impacts the edge keeps its place. The reference is extrapolated from Euler's first-order errors.
TEST(GeneralizedAlpha, RockingIsFarMoreAccurateThanEuler) {
  const double reference = 2.0 * rocking_angle(1e-4, true) - rocking_angle(2e-4, true);
  const double euler = std::abs(rocking_angle(4e-3, true) - reference);
  const double alpha = std::abs(rocking_angle(4e-3, false) - reference);
  EXPECT_LT(alpha, 0.05 * euler) << alpha << " against " << euler;
}

// A block that falls flat on the floor stays there, with rigid contacts and with compliant ones that the step
// does not resolve.
TEST(GeneralizedAlpha, AnImpactGivesNoEnergy) {
  for (const double compliance : {0.0, 1e-10}) {
    const Assembly assembly = testing::box_on_floor({1.0, 1.0, 0.5});
    testing::AccountedSimulation simulation(second_order(make_case(0.3, compliance, 5e-3)), assembly);
    simulation.mutable_state()->poses[1].p_WB.z() += 0.3;
    const double start = simulation.energy().total();
    double after = 0.0;
    for (int k = 0; k < 200; ++k) {
      const Energy energy = simulation.advance().energy;
      EXPECT_LE(energy.total(), start * (1.0 + 1e-9));
      if (k > 100) after = std::max(after, energy.kinetic);
    }
    EXPECT_LT(after, 1e-6 * start) << "compliance " << compliance;
    // The middle of the step in which it touches may lie below the floor: by at most half a step of the fall.
    EXPECT_NEAR(simulation.state().poses[1].p_WB.z(), 0.25, 0.5 * 5e-3 * std::sqrt(2.0 * kG * 0.3));
  }
}

// A slab that lies on the floor passes the impact of a block that falls on it to the floor: both stop there.
TEST(GeneralizedAlpha, AnImpactThroughAClosedJointActsOnce) {
  const double drop = 1.0, h = 5e-3;
  const Assembly assembly = testing::make_boxes({{.center = {0, 0, -0.5}, .fixed = true},
                                                 {.center = {0, 0, 0.2}, .size = {0.6, 0.6, 0.4}},
                                                 {.center = {0, 0, 0.6 + drop}, .size = {0.6, 0.6, 0.4}}});
  testing::AccountedSimulation simulation(second_order(make_case(0.3, 0.0, h)), assembly);
  double last = simulation.energy().total();
  for (int k = 0; k < 200; ++k) {
    const double now = simulation.advance().energy.total();
    EXPECT_LE(now, last + 1e-6 * assembly.blocks[1].mass * kG * drop) << "the solves, step " << k;
    EXPECT_NEAR(simulation.state().poses[1].p_WB.z(), 0.2, 1e-9) << "the rounding of the solves";
    last = now;
  }
  EXPECT_LT(simulation.state().v.norm(), 1e-6) << "the rounding of the solves";
}

// A block flies into a wall at 1 m/s. The step that brings their faces together may leave any share of the
// impact to the next.
TEST(GeneralizedAlpha, ARigidImpactStopsTheBlock) {
  const double h = 5e-3;
  for (int k = 0; k < 10; ++k) {
    const double gap = (3.0 + 0.1 * k) * h;
    const Assembly assembly =
        testing::make_boxes({{.center = {-0.5, 0, 0}, .fixed = true}, {.center = {0.5 + gap, 0, 0}}});
    Case scene = second_order(make_case(0.0, 0.0, h));
    scene.loads.gravity.setZero();
    testing::AccountedSimulation simulation(scene, assembly);
    simulation.mutable_state()->v[0] = -1.0;
    for (int step = 0; step < 20; ++step) simulation.advance();
    // An approach slower than h (1 m/s2) is taken for a motion under loads, and returns 4/9 of its speed.
    EXPECT_LE(simulation.state().v.norm(), 4.0 / 9.0 * h) << "a gap of " << gap << " m";
  }
}

// Friction of 0.2 on a slope of 0.5 under Coulomb's law.
TEST(GeneralizedAlpha, ASlidingBlockFollowsItsClosedForm) {
  for (const double compliance : {0.0, 1e-9}) {
    const Assembly assembly = testing::box_on_floor({1.0, 0.5, 0.2});
    Case scene = second_order(make_case(0.2, compliance, 5e-3));
    scene.analysis.friction_law = FrictionLaw::coulomb;
    scene.loads.gravity = testing::tilted_gravity(0.5);
    testing::AccountedSimulation simulation(scene, assembly);
    advance(&simulation, 0.5);
    const double a = std::atan(0.5), acceleration = kG * (std::sin(a) - 0.2 * std::cos(a));
    // The first two steps, and a contact that bears its weight one step late: g h each.
    EXPECT_NEAR(simulation.state().v[0], acceleration * 0.5, 0.2 * kG * 5e-3) << "compliance " << compliance;
    EXPECT_NEAR(simulation.state().v[2], 0.0, 1e-6);
  }
}

TEST(GeneralizedAlpha, StartsFromAStaticEquilibriumAtRest) {
  const Assembly assembly = testing::stack_of_cubes(1.0, {1000.0, 1000.0, 1000.0});
  Case scene = second_order(make_case(0.4, 1e-8, 0.01));
  scene.analysis.start = Analysis::Start::static_;
  testing::AccountedSimulation simulation(scene, assembly);
  start_from_equilibrium(
      scene, [](const std::string&) {}, &simulation);
  for (int k = 0; k < 50; ++k) EXPECT_LT(largest_speed((simulation.advance(), simulation.state().v)), 1e-7);
}

// Twice the error per step allows steps longer by a cube root.
TEST(GeneralizedAlpha, AdaptsItsStepsToAnErrorOfThirdOrder) {
  double steps[2] = {0, 0};
  for (const int i : {0, 1}) {
    const Assembly assembly = testing::box_on_floor({1, 1, 1});
    Case scene = second_order(make_case(0.4, 1e-5, 1e-3));
    scene.analysis.adaptive =
        AdaptiveStep{.smallest = 1e-6, .largest = 0.1, .displacement_error = i == 0 ? 8e-7 : 1e-7};
    testing::AccountedSimulation simulation(scene, assembly);
    for (; simulation.state().time < 1.0; ++steps[i]) {
      const double error = simulation.advance().time_error;
      // A larger error has the step repeated; the first steps are of implicit Euler.
      if (steps[i] > 10) {
        EXPECT_LT(error, 4.0 * scene.analysis.adaptive->displacement_error);
      }
    }
  }
  EXPECT_NEAR(steps[1] / steps[0], 2.0, 0.3);
}

// A static start keeps the shear of a level bed, whose contact frame rounding turns by 60 degrees: at rest,
// the reaction of the first steps is that of statics, but for the lean of 1e-5 that statics leaves out.
TEST(GeneralizedAlpha, StaysInStaticEquilibriumUnderAPush) {
  for (const TimeIntegrator integrator : {TimeIntegrator::euler, TimeIntegrator::generalized_alpha})
    for (const double size : {1.0, 0.9, 0.7}) {
      const Assembly assembly = testing::box_on_floor({size, size, size});
      const double weight = assembly.blocks[1].mass * kG;
      Case scene = make_case(0.7, 1e-8, 0.01);
      scene.analysis.integrator = integrator;
      scene.loads.forces.resize(1);
      scene.loads.forces[0].block.number = 1;
      scene.loads.forces[0].force = {0.17 * weight, 0, 0};
      testing::AccountedSimulation simulation(scene, assembly);
      start_from_equilibrium(
          scene, [](const std::string&) {}, &simulation);
      for (int step = 0; step < 3; ++step) {
        Vec3 reaction = Vec3::Zero();
        for (const Vec3& force : simulation.advance().forces.contacts) reaction += force;
        EXPECT_LT((reaction - Vec3(-0.17 * weight, 0, weight)).norm(), 1e-5 * weight) << size << ", " << step;
      }
    }
}

TEST(GeneralizedAlpha, RefusesWhatItDoesNotIntegrate) {
  const Assembly assembly = testing::box_on_floor({1, 1, 1});
  Case scene = second_order(make_case(0.4, 1e-8, 0.01));
  scene.analysis.sleep = Sleep{};
  EXPECT_THROW(testing::simulate(scene, assembly), InputError);
  scene.analysis.sleep.reset();
  scene.supports.moves.emplace_back();
  EXPECT_THROW(testing::simulate(scene, assembly), InputError);
  scene.supports.moves.clear();
  scene.joints.strength.tension = 1e4;
  EXPECT_THROW(testing::simulate(scene, assembly), InputError);
}

// A slab that sticks to a floor is heated slowly: its four corners bear the shear alpha T (0.5 m) / c along x
// and y, its centroid rises by alpha T (0.1 m), and what that takes is the work of the heat.
TEST(GeneralizedAlpha, HeatStretchesTheTangentialSprings) {
  constexpr double kAlpha = 1e-5, kChange = 20.0, c = 1e-6, kShear = kAlpha * kChange * 0.5 / c;
  const Assembly assembly = testing::box_on_floor({1.0, 1.0, 0.2});
  Case scene = second_order(make_case(10.0, c, 0.01, 0.002));
  BlockHeat heat;
  heat.change = kChange;
  heat.expansion = kAlpha;
  heat.time = RampInTime{.start = 1.0, .duration = 1.0};
  scene.loads.heat = {heat};
  testing::AccountedSimulation simulation(scene, assembly);
  double work = 0.0;
  StepReport report;
  while (simulation.state().time < 2.5) work += (report = simulation.advance()).work.supports;
  ASSERT_EQ(report.forces.contacts.size(), 4u);
  // The slab sinks and rises by 1e-5 of the arm of its corners.
  for (const Vec3& force : report.forces.contacts) {
    EXPECT_NEAR(std::abs(force.x()), kShear, 1e-3 * kShear);
    EXPECT_NEAR(std::abs(force.y()), kShear, 1e-3 * kShear);
  }
  const double lift = assembly.blocks[1].mass * kG * kAlpha * kChange * 0.1;
  const double strain = 4 * 2 * 0.5 * c * kShear * kShear;
  // The dampers of 2 ms take 0.4 % of it in the second of heating.
  EXPECT_NEAR(work, lift + strain, 0.01 * (lift + strain));
}

}  // namespace
}  // namespace cupola::integrator_test
