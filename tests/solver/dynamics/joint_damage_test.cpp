#include "solver/dynamics/joint_damage.hpp"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "solver/analysis/statics/static_start.hpp"
#include "tests/solver/accounted_simulation.hpp"
#include "tests/solver/motion_scenes.hpp"

// Blocks with one joint that has strength, in motion.

namespace cupola::joint_damage_test {
namespace {

using testing::kG;

constexpr double kDensity = 1000.0, kCompliance = 1e-10;  // kg/m3, m3/N
const Vec3 kSize(1.0, 1.0, 0.2);                          // m; flat, so that shear does not open the joint
constexpr double kArea = 1.0, kMass = 200.0;              // m2, kg

Case glued_case(const JointStrength& strength, double h) {
  Case scene = testing::make_case(0.6, kCompliance, h);
  scene.joints.compliance = {kCompliance, kCompliance, Compliance::Per::area};
  scene.joints.strength = strength;
  scene.analysis.friction_law = FrictionLaw::coulomb;
  return scene;
}

Assembly hung_block() {
  return testing::make_boxes({{.center = {0, 0, 0.5}, .size = {3, 3, 1}, .fixed = true},
                              {.center = {0, 0, -0.5 * kSize.z()}, .size = kSize, .density = kDensity}});
}

double largest_damage(const Simulation& simulation) {
  double largest = 0.0;
  for (const ContactMemory& memory : simulation.memories().values)
    largest = std::max(largest, memory.joint.damage);
  return largest;
}

double smallest_damage(const Simulation& simulation) {
  if (simulation.memories().values.empty()) return 0.0;  // before the first step
  double smallest = 1.0;
  for (const ContactMemory& memory : simulation.memories().values)
    smallest = std::min(smallest, memory.joint.damage);
  return smallest;
}

// Under a tension of 1.05 W / A the block hangs at its elastic elongation c W / A.
TEST(JointsInMotion, ABlockHangsByTension) {
  Case scene = glued_case({.tension = 1.05 * kMass * kG / kArea, .cohesion = 1e6}, 1e-3);
  const Assembly assembly = hung_block();
  testing::AccountedSimulation simulation(scene, assembly);
  ASSERT_EQ(start_from_equilibrium(
                scene, [](const std::string&) {}, &simulation)
                .solution.outcome,
            StaticOutcome::equilibrium);
  for (int k = 0; k < 100; ++k) simulation.advance();
  const double elongation = kCompliance * kMass * kG / kArea;
  EXPECT_NEAR(simulation.displacements()[1].z(), -elongation,
              1e-6 * elongation);  // tolerance of the static start
  EXPECT_LT(largest_speed(simulation.state().v), 1e-9);
}

// Under 0.95 W / A it falls at (1 - 0.95) g. One step is far longer than the period of the joint, so that the
// joint yields from the first step on and the velocity is exact.
TEST(JointsInMotion, ABlockFallsThatIsTooHeavyForItsTension) {
  Case scene = glued_case({.tension = 0.95 * kMass * kG / kArea, .cohesion = 1e6}, 1e-3);
  const Assembly assembly = hung_block();
  testing::AccountedSimulation simulation(scene, assembly);
  double dissipated = 0.0;
  for (int k = 0; k < 60; ++k) dissipated += simulation.advance().work.friction;
  const double fall = -simulation.displacements()[1].z();
  EXPECT_NEAR(simulation.linear_momentum().z(), -0.05 * kMass * kG * 0.06, 1e-9 * kMass);
  const double elongation = 0.95 * kCompliance * kMass * kG / kArea;
  EXPECT_NEAR(dissipated, 0.95 * kMass * kG * (fall - elongation), 1e-9 * dissipated);
  EXPECT_EQ(largest_damage(simulation), 0.0);  // plastic
}

// A glued block is knocked upwards: the joint brakes it, v^2 / 2 = (g + T A / m) w, does not pull it back, so
// that it falls under gravity alone. First order in the step of 1/200 of the rise.
TEST(JointsInMotion, AnOpenJointDoesNotPullItsBlockBack) {
  constexpr double kV = 0.1, kH = 1e-5, kPull = 4 * kMass * kG;
  Case scene = glued_case({.tension = kPull / kArea, .cohesion = 1e6}, kH);
  const Assembly assembly = testing::box_on_floor(kSize, kDensity);
  testing::AccountedSimulation simulation(scene, assembly);
  ASSERT_EQ(start_from_equilibrium(
                scene, [](const std::string&) {}, &simulation)
                .solution.outcome,
            StaticOutcome::equilibrium);
  simulation.mutable_state()->v[2] = kV;
  double dissipated = 0.0, height = 0.0, speed = 0.0;
  while (simulation.state().v[2] > 0.0) {
    dissipated += simulation.advance().work.friction;
    height = std::max(height, simulation.displacements()[1].z());
  }
  const double expected = 0.5 * kV * kV / (5 * kG);
  EXPECT_NEAR(height, expected, 0.02 * expected);
  EXPECT_NEAR(dissipated, kPull * height, 0.02 * kPull * height);
  while (simulation.displacements()[1].z() > 0.0) {
    speed = -simulation.state().v[2];
    simulation.advance();
  }
  EXPECT_NEAR(speed, std::sqrt(2 * kG * height), 0.02 * kV);
  const double before = simulation.energy().total() - 1e-9;
  for (int k = 0; k < 1000; ++k) dissipated += simulation.advance().work.friction;
  EXPECT_LE(simulation.energy().total(), before) << "it bounces on its compliance, without gaining energy";
}

// On an incline it slides if W sin a > c A + mu W cos a, then with the difference over the mass. Under the
// associated law the gap of the first step, h mu |u|, remains.
TEST(JointsInMotion, CohesionHoldsABlockOnAnIncline) {
  const Vec3 gravity = testing::tilted_gravity(1.0);
  const Assembly assembly = testing::box_on_floor(kSize, kDensity);
  for (const FrictionLaw law : {FrictionLaw::coulomb, FrictionLaw::associated}) {
    const double driving = kMass * (gravity.x() + 0.6 * gravity.z());
    for (const double share : {0.95, 1.05}) {
      Case scene = glued_case({.cohesion = share * driving / kArea}, 1e-3);
      scene.loads.gravity = gravity;
      scene.loads.dead_load_time =
          RampInTime{.duration = 0.02};  // not suddenly, which would double the force
      scene.analysis.friction_law = law;
      testing::AccountedSimulation simulation(scene, assembly);
      for (int k = 0; k < 60; ++k) simulation.advance();
      const double before = simulation.linear_momentum().x();
      double work = 0.0;
      for (int k = 0; k < 50; ++k) work += simulation.advance().work.friction;
      const double impulse = 0.05 * std::max(0.0, 1.0 - share) * driving;
      EXPECT_NEAR(simulation.linear_momentum().x() - before, impulse, 1e-6 * driving)
          << to_string(law) << share;
      EXPECT_GE(work, 0.0);
    }
  }
}

/// Dissipated until the joint is broken, J, besides the work of friction, under a force that pulls the block
/// away.
struct Broken {
  double opening = 0.0, shear = 0.0;  ///< J: work of tension and of cohesion
  double mixed = 0.0;                 ///< sum of |(work of tension / G_I A, work of cohesion / G_II A)|
  double total = 0.0;                 ///< J
};

Broken break_joint(const Vec3& force, double h) {
  const FractureEnergy energy{40.0, 100.0};  // N/m
  Case scene = glued_case({.tension = 1e5, .cohesion = 2e5}, h);
  scene.joints.friction = 0.2;
  scene.joints.failure = JointFailure::softening;
  scene.joints.fracture_energy = energy;
  scene.loads.gravity.setZero();
  scene.loads.forces.push_back({BlockRef{1}, Vec3(0, 0, 0), force, {}});
  scene.contact.margin = 0.05;  // the joint breaks before the faces are that far apart
  const Assembly assembly = testing::box_on_floor(kSize, kDensity);
  testing::AccountedSimulation simulation(scene, assembly);
  Broken broken;
  for (int k = 0; k < 1000 && smallest_damage(simulation) < 1.0; ++k) {
    const StepReport report = simulation.advance();
    for (int i = 0; i < report.problem.num_contacts; ++i) {
      const Vec3 z = inelastic_velocity(report.problem.problem, i, report.step_solution);
      const Vec3 gamma = report.step_solution.gamma.segment<3>(3 * i);
      const double opening = -std::min(0.0, gamma[0] * z[0]);
      const double shear = report.problem.problem.strength[i].cohesion * z.tail<2>().norm();
      broken.opening += opening;
      broken.shear += shear;
      broken.mixed += std::hypot(opening / energy.tension, shear / energy.shear) / kArea;
    }
    broken.total += report.work.friction;
  }
  return broken;
}

// The joint breaks within 5 to 25 steps; its fracture energies are dissipated whatever the step.
TEST(SofteningJoints, DissipateTheirFractureEnergyInTension) {
  for (const double h : {1e-4, 2.5e-4, 5e-4}) {
    const Broken broken = break_joint({0, 0, 1.5e5}, h);
    EXPECT_NEAR(broken.total, 40.0 * kArea, 0.01 * 40.0) << h;
  }
}

TEST(SofteningJoints, DissipateTheirFractureEnergyInShear) {
  for (const double h : {1e-4, 2.5e-4, 5e-4}) {
    const Broken broken = break_joint({3e5, 0, -1e5}, h);
    EXPECT_NEAR(broken.shear, 100.0 * kArea, 0.01 * 100.0) << h;
    EXPECT_GT(broken.total, broken.shear);  // friction
    EXPECT_LT(broken.opening, 0.1);         // the block turns a little
  }
}

// The damage grows by |(dw / w_c, ds / s_c)|, so that the work of a part of it is |(d D_I / G_I, d D_II /
// G_II)| = 2 (1 - d) dd, which sums to 1 whatever the ratio of opening to slip.
TEST(SofteningJoints, MixTheModesByTheQuadraticRule) {
  const Broken broken = break_joint({2e5, 0, 1.5e5}, 1e-4);
  EXPECT_GT(broken.opening, 5.0);
  EXPECT_GT(broken.shear, 10.0);
  EXPECT_NEAR(broken.mixed, 1.0, 0.01);
}

// Restored from a checkpoint in the middle of breaking, the motion continues with the same bits.
TEST(SofteningJoints, ContinueFromACheckpointWithTheSameBits) {
  Case scene = glued_case({.tension = 1e5, .cohesion = 2e5}, 4e-4);
  scene.joints.failure = JointFailure::softening;
  scene.joints.fracture_energy = FractureEnergy{40.0, 100.0};
  scene.loads.forces.push_back({BlockRef{1}, Vec3(0.2, 0, 0), Vec3(0, 0, 1.5e5), {}});
  scene.contact.margin = 0.05;
  const Assembly assembly = testing::box_on_floor(kSize, kDensity);
  testing::AccountedSimulation simulation(scene, assembly);
  while (largest_damage(simulation) < 0.2) simulation.advance();
  simulation.forget_factor();
  testing::AccountedSimulation restored(scene, assembly);
  restored.restore(simulation.save());
  ASSERT_LT(largest_damage(restored), 1.0);
  for (int k = 0; k < 20; ++k) {
    simulation.advance();
    restored.advance();
  }
  EXPECT_EQ(simulation.save(), restored.save());
  EXPECT_EQ(largest_damage(simulation), 1.0);
}

// Brittle joints lose both strengths at once: without friction, so that all points bear the same, a block on
// an incline slides with W sin a as soon as that exceeds c A.
TEST(BrittleJoints, SlideAsDryOnesOnceTheyAreBroken) {
  const Vec3 gravity = testing::tilted_gravity(1.0);
  const Assembly assembly = testing::box_on_floor(kSize, kDensity);
  const double driving = kMass * gravity.x();
  for (const double share : {0.95, 1.05}) {
    Case scene = glued_case({.tension = 1e3, .cohesion = share * driving / kArea}, 1e-3);
    scene.joints.friction = 0.0;
    scene.joints.failure = JointFailure::brittle;
    scene.loads.gravity = gravity;
    scene.loads.dead_load_time = RampInTime{.duration = 0.02};
    testing::AccountedSimulation simulation(scene, assembly);
    for (int k = 0; k < 60; ++k) simulation.advance();
    const double before = simulation.linear_momentum().x();
    for (int k = 0; k < 50; ++k) simulation.advance();
    EXPECT_NEAR(simulation.linear_momentum().x() - before, share < 1.0 ? 0.05 * driving : 0.0,
                1e-6 * driving);
    EXPECT_EQ(largest_damage(simulation), share < 1.0 ? 1.0 : 0.0);
  }
}

// Contacts that did not exist as built have no bond: a block that lands on a glued one is not glued.
TEST(JointsInMotion, NewContactsHaveNoBond) {
  Case scene = glued_case({.tension = 1e5, .cohesion = 1e5}, 1e-3);
  const Assembly assembly = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true},
                                                 {.center = {0, 0, 0.1}, .size = kSize},
                                                 {.center = {0, 0, 0.35}, .size = kSize}});
  testing::AccountedSimulation simulation(scene, assembly);
  for (int k = 0; k < 400; ++k) simulation.advance();
  const ContactSet& contacts = simulation.contacts();
  int landed = 0;
  for (size_t i = 0; i < contacts.points.size(); ++i) {
    const bool is_new = contacts.points[i].block_b == 2;
    landed += is_new ? 1 : 0;
    EXPECT_EQ(simulation.memories().values[i].joint.damage, is_new ? 1.0 : 0.0);
  }
  EXPECT_GT(landed, 0);
}

}  // namespace
}  // namespace cupola::joint_damage_test
