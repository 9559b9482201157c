#include "solver/dynamics/ties.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "solver/analysis/statics/equilibrium_path.hpp"
#include "solver/analysis/statics/static_solve.hpp"
#include "tests/solver/accounted_simulation.hpp"
#include "tests/solver/motion_scenes.hpp"
#include "tests/test_names.hpp"

namespace cupola::ties_test {
namespace {

using testing::kG;
using testing::make_case;

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

StaticSolution solve_at_rest(const Model& model, const Assembly& assembly) {
  const State rest = state_at_rest(model);
  ContactDetector detector(assembly, {});
  const ContactSet& contacts = detector.update(rest.poses);
  return solve_static(model, rest, contacts, match_memories({}, contacts.points),
                      {.tolerance = 1e-10, .time_advance = 0.0});
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
    testing::AccountedSimulation simulation(scene, assembly);
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
  testing::AccountedSimulation simulation(scene, assembly);
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
    BuiltTie rod;
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
    testing::AccountedSimulation simulation(scene, assembly);
    StepReport report;
    for (int step = 0; step < 2000; ++step) report = simulation.advance();
    const double sunk = simulation.state().poses[1].p_WB.z() - 1.0;
    EXPECT_NEAR(sunk / (1000.0 * g / 1e8), 1.0, 1e-6);
    EXPECT_NEAR(report.forces.ties[g < 0 ? 0 : 1] / (1000.0 * kG), 1.0, 1e-6);
    EXPECT_EQ(report.forces.ties[g < 0 ? 1 : 0], 0.0);
    EXPECT_NEAR(report.balance.support_reaction.z() / (-1000.0 * g), 1.0, 1e-6);
  }
}

// Ring of n blocks on a frictionless floor, each under an equal outward radial force Q. A closed polygon of
// bars through their centroids carries Q / (2 sin(pi / n)), which is H r for a force H per length.
class RingOfBlocks : public ::testing::TestWithParam<double> {};

TEST_P(RingOfBlocks, ChainCarriesTheHoopForce) {
  const int n = 8;
  const double Q = 500.0, k = 1e7, slack = GetParam(), r = 10.0;
  std::vector<testing::BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {40, 40, 1}, .fixed = true}};
  Case scene = make_case(0.0, 1e-8, 1.0);
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * std::numbers::pi * i / n;
    boxes.push_back({.center = {r * std::cos(a), r * std::sin(a), 0.5},
                     .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(a, Vec3::UnitZ()))});
    scene.loads.forces.push_back(
        {.block = i + 1, .point = {}, .force = Q * Vec3(std::cos(a), std::sin(a), 0), .time = {}});
  }
  Assembly assembly = testing::make_boxes(boxes);
  assembly.chains = {{"iron", 0.5}};
  for (int i = 0; i < n; ++i) {
    BuiltTie bar{i + 1, (i + 1) % n + 1, boxes[i + 1].center, boxes[(i + 1) % n + 1].center, k};
    bar.length = (bar.point_b - bar.point_a).norm() + slack;
    bar.chain = 0;
    assembly.ties.push_back(bar);
  }
  const Model model = make_model(scene, assembly);
  ASSERT_EQ(model.ties.size(), static_cast<size_t>(n));
  const StaticSolution solution = solve_at_rest(model, assembly);
  ASSERT_EQ(solution.outcome, StaticOutcome::equilibrium) << solution.message;
  const double sine = std::sin(std::numbers::pi / n), T = Q / (2.0 * sine);
  for (const double force : solution.forces.ties) EXPECT_NEAR(force / T, 1.0, 1e-6);
  // A bar is 2 sin(pi / n) times as long as the radius.
  const double outward = solution.h * solution.step_solution.v[0];
  EXPECT_NEAR(outward / ((T / k + slack) / (2.0 * sine)), 1.0, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Slack, RingOfBlocks, ::testing::Values(0.0, 0.002),
                         test_names({"None", "TwoMillimetres"}));

/// The hanging cube (block 1) on two parallel ties at equal distances from its centroid.
Case on_two_ties(double k, double yield, double load) {
  Case scene = make_case(0.4, 1e-8, 1.0);
  scene.loads.gravity = Vec3::Zero();
  for (const double y : {-0.4, -0.2, 0.2, 0.4}) {
    PairTie tie = vertical_tie(k);
    tie.point_a = Vec3(0, y, 2.5);
    tie.point_b = Vec3(0, y, 1.5);
    if (std::abs(y) < 0.3) tie.yield_force = yield;
    scene.ties.pairs.push_back(tie);
  }
  scene.loads.forces = {{.block = 1, .point = {}, .force = Vec3(0, 0, -load), .time = {}}};
  return scene;
}

// Two of four equal ties yield at Y under the load P > 4 Y: the others carry the rest and give the
// displacement.
TEST(YieldingTie, CarriesItsYieldForceInStatics) {
  const double k = 1e6, Y = 1000.0, P = 6000.0;
  const Assembly assembly = hanging_cube();
  const Model model = make_model(on_two_ties(k, Y, P), assembly);
  const StaticSolution solution = solve_at_rest(model, assembly);
  ASSERT_EQ(solution.outcome, StaticOutcome::equilibrium) << solution.message;
  const double rest = 0.5 * (P - 2.0 * Y);
  EXPECT_NEAR(solution.forces.ties[1] / Y, 1.0, 1e-9);
  EXPECT_NEAR(solution.forces.ties[0] / rest, 1.0, 1e-8);
  EXPECT_NEAR(-solution.h * solution.step_solution.v[2] / (rest / k), 1.0, 1e-8);
}

// Unloaded to P1, a yielded tie is too long by its plastic elongation p = (P - 4 Y) / 2k.
TEST(YieldingTie, KeepsItsElongationAlongAPath) {
  const double k = 1e6, Y = 1000.0, P = 6000.0, P1 = 3000.0;
  const Assembly assembly = hanging_cube();
  Case scene = on_two_ties(k, Y, P);
  scene.loads.forces[0].time = TableInTime{"", {0.0, 1.0, 2.0}, {0.0, 1.0, P1 / P}};
  const Model model = make_model(scene, assembly);
  EquilibriumPath path(model, {}, {.tolerance = 1e-10});
  for (const double time : {0.5, 1.0, 2.0}) {
    const StaticSolution solution = path.advance(time);
    ASSERT_EQ(solution.outcome, StaticOutcome::equilibrium) << solution.message;
    if (time < 2.0) continue;
    const double p = (P - 4.0 * Y) / (2.0 * k), down = (P1 + 2.0 * k * p) / (4.0 * k);
    EXPECT_NEAR(solution.forces.ties[0] / (k * down), 1.0, 1e-6);
    EXPECT_NEAR(solution.forces.ties[1] / (k * (down - p)), 1.0, 1e-6);
  }
}

// The ceiling moves aside by d while a wind grows to H: the cube, of weight W, hangs on below, in the line of
// H and W through its centroid, at tan(lean) = H / W. Without the stiffness T / length of the swing it was
// proven to fall.
TEST(Tie, WhatHangsOnItFollowsAlongAPath) {
  const double k = 1e6, W = 1000.0 * kG, H = 0.2 * W, d = 0.3;
  Case scene = make_case(0.4, 1e-8, 1.0);
  const TableInTime growing{"", {0.0, 1.0}, {0.0, 1.0}};
  scene.loads.forces = {{.block = 1, .point = {}, .force = Vec3(H, 0, 0), .time = growing}};
  SupportMove aside;
  aside.displacement = Vec3(d, 0, 0);
  aside.time = growing;
  scene.supports.moves = {aside};
  for (const bool rod : {false, true}) {  // which also pushes
    Assembly assembly = hanging_cube();
    const PairTie tie = vertical_tie(k);
    if (rod) assembly.ties = {{0, 1, *tie.point_a, *tie.point_b, k, 1.0, true, INFINITY, -1}};
    scene.ties.pairs = rod ? std::vector<PairTie>{} : std::vector{tie};
    const Model model = make_model(scene, assembly);
    EquilibriumPath path(model, {}, {.tolerance = 1e-10}, PathGeometry::end);
    for (const double time : {0.0, 0.5, 1.0}) {
      const StaticSolution solution = path.advance(time);
      ASSERT_EQ(solution.outcome, StaticOutcome::equilibrium) << time << ": " << solution.message;
      const double lean = std::atan(time * H / W), T = std::hypot(W, time * H);
      // To the elongation that the last solve adds, 1e-8 of the cube, and the tolerance.
      EXPECT_NEAR(solution.forces.ties[0] / T, 1.0, 1e-7);
      EXPECT_NEAR(path.state().poses[1].p_WB.x(), time * d + (1.5 + T / k) * std::sin(lean), 1e-7);
    }
  }
}

// A load beyond the sum of the yield forces moves the cube: the work of yielding is part of the proof.
TEST(YieldingTie, IsProvenNotToHoldMoreThanItsYieldForce) {
  const Assembly assembly = hanging_cube();
  for (const double share : {0.999, 1.001}) {
    Case scene = make_case(0.4, 1e-8, 1.0);
    PairTie tie = vertical_tie(1e7);
    tie.yield_force = 1000.0 * kG / share;
    scene.ties.pairs = {tie};
    const StaticSolution solution = solve_at_rest(make_model(scene, assembly), assembly);
    EXPECT_EQ(solution.outcome, share < 1.0 ? StaticOutcome::equilibrium : StaticOutcome::moving)
        << solution.message;
  }
}

// Elastic, perfectly plastic spring under a suddenly applied weight, implicit Euler: the trial force of each
// step is cut off at the yield force Y, and the rest of the elongation is plastic. The account of energy
// closes.
TEST(YieldingTie, InMotionIsTheImplicitEulerSpringThatYields) {
  const Assembly assembly = hanging_cube();
  const double h = 0.002, k = 1e6, m = 1000.0, Y = 1.2 * m * kG, w2 = k / m;
  Case scene = make_case(0.4, 1e-8, h);
  PairTie tie = vertical_tie(k);
  tie.yield_force = Y;
  scene.ties.pairs = {tie};
  testing::AccountedSimulation simulation(scene, assembly);
  double v = 0.0, y = 0.0, plastic = 0.0, energy = simulation.energy().total();
  int yielding = 0;
  for (int step = 1; step <= 200; ++step) {
    const StepReport report = simulation.advance();
    const double elastic = (v - kG * h - w2 * h * (y + plastic)) / (1.0 + w2 * h * h);
    double force = -k * (y + plastic + h * elastic);
    if (force > Y) force = Y;
    v += h * (force / m - kG);
    y += h * v;
    if (force == Y) plastic = -y - Y / k;
    yielding += force == Y ? 1 : 0;
    ASSERT_NEAR(simulation.state().v[2], v, 1e-9) << "step " << step;
    ASSERT_NEAR(report.forces.ties[0] / force, 1.0, 1e-7) << "step " << step;
    const double after = simulation.energy().total();
    EXPECT_NEAR(after - energy, report.work.change(), 1e-9 * m * kG * 0.1) << "step " << step;
    energy = after;
  }
  EXPECT_GT(yielding, 10);
  EXPECT_LT(yielding, 190);  // it swings on elastically
  EXPECT_NEAR(simulation.memories().ties[0].yielded / plastic, 1.0, 1e-6);
}

// Two inclined bars of rise f and half span a, each of weight W, on a frictionless floor and tied at their
// feet: the tie carries H = W a / (2 f) within the depth of the crown joint.
TEST(Tie, HoldsATwoBarArch) {
  const double a = 4.0, f = 3.0, e = 0.01, width = 1.0;
  Assembly assembly = testing::make_boxes({{.center = {0, 0.5, -0.5}, .size = {20, 4, 1}, .fixed = true}});
  // Feet of width e on the floor at x = -+a, a crown joint of depth e at x = 0.
  testing::add_voussoir({Eigen::Vector2d(a - e, 0), {a, 0}, {0, f}, {0, f - e}}, width, 1000.0, false, 0,
                        &assembly);
  testing::add_voussoir({Eigen::Vector2d(-a, 0), {-a + e, 0}, {0, f - e}, {0, f}}, width, 1000.0, false, 0,
                        &assembly);
  compute_mass_properties(&assembly);
  Case scene = make_case(0.0, 1e-10, 1.0);
  PairTie tie;
  tie.block_a = 1;
  tie.block_b = 2;
  tie.point_a = Vec3(a, 0.5, 0);
  tie.point_b = Vec3(-a, 0.5, 0);
  tie.stiffness = 1e9;
  scene.ties.pairs = {tie};
  const StaticSolution solution = solve_at_rest(make_model(scene, assembly), assembly);
  ASSERT_EQ(solution.outcome, StaticOutcome::equilibrium) << solution.message;
  const double W = assembly.blocks[1].mass * kG, x_c = assembly.blocks[1].centroid.x();
  // The lever arms W has about the foot and H about the crown joint are uncertain by e.
  EXPECT_NEAR(solution.forces.ties[0] / (W * (a - x_c) / f), 1.0, 2.0 * e / (a - x_c) + e / f);
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
}

// From the centroid of a block to itself: its length is zero, too, but not because of a prestress.
TEST(Tie, FromABlockToItselfIsNamedAsSuch) {
  Case scene;
  scene.ties.pairs = {vertical_tie(1e6), PairTie{}};
  scene.ties.pairs[1].block_a = scene.ties.pairs[1].block_b = 1;
  scene.ties.pairs[1].stiffness = 1e7;
  try {
    make_ties(scene, hanging_cube());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "error: ties.pairs[1]: both ends are on block 1; a tie connects two blocks");
  }
}

TEST(Tie, BetweenSupportsIsRefused) {
  Case scene;
  scene.ties.pairs = {vertical_tie(1e6)};
  Assembly assembly = hanging_cube();
  for (Block& block : assembly.blocks) block.fixed = true;
  EXPECT_THROW(make_ties(scene, assembly), InputError);
}

}  // namespace
}  // namespace cupola::ties_test
