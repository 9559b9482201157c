#include <cmath>

#include <gtest/gtest.h>

#include "solver/runtime/threads.hpp"
#include "tests/solver/accounted_simulation.hpp"
#include "tests/solver/motion_scenes.hpp"
#include "tests/test_names.hpp"

// A structure of rigid blocks at rest keeps the impulses of the step before: no iterations, no motion.

namespace cupola::rigid_rest_test {
namespace {

using testing::kG;
using testing::make_case;

/// Rigid joints, to the tolerance that users take.
Case rigid_case(double friction) {
  Case scene = make_case(friction, 0.0, 0.01);
  scene.analysis.tolerance = 1e-6;
  return scene;
}

double largest_displacement(const Simulation& simulation) {
  double largest = 0.0;
  for (const Vec3& d : simulation.displacements()) largest = std::max(largest, d.norm());
  return largest;
}

/// The residuals that every step must meet, whatever its impulses come from.
void expect_accurate(const StepReport& report, double tolerance) {
  EXPECT_EQ(report.solve.ending, SolveEnding::converged) << report.solve.message;
  EXPECT_LE(excess(report.residuals, tolerance), 1.0);
}

// An arch stands on its abutments for 200 steps. Once its speeds are rounding errors or zero it stays where
// it is, to the last bit; before that each step may move it by the tolerance times the free fall g h^2 of one
// step.
class ArchAtRest : public ::testing::TestWithParam<FrictionLaw> {};
TEST_P(ArchAtRest, StaysWhereItIs) {
  const Assembly assembly = testing::make_arch({.voussoirs = 15, .thickness = 0.2});
  Case scene = rigid_case(0.7);
  scene.analysis.friction_law = GetParam();
  testing::AccountedSimulation simulation(scene, assembly);
  constexpr int kSettled = 20;
  State settled;
  double weight = 0.0;
  for (const int block : simulation.model().free_blocks) weight += assembly.blocks[block].mass * kG;
  for (int step = 1; step <= 200; ++step) {
    const StepReport report = simulation.advance();
    expect_accurate(report, scene.analysis.tolerance);
    // Momentum residual, and speeds that change within the tolerance of the rigid contacts.
    EXPECT_NEAR(report.balance.support_reaction.z() / weight, 1.0, 3.0 * scene.analysis.tolerance);
    if (step == kSettled) settled = simulation.state();
    if (step <= kSettled) continue;
    EXPECT_EQ(report.solve.iterations, 0) << "step " << step << ": " << report.solve.message;
    EXPECT_EQ(simulation.state().v.squaredNorm(), 0.0);
  }
  for (size_t block = 0; block < assembly.blocks.size(); ++block)
    EXPECT_EQ(simulation.state().poses[block].p_WB, settled.poses[block].p_WB);
  EXPECT_LT(largest_displacement(simulation), kSettled * 1e-6 * kG * 0.01 * 0.01);
}

INSTANTIATE_TEST_SUITE_P(BothLaws, ArchAtRest,
                         ::testing::Values(FrictionLaw::associated, FrictionLaw::coulomb),
                         test_names({"Associated", "Coulomb"}));

// The friction falls from 0.6 to 0.1 over a second on a slope of 0.3. The block must leave its rest when the
// friction is that of the slope, at 0.6 s, and then slide under Coulomb's law: v = g cos a (0.5 t^2 / 2), t
// from then, less one step.
TEST(RigidRest, EndsWhenTheImpulsesNoLongerObeyTheLaw) {
  const Assembly assembly = testing::box_on_floor({1.0, 0.5, 0.2});
  Case scene = rigid_case(0.6);
  scene.analysis.friction_law = FrictionLaw::coulomb;
  scene.analysis.start = Analysis::Start::rest;
  scene.loads.gravity = testing::tilted_gravity(0.3);
  scene.joints.friction_time = RampInTime{.from = 1.0, .to = 1.0 / 6.0, .start = 0.0, .duration = 1.0};
  testing::AccountedSimulation simulation(scene, assembly);
  while (simulation.state().time < 0.595) expect_accurate(simulation.advance(), scene.analysis.tolerance);
  EXPECT_LT(largest_displacement(simulation), 60 * 1e-6 * kG * 0.01 * 0.01);
  while (simulation.state().time < 0.995) expect_accurate(simulation.advance(), scene.analysis.tolerance);
  const double slide = 0.4, cos_a = std::cos(std::atan(0.3));
  const double exact = kG * cos_a * 0.5 * 0.5 * slide * slide;
  // Friction is that at the end of each step: half a step early.
  EXPECT_NEAR(simulation.state().v[0], exact, 1.1 * kG * cos_a * 0.5 * slide * 0.5 * 0.01);
}

// The tangents of a level bed jump by 90 degrees where its normal leans by a rounding error. Its impulses
// must not turn with them.
TEST(WarmStart, KeepsImpulsesWhereTangentsJump) {
  const Assembly assembly = testing::box_on_floor({1.0, 0.5, 0.2});
  Case scene = rigid_case(0.6);
  scene.loads.gravity = testing::tilted_gravity(0.3);
  testing::AccountedSimulation simulation(scene, assembly);
  simulation.advance();
  ContactSet contacts = simulation.contacts();
  constexpr double kLean = 1e-12;
  for (Contact& contact : contacts.points) contact.normal = Vec3(kLean, 0, 1);
  const StepProblem step = build_step_problem(simulation.model(), simulation.state(), contacts,
                                              simulation.memories(), simulation.options().step);
  const ContactSolution guess = warm_start(step, simulation.state(), contacts, simulation.memories());
  for (size_t i = 0; i < contacts.points.size(); ++i) {
    const Mat3 before = contact_frame(simulation.contacts().points[i].normal);
    const Mat3 now = contact_frame(contacts.points[i].normal);
    ASSERT_NEAR(before.col(1).dot(now.col(1)), 0.0, 1e-9) << "the tangents must jump";
    const Vec3 impulse = before * simulation.memories().values[i].impulse;
    EXPECT_GT(std::abs(impulse.x()), 0.1 * impulse.norm());
    EXPECT_LT((now * guess.gamma.segment<3>(3 * static_cast<Eigen::Index>(i)) - impulse).norm(),
              2.0 * kLean * impulse.norm());
  }
}

TEST(RigidRest, IsTheSameOnAnyNumberOfThreads) {
  const Assembly assembly = testing::running_bond_wall({0.6, 0.3, 0.3}, 3, 4);
  VecX impulses[2];
  for (const int threads : {1, 2}) {
    set_num_threads(threads);
    testing::AccountedSimulation simulation(rigid_case(0.6), assembly);
    for (int step = 0; step < 30; ++step) impulses[threads - 1] = simulation.advance().step_solution.gamma;
  }
  set_num_threads(1);
  EXPECT_EQ(impulses[0], impulses[1]);
}

}  // namespace
}  // namespace cupola::rigid_rest_test
