#include "solver/dynamics/ties.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "solver/analysis/statics/static_solve.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::ties_test {
namespace {

using testing::kG;
using testing::make_case;
using testing::simulate;

/// A fixed ceiling and a cube of 1000 kg, 1 m below it.
Assembly hanging_cube() {
  return testing::make_boxes(
      {{.center = {0, 0, 3}, .size = {4, 4, 1}, .fixed = true}, {.center = {0, 0, 1}, .size = {1, 1, 1}}});
}

PairTie vertical_tie(double stiffness, double prestress = 0.0) {
  PairTie tie;
  tie.block_a = 0;
  tie.block_b = 1;
  tie.point_a = Vec3(0, 0, 2.5);
  tie.point_b = Vec3(0, 0, 1.5);
  tie.stiffness = stiffness;
  tie.prestress = prestress;
  return tie;
}

// A mass m on a spring of stiffness k, released at rest; implicit Euler with step h, damping alpha, w2 = k /
// m:
//
//     v' = (v - g h - w2 h y) / (1 + w2 h (h + alpha)),   y' = y + h v'
TEST(Tie, InTensionIsTheImplicitEulerSpring) {
  const Assembly assembly = hanging_cube();
  const double h = 0.002, k = 1e6, w2 = k / 1000.0;
  for (const double alpha : {0.0, 0.01}) {
    Case scene = make_case(0.4, 1e-8, h, alpha);
    scene.ties.pairs = {vertical_tie(k)};
    Simulation simulation = simulate(scene, assembly);
    double v = 0.0, y = 0.0;
    for (int step = 1; step <= 20; ++step) {
      const StepReport report = simulation.advance();
      v = (v - kG * h - w2 * h * y) / (1.0 + w2 * h * (h + alpha));
      y += h * v;
      EXPECT_NEAR(simulation.state().v[2] / v, 1.0, 1e-9) << "step " << step;
      EXPECT_NEAR(report.forces.ties[0] / (-k * (y + alpha * v)), 1.0, 1e-7) << "step " << step;
    }
  }
}

TEST(Tie, HasNoForceWhileSlack) {
  const Assembly assembly = hanging_cube();
  const double h = 0.001;
  Case scene = make_case(0.4, 1e-8, h);
  PairTie tie = vertical_tie(1e6);
  tie.point_b = Vec3(0, 0, 0.5);  // 2 m long as generated
  scene.ties.pairs = {tie};
  scene.loads.gravity = Vec3(0, 0, kG);  // the cube rises, so the tie becomes slack
  Simulation simulation = simulate(scene, assembly);
  for (int step = 0; step < 100; ++step) EXPECT_EQ(simulation.advance().forces.ties[0], 0.0);
  EXPECT_NEAR(simulation.state().v[2], kG * 0.1, 1e-12);
}

TEST(Tie, PrestressPressesACubeAgainstAStopInStatics) {
  // The cube touches a stop above it. The prestress P > W presses it against the stop with the force P - W,
  // less the part lost because the joint closes.
  const Assembly assembly = testing::make_boxes(
      {{.center = {0, 0, 2}, .size = {4, 4, 1}, .fixed = true}, {.center = {0, 0, 1}, .size = {1, 1, 1}}});
  const double W = 1000.0 * kG, P = 3.0 * W, k = 1e6, c = 1e-8;
  Case scene = make_case(0.4, c, 1.0);
  PairTie tie;
  tie.block_a = 0;
  tie.block_b = 1;
  tie.point_a = Vec3(0, 0, 2.2);
  tie.point_b = Vec3(0, 0, 1.0);
  tie.stiffness = k;
  tie.prestress = P;
  scene.ties.pairs = {tie};
  const Model model = make_model(scene, assembly);
  const State rest = state_at_rest(model);
  ContactDetector detector(assembly, {});
  const ContactSet& contacts = detector.update(rest.poses);
  const StaticSolution solution = solve_static(model, rest, contacts, match_memories({}, contacts.points),
                                               {.tolerance = 1e-10, .time_advance = 0.0});
  ASSERT_EQ(solution.outcome, StaticOutcome::equilibrium) << solution.message;
  // The joint (k_j = 4/c) closes by d: P - k d - W = k_j d.
  const double d = (P - W) / (4.0 / c + k);
  EXPECT_NEAR(solution.forces.ties[0] / (P - k * d), 1.0, 1e-9);
  double on_stop = 0.0;
  for (const Vec3& f : solution.forces.contacts) on_stop -= f.z();
  EXPECT_NEAR(on_stop / (P - W - k * d), 1.0, 1e-8);
}

// A rigid rod carries the cube in tension and, with gravity reversed, in compression.
TEST(Rod, PushesAndPulls) {
  for (const double g : {-kG, kG}) {
    Assembly assembly = hanging_cube();
    ImportedTie rod;
    rod.block_a = 1;  // blocks in the other order
    rod.block_b = 0;
    rod.point_a = Vec3(0, 0, 1.5);
    rod.point_b = Vec3(0, 0, 2.5);
    rod.stiffness = std::numeric_limits<double>::infinity();
    rod.length = 1.0;
    rod.pushes = true;
    assembly.ties = {rod};
    Case scene = make_case(0.4, 1e-8, 1e-3, 0.01);
    scene.ties.rod_stiffness = 1e8;
    scene.loads.gravity = Vec3(0, 0, g);
    Simulation simulation = simulate(scene, assembly);
    StepReport report;
    for (int step = 0; step < 2000; ++step) report = simulation.advance();
    const double sunk = simulation.state().poses[1].p_WB.z() - 1.0;
    EXPECT_NEAR(sunk / (1000.0 * g / 1e8), 1.0, 1e-6);
    EXPECT_NEAR(report.forces.ties[g < 0 ? 0 : 1] / (1000.0 * kG), 1.0, 1e-6);
    EXPECT_EQ(report.forces.ties[g < 0 ? 1 : 0], 0.0);
    EXPECT_NEAR(report.balance.support_reaction.z() / (-1000.0 * g), 1.0, 1e-6);
  }
}

// Ring of n blocks on a frictionless floor, each under an equal outward radial force Q. The tie force is
// Q / (2 sin(pi / n)).
TEST(Chain, CarriesTheHoopForceOfARing) {
  const int n = 8;
  std::vector<testing::BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {40, 40, 1}, .fixed = true}};
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * std::numbers::pi * i / n;
    boxes.push_back({.center = {10 * std::cos(a), 10 * std::sin(a), 0.5},
                     .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(a, Vec3::UnitZ()))});
  }
  const Assembly assembly = testing::make_boxes(boxes);
  const double Q = 500.0;
  Case scene = make_case(0.0, 1e-8, 1.0);
  scene.ties.chains = {{.ring = 0, .stiffness = 1e7, .prestress = 0.0}};
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * std::numbers::pi * i / n;
    scene.loads.forces.push_back(
        {.block = i + 1, .point = {}, .force = Q * Vec3(std::cos(a), std::sin(a), 0), .time = {}});
  }
  const Model model = make_model(scene, assembly);
  ASSERT_EQ(model.ties.size(), static_cast<size_t>(n));
  const State rest = state_at_rest(model);
  ContactDetector detector(assembly, {});
  const ContactSet& contacts = detector.update(rest.poses);
  const StaticSolution solution = solve_static(model, rest, contacts, match_memories({}, contacts.points),
                                               {.tolerance = 1e-9, .time_advance = 0.0});
  ASSERT_EQ(solution.outcome, StaticOutcome::equilibrium) << solution.message;
  for (const double force : solution.forces.ties)
    EXPECT_NEAR(force / (Q / (2.0 * std::sin(std::numbers::pi / n))), 1.0, 1e-6);
}

TEST(Tie, RejectsInvalidInput) {
  const Assembly assembly = hanging_cube();
  Case scene;
  PairTie tie = vertical_tie(1e6);
  tie.block_b = 7;
  scene.ties.pairs = {tie};
  EXPECT_THROW(make_ties(scene, assembly), InputError);
  tie = vertical_tie(1e6);
  tie.point_b = tie.point_a;
  scene.ties.pairs = {tie};
  EXPECT_THROW(make_ties(scene, assembly), InputError);
  scene.ties.pairs = {vertical_tie(1e3, 2e3)};  // elongation of 2 m, more than its length
  EXPECT_THROW(make_ties(scene, assembly), InputError);
  scene.ties.pairs.clear();
  scene.ties.chains = {{.ring = 3}};
  EXPECT_THROW(make_ties(scene, assembly), InputError);
}

}  // namespace
}  // namespace cupola::ties_test
