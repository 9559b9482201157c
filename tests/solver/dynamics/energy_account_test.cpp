#include "solver/dynamics/energy_account.hpp"

#include <cmath>
#include <functional>
#include <ostream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/solver/motion_scenes.hpp"

namespace cupola::energy_account_test {
namespace {

using testing::kG;
using testing::make_case;

/// A scene whose account of energy must close.
struct Motion {
  std::string name;
  Assembly assembly;
  Case scene;
  std::function<void(State*)> set_up = nullptr;
  int steps = 300;
};
std::ostream& operator<<(std::ostream& out, const Motion& motion) {
  return out << motion.name;
}

struct Account {
  double start = 0.0, worst_error = 0.0, peak_kinetic = 0.0;
  StepWork work;
};

Account follow(const Motion& motion) {
  Simulation simulation = testing::simulate(motion.scene, motion.assembly);
  if (motion.set_up) motion.set_up(simulation.mutable_state());
  Account account;
  account.start = simulation.energy().total();
  for (int k = 0; k < motion.steps; ++k) {
    const StepReport report = simulation.advance();
    account.work += report.work;
    account.peak_kinetic = std::max(account.peak_kinetic, report.energy.kinetic);
    const double error = report.energy.total() - account.start - account.work.change();
    account.worst_error = std::max(account.worst_error, std::abs(error));
  }
  return account;
}

Motion spinning_fall() {
  return {"SpinningFall", testing::make_boxes({{.center = {0, 0, 5}, .size = {1, 2, 3}}}),
          make_case(0.4, 1e-8, 1e-3), [](State* state) { state->v << 0, 0, 0, 0.3, 2.0, 0.1; }};
}

Motion tumbling_box(double compliance) {
  return {fmt::format("TumblingBox{}", compliance > 0.0 ? "Compliant" : "Rigid"),
          testing::box_on_floor({0.4, 0.6, 1.0}), make_case(0.4, compliance, 2e-3), [](State* state) {
            state->poses[1].p_WB.z() += 0.3;
            state->poses[1].q_WB = Eigen::AngleAxisd(0.4, Vec3(1, 2, 0.5).normalized());
            state->v << 0.5, 0.2, 0, 0.3, 1.0, 0.1;
          }};
}

Motion sliding_box(FrictionLaw law) {
  Motion motion{fmt::format("SlidingBox{}", law == FrictionLaw::coulomb ? "Coulomb" : "Associated"),
                testing::box_on_floor({1.0, 0.5, 0.2}), make_case(0.2, 1e-9, 2e-3)};
  motion.scene.analysis.friction_law = law;
  motion.scene.loads.gravity = testing::tilted_gravity(0.5);
  return motion;
}

Motion loaded_arch() {
  Motion motion{"ArchUnderGrowingLoadAndDamping", testing::make_arch({.voussoirs = 9}),
                make_case(0.5, 1e-7, 5e-3, 0.01)};
  motion.scene.loads.dead_load_time = RampInTime{.from = 0.0, .to = 1.0, .start = 0.0, .duration = 0.5};
  motion.scene.analysis.start = Analysis::Start::rest;
  return motion;
}

Motion shaken_stack() {
  Motion motion{"StackOnAMovingSupport", testing::stack_of_cubes(1.0, {1000.0, 1000.0, 1000.0}),
                make_case(0.3, 1e-8, 5e-3)};
  SupportMove move;
  move.displacement = Vec3(0.3, 0.1, 0.02);
  move.time = RampInTime{.from = 0.0, .to = 1.0, .start = 0.1, .duration = 0.4};
  motion.scene.supports.moves = {move};
  motion.scene.analysis.start = Analysis::Start::rest;
  return motion;
}

Motion adaptive_sleepers() {
  Motion motion{"AdaptiveStepsAndSleep", testing::stack_of_cubes(1.0, {1000.0, 1000.0}),
                make_case(0.3, 1e-8, 5e-3, 0.02)};
  motion.scene.analysis.sleep = Sleep{.speed = 1e-3, .time = 0.1};
  return motion;
}

Motion breaking_joint() {
  Motion motion{"BreakingJoint", testing::box_on_floor({1.0, 1.0, 1.0}), make_case(0.5, 1e-7, 2e-3)};
  motion.scene.joints.strength = {.tension = 1e4, .cohesion = 1e4};
  motion.scene.joints.failure = JointFailure::brittle;
  motion.set_up = [](State* state) { state->v << 0, 0, 0.4, 0, 0, 0; };
  return motion;
}

Motion second_order(Motion motion) {
  motion.name += "OfSecondOrder";
  motion.scene.analysis.integrator = TimeIntegrator::generalized_alpha;
  return motion;
}

class EnergyAccount : public ::testing::TestWithParam<Motion> {};

// The contact solves are converged to 1e-12, and the velocities are of the order of 1 m/s.
TEST_P(EnergyAccount, Closes) {
  const Account account = follow(GetParam());
  const double scale = std::max(account.work.dissipated(), account.peak_kinetic);
  EXPECT_GT(scale, 0.0);
  EXPECT_LT(account.worst_error, 1e-8 * scale);
}

INSTANTIATE_TEST_SUITE_P(
    Motions, EnergyAccount,
    ::testing::Values(spinning_fall(), tumbling_box(1e-7), tumbling_box(0.0),
                      sliding_box(FrictionLaw::associated), sliding_box(FrictionLaw::coulomb), loaded_arch(),
                      shaken_stack(), adaptive_sleepers(), breaking_joint(), second_order(spinning_fall()),
                      second_order(tumbling_box(1e-7)), second_order(tumbling_box(0.0)),
                      second_order(sliding_box(FrictionLaw::associated)),
                      second_order(sliding_box(FrictionLaw::coulomb)), second_order(loaded_arch())),
    [](const auto& motion) { return motion.param.name; });

// A box that falls from 0.3 m loses its kinetic energy in the impact. The step in which it touches is not
// known better than to h, and with it the speed.
TEST(EnergyAccountTerms, OfAnImpactIsTheKineticEnergyOfTheApproach) {
  const double height = 0.3, h = 5e-4;
  Motion motion{"", testing::box_on_floor({1.0, 1.0, 0.5}), make_case(0.3, 0.0, h),
                [](State* state) { state->poses[1].p_WB.z() += 0.3; }, 1000};
  const double weight = motion.assembly.blocks[1].mass * kG, speed = std::sqrt(2.0 * kG * height);
  EXPECT_NEAR(follow(motion).work.impact / (weight * height), 1.0, 2.0 * kG * h / speed);
}

// A cube of m = 2000 kg falls by 0.05 m in t = 0.1 s on four corners of c = 4e-8 m/N and alpha = 10 ms, above
// critical damping, which stop it with the time constant tau = m c / 4 alpha = 2 ms. Implicit Euler loses the
// share h / 2 tau of the energy in this; no other work escapes the formulas of damper, impact and springs.
TEST(EnergyAccountTerms, OfADampedFallAreThoseOfItsDamperAndImpact) {
  const double height = 0.05, weight = 2000.0 * kG, t = 0.1, tau = 2e-3;
  for (const double h : {4e-3, 1e-3, 2.5e-4}) {
    SCOPED_TRACE(fmt::format("h = {} s", h));
    Motion motion{"", testing::box_on_floor({1.0, 1.0, 1.0}, 2000.0), make_case(0.5, 4e-8, h, 0.01),
                  [height](State* state) { state->poses[1].p_WB.z() += height; }, static_cast<int>(0.5 / h)};
    const Account account = follow(motion);
    EXPECT_NEAR(account.peak_kinetic / (weight * height), 1.0, 3.0 * h / t) << "nothing brakes it in the air";
    EXPECT_GE(account.work.damping, 0.0);
    EXPECT_GE(account.work.impact, 0.0);
    EXPECT_NEAR(account.work.dissipated() / (weight * height), 1.0, 0.02);
    EXPECT_LT(std::abs(account.work.scheme) / (weight * height), h / tau);
  }
}

// A weight W that is set on springs of 4 / c comes to rest lower by W c / 4: half of its work is stored, half
// is that of the dampers, but for the error of implicit Euler, here 2.4 h w with w = 20 rad/s.
TEST(EnergyAccountTerms, OfDampersAreHalfTheWorkOfASuddenWeight) {
  const double c = 1e-5, h = 1e-3, weight = 1000.0 * kG, half = weight * weight * c / 8.0;
  Motion motion{"", testing::box_on_floor({1.0, 1.0, 1.0}), make_case(0.5, c, h, 0.02), nullptr, 2000};
  for (const Motion& m : {motion, second_order(motion)})
    EXPECT_NEAR(follow(m).work.damping / half, 1.0, 0.06) << m.name;
}

TEST(EnergyAccountTerms, OfASlidingBlockUnderTheAssociatedLawReturnTheFrictionAsDilatancy) {
  const StepWork work = follow(sliding_box(FrictionLaw::associated)).work;
  EXPECT_GT(work.friction, 0.0);
  EXPECT_NEAR(work.dilatancy / work.friction, 1.0, 1e-6) << "gamma is orthogonal to z";
  EXPECT_LT(follow(sliding_box(FrictionLaw::coulomb)).work.dilatancy, 1e-9 * work.friction) << "rounding";
}

// A block of weight W slides down a slope of 0.5 with friction mu = 0.2, whose springs store c T^2 / 8 for the
// friction T of its four corners, however far it slides; four times as much where it settles on them.
TEST(EnergyAccountTerms, OfSlidingJointsStoreNoSlip) {
  Motion motion = sliding_box(FrictionLaw::coulomb);
  motion.scene.analysis.damping = 0.01;
  const double weight = motion.assembly.blocks[1].mass * kG, c = 1e-9;
  for (const Motion& m : {motion, second_order(motion)}) {
    Simulation simulation = testing::simulate(m.scene, m.assembly);
    StepWork work;
    double stored = 0.0;
    for (int k = 0; k < m.steps; ++k) {
      const StepReport report = simulation.advance();
      work += report.work;
      stored = std::max(stored, report.energy.elastic);
    }
    EXPECT_LT(stored, 4.0 * c * weight * weight / 8.0) << m.name;
    EXPECT_LT(work.damping, 1e-3 * work.friction) << m.name;
    const double length = simulation.state().poses[1].p_WB.x(), normal = weight / std::sqrt(1.25);
    EXPECT_NEAR(work.friction / (0.2 * normal * length), 1.0, 1e-3)
        << m.name << ": the step in which it starts";
  }
}

// A rigid block that slides falls on nothing: what the integrator loses is no impact.
TEST(EnergyAccountTerms, OfARigidBlockThatSlidesHaveNoImpact) {
  Motion motion = sliding_box(FrictionLaw::coulomb);
  motion.scene.joints.compliance = {0.0, 0.0, Compliance::Per::point};
  const StepWork work = follow(motion).work;
  EXPECT_GT(work.friction, 1.0);
  EXPECT_EQ(work.impact, 0.0);
}

// A lift raises a block of weight W by 0.02 m and pushes it sideways: the work is that of the reaction.
TEST(EnergyAccountTerms, OfSlowSupportsAreTheWeightTimesTheRise) {
  Motion motion = shaken_stack();
  motion.scene.supports.moves[0].displacement = Vec3(0, 0, 0.02);
  motion.scene.supports.moves[0].time = RampInTime{.from = 0.0, .to = 1.0, .start = 1.0, .duration = 4.0};
  motion.scene.joints.compliance = {1e-8, 1e-8, Compliance::Per::point};
  motion.scene.analysis.time_step = 0.02;
  motion.steps = 300;
  const double weight = 3000.0 * kG;
  EXPECT_NEAR(follow(motion).work.supports / (weight * 0.02), 1.0, 1e-3) << "speeds of 5 mm/s";
}

}  // namespace
}  // namespace cupola::energy_account_test
