#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/solver/accounted_simulation.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::energy_balance_test {
namespace {

using testing::kG;
using testing::make_case;

/// Rotates the block on the floor by `angle` (rad, about y) over its lower edge at +x, which stays on the
/// floor.
void tip(double half_width, double half_height, double angle, State* state) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, Vec3::UnitY()));
  const Vec3 edge(half_width, 0, 0);
  state->poses[1].q_WB = turn;
  state->poses[1].p_WB = edge + turn * Vec3(-half_width, 0, half_height);
}

// Sliding on an incline: the energy lost equals the work of friction, to first order in h.
TEST(EnergyBalance, SlidingBlockLosesTheFrictionWorkToFirstOrder) {
  double worst[2] = {0, 0};
  for (int i = 0; i < 2; ++i) {
    const double h = i == 0 ? 2e-3 : 1e-3;
    const Assembly assembly = testing::box_on_floor({1.0, 0.5, 0.2});
    Case scene = make_case(0.2, 1e-10, h);
    scene.loads.gravity = testing::tilted_gravity(0.5);
    testing::AccountedSimulation simulation(scene, assembly);
    double work = 0.0;
    const double start = simulation.energy().total();
    while (simulation.state().time < 0.5) work += simulation.advance().work.friction;
    const double lost = start - simulation.energy().total();
    worst[i] = std::abs(lost - work) / work;
  }
  EXPECT_LT(worst[1], 0.02);
  EXPECT_NEAR(worst[0] / worst[1], 2.0, 0.2);
}

// A rocking block can only lose energy, up to the first-order error of its free rotation.
TEST(EnergyBalance, RockingBlockGainsNoEnergyBeyondTheTruncationError) {
  const Assembly assembly = testing::box_on_floor({0.4, 1.0, 2.0});
  double growth[2] = {0, 0};
  for (int i = 0; i < 2; ++i) {
    const double h = i == 0 ? 2e-3 : 1e-3;
    Case scene = make_case(0.8, 1e-11, h);
    scene.analysis.tolerance = 1e-9;
    testing::AccountedSimulation simulation(scene, assembly);
    tip(0.2, 1.0, 0.5 * std::atan(0.2), simulation.mutable_state());
    const double start = simulation.energy().total();
    const double rest = 0.0;  // potential as built
    while (simulation.state().time < 3.0) {
      simulation.advance();
      growth[i] = std::max(growth[i], (simulation.energy().total() - start) / (start - rest));
    }
    EXPECT_LT(simulation.energy().total(), 0.75 * start) << "three seconds of impacts";
  }
  EXPECT_LT(growth[1], 5e-3);
}

// Free rotation without contacts: the energy error is first order in h.
TEST(EnergyBalance, TumblingBlockDriftsToFirstOrder) {
  double drift[2] = {0, 0};
  for (int i = 0; i < 2; ++i) {
    const double h = i == 0 ? 2e-3 : 1e-3;
    const Assembly assembly = testing::make_boxes({{.center = {0, 0, 50}, .size = {1, 2, 3}}});
    Case scene = make_case(0.4, 1e-8, h);
    scene.loads.gravity.setZero();
    testing::AccountedSimulation simulation(scene, assembly);
    simulation.mutable_state()->v << 1, 0, 0, 0.3, 2.0, 0.1;
    const double start = simulation.energy().total();
    while (simulation.state().time < 1.0) simulation.advance();
    drift[i] = std::abs(simulation.energy().total() / start - 1.0);
  }
  EXPECT_LT(drift[1], 5e-3);
  EXPECT_NEAR(drift[0] / drift[1], 2.0, 0.3);
}

// A rod that slides on its end. Above mu = 4/3, at some inclinations, a rigid slender rod has no acceleration
// or two (Painleve 1895). The time step still has a solution in impulses: speeds stay finite and the energy
// does not grow.
TEST(Painleve, SlidingRodKeepsFiniteSpeedsAndGainsNoEnergy) {
  const Vec3 size(0.02, 0.02, 1.0);
  for (const FrictionLaw law : {FrictionLaw::associated, FrictionLaw::coulomb})
    for (const double mu : {1.5, 3.0})
      for (const double speed : {-5.0, 5.0})
        for (const double lean : {0.3, 0.6}) {
          const double centre = 0.5 * (size.z() * std::cos(lean) + size.x() * std::sin(lean));
          const Assembly assembly =
              testing::make_boxes({{.center = {0, 0, -0.5}, .size = {40, 3, 1}, .fixed = true},
                                   {.center = {0, 0, centre},
                                    .size = size,
                                    .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(lean, Vec3::UnitY()))}});
          Case scene = make_case(mu, 1e-9, 1e-3);
          scene.analysis.tolerance = 1e-9;
          scene.analysis.friction_law = law;
          testing::AccountedSimulation simulation(scene, assembly);
          simulation.mutable_state()->v[0] = speed;
          const double start = simulation.energy().total(), kinetic = 0.5 * assembly.blocks[1].mass * 25.0;
          double highest = 0.0;
          for (int step = 0; step < 400; ++step) {
            const StepReport report = simulation.advance();
            ASSERT_TRUE(report.solve.usable()) << report.solve.message;
            ASSERT_TRUE(simulation.state().v.allFinite());
            highest = std::max(highest, simulation.energy().total() - start);
          }
          // The associated law lifts a sliding block by h mu |u_t|, at most 15 mm here: 1.2 % of the energy.
          EXPECT_LE(highest, (law == FrictionLaw::coulomb ? 1e-3 : 1.3e-2) * kinetic)
              << to_string(law) << ", mu " << mu << ", speed " << speed << ", lean " << lean;
        }
}

/// A rod that leans by `lean` towards +x and slides on the edge of its foot, on which a step of length h
/// acts:
///
///     w_foot = (speed, -g h) + W p,     p = (T, N) the impulse, W the inverse mass of the foot,
///
/// with W_xz < 0. A foot that slides towards -x has the friction T = mu N, which lowers its normal
/// acceleration by mu |W_xz| N. From mu = W_zz / |W_xz| on no sliding solution exists: the foot jams ("impact
/// without collision", Genot and Brogliato 1999, Eur. J. Mech. A 18:653).
struct SlidingRod {
  double lean;
  Vec3 size = Vec3(0.02, 0.02, 1.0);  ///< m

  /// Foot from the centre of gravity, in the plane of the motion.
  double x() const { return 0.5 * (size.x() * std::cos(lean) - size.z() * std::sin(lean)); }
  double z() const { return -0.5 * (size.x() * std::sin(lean) + size.z() * std::cos(lean)); }
  double mass() const { return 1000.0 * size.prod(); }
  double inertia() const { return mass() * (size.x() * size.x() + size.z() * size.z()) / 12.0; }
  double W_xx() const { return 1.0 / mass() + z() * z() / inertia(); }
  double W_zz() const { return 1.0 / mass() + x() * x() / inertia(); }
  double W_xz() const { return -x() * z() / inertia(); }
  double jamming_friction() const { return W_zz() / -W_xz(); }
  Assembly assembly() const {
    return testing::make_boxes({{.center = {0, 0, -0.5}, .size = {40, 3, 1}, .fixed = true},
                                {.center = {0, 0, -z()},
                                 .size = size,
                                 .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(lean, Vec3::UnitY()))}});
  }
};

// Under Coulomb's law, 3 % below the friction at which the foot jams it slides on, slowed by the friction of
// the weight alone; 3 % above it stops in one step of any length, and the rod loses the energy of the motion
// of its foot. A foot that slides towards +x never jams.
TEST(Painleve, FootJamsFromTheFrictionAtWhichNoSlidingSolutionExists) {
  constexpr double kSpeed = 5.0, h = 1e-4;
  for (const double lean : {0.3, 0.4636, 0.7}) {
    const SlidingRod rod{lean};
    const Assembly assembly = rod.assembly();
    if (lean == 0.4636) {
      EXPECT_NEAR(rod.jamming_friction(), 4.0 / 3.0, 0.05) << "of a slender rod at its worst inclination";
    }
    for (const double direction : {-1.0, 1.0})
      for (const double share : {0.97, 1.03}) {
        const double mu = share * rod.jamming_friction(), speed = direction * kSpeed;
        Case scene = make_case(mu, 0.0, h);
        scene.analysis.tolerance = 1e-9;
        scene.analysis.friction_law = FrictionLaw::coulomb;
        testing::AccountedSimulation simulation(scene, assembly);
        simulation.mutable_state()->v[0] = speed;
        const StepReport report = simulation.advance();
        ASSERT_EQ(report.solve.ending, SolveEnding::converged) << report.solve.message;
        const VecX& v = simulation.state().v;
        const double foot = v[0] + v[4] * rod.z(), rise = v[2] - v[4] * rod.x();
        const double slip = -direction * mu;  // T / N while the foot slides
        const double N = kG * h / (rod.W_zz() + slip * rod.W_xz());
        const bool jams = direction < 0 && share > 1.0;
        const double expected = jams ? 0.0 : speed + (rod.W_xz() + slip * rod.W_xx()) * N;
        const std::string what = fmt::format("lean {}, mu {}, speed {}", lean, mu, speed);
        EXPECT_NEAR(foot, expected, 1e-6 * kSpeed) << what;
        EXPECT_NEAR(rise, 0.0, 1e-6 * kSpeed) << what;
        if (!jams) continue;
        const double kept =
            0.5 * rod.mass() * (v[0] * v[0] + v[2] * v[2]) + 0.5 * rod.inertia() * v[4] * v[4];
        const double det = rod.W_xx() * rod.W_zz() - rod.W_xz() * rod.W_xz();
        // The weight adds work of the order of m g h speed.
        EXPECT_NEAR(kept, 0.5 * kSpeed * kSpeed * (rod.mass() - rod.W_zz() / det),
                    1e-3 * rod.mass() * kSpeed * kSpeed)
            << what;
      }
  }
}

/// Of a block that tumbles in free flight with a mass on its top, relative errors after 1 s: of its energy,
/// and of the way of the common centroid, which goes straight on.
Eigen::Vector2d tumbling_errors(double h) {
  Assembly assembly = testing::make_boxes({{.center = {0, 0, 50}, .size = {1, 2, 3}}});
  assembly.face_kinds[1] = FaceKind::top;
  Case scene = make_case(0.4, 1e-8, h);
  scene.loads.gravity.setZero();
  scene.loads.lantern = TopLoad{.mass = 3000.0};
  testing::AccountedSimulation simulation(scene, assembly);
  simulation.mutable_state()->v << 1, 0, 0, 0.3, 2.0, 0.1;
  const Vec3 arm(0, 0, 1.5 * 3000.0 / (3000.0 + assembly.blocks[0].mass));  // m, to the common centroid
  const auto centroid = [&]() -> Vec3 {
    return simulation.state().poses[0].p_WB + simulation.state().poses[0].q_WB * arm;
  };
  const double energy = simulation.energy().total();
  const Vec3 start = centroid(), velocity = Vec3(1, 0, 0) + Vec3(0.3, 2.0, 0.1).cross(arm);
  while (simulation.state().time < 1.0) simulation.advance();
  const Vec3 straight = start + simulation.state().time * velocity;
  return {std::abs(simulation.energy().total() / energy - 1.0),
          (centroid() - straight).norm() / velocity.norm()};
}

// As without the mass, errors of first order in h, of the turn of 2 h in a step.
TEST(EnergyBalance, AMassOnTopTumblesWithItsBlock) {
  const Eigen::Vector2d coarse = tumbling_errors(2e-3), fine = tumbling_errors(1e-3);
  for (const int i : {0, 1}) {
    EXPECT_LT(fine[i], 5e-3) << i;
    EXPECT_NEAR(coarse[i] / fine[i], 2.0, 0.3) << i;
  }
}

}  // namespace
}  // namespace cupola::energy_balance_test
