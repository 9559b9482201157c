#include "solver/contact/methods/newton.hpp"

#include <gtest/gtest.h>

#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "tests/solver/contact/contact_scenes.hpp"

namespace cupola::newton_test {
namespace {

using scenes::kGravity;

struct Solved {
  ContactSolution x;
  SolveSummary summary;
  Residuals residuals;
};

Solved solve(const ContactProblem& problem, double tolerance = 1e-10) {
  Solved result;
  SolveOptions options;
  options.tolerance = tolerance;
  options.reference_speed = kGravity * problem.h;
  result.summary = NewtonSolver().solve(problem, options, &result.x);
  if (result.summary.usable()) {
    result.residuals = compute_residuals(problem, result.x, options.reference_speed);
  }
  return result;
}

double normal_force(const Solved& s, const ContactProblem& p, int i) {
  return s.x.gamma[3 * i] / p.h;
}

TEST(Newton, FreeBlocksFallFreely) {
  scenes::Scene scene(0.01, {0, 0, -kGravity});
  scene.add_box({0, 0, 5}, {1, 1, 1}, 2000.0);
  const ContactProblem problem = scene.problem();
  const Solved s = solve(problem);
  EXPECT_EQ(s.summary.ending, SolveEnding::converged) << s.summary.message;
  EXPECT_LE((s.x.v - problem.v_star).norm(), 1e-16);
  EXPECT_EQ(s.x.gamma.size(), 0);
}

TEST(Newton, SolvesAProblemWithoutBlocks) {
  ContactProblem problem;
  problem.h = 0.01;
  const Solved s = solve(problem);
  EXPECT_EQ(s.summary.ending, SolveEnding::converged) << s.summary.message;
}

// A block on n compliant contacts, first step from rest, by implicit Euler: v1 = -g h / (1 + k h^2 / m), k =
// n / c.
TEST(Newton, CompliantContactIsAnImplicitSpring) {
  const double h = 0.002, c = 1e-6;
  const ContactProblem problem = scenes::stack({1000.0}, h, {0.4, c, c});
  const Solved s = solve(problem);
  const double expected = -kGravity * h / (1.0 + 4.0 / c * h * h / 1000.0);
  EXPECT_NEAR(s.x.v[2], expected, 1e-12 * std::abs(expected));
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(normal_force(s, problem, i), -expected * h / c, 1e-9);
}

// Closed form of the discrete scheme for a block on an incline with rigid contacts under the associated law:
// speed after N steps A h (N - mu^2 (1 - r^N)), gap h mu times the speed, with A = g (sin a - mu cos a) and
// r = mu^2 / (1 + mu^2). Here the compliance is c m / h^2 = 1e-12; its effect is of that order.
TEST(Newton, InclineSlidesWithAssociatedDilation) {
  const double h = 0.01, mu = 0.4, slope = 0.5, angle = std::atan(slope);
  const double c = 1e-12 * h * h / 400.0;
  const double A = kGravity * (std::sin(angle) - mu * std::cos(angle)), r = mu * mu / (1 + mu * mu);
  double speed = 0.0, normal_speed = 0.0, gap = 0.0;
  for (int n = 1; n <= 10; ++n) {
    ContactProblem problem = scenes::incline(slope, h, {mu, c, c}, speed, gap);
    problem.v_star[2] += normal_speed;
    const Solved s = solve(problem, 1e-12);
    // gamma(v) is accurate to eps v / E only, so the solve may end as `stalled`; the velocities are exact.
    ASSERT_TRUE(s.summary.usable()) << s.summary.message;
    speed = s.x.v[0];
    normal_speed = s.x.v[2];
    gap += h * normal_speed;
    EXPECT_NEAR(speed, A * h * (n - mu * mu * (1 - std::pow(r, n))), 1e-9 * A * h * n) << "step " << n;
    EXPECT_NEAR(gap, h * mu * speed, 1e-9 * h * mu * speed) << "step " << n;
  }
  EXPECT_NEAR(speed, 0.086339414522, 1e-11);
}

TEST(Newton, InclineSticksBelowTheFrictionAngle) {
  const double h = 0.01, c = 1e-14;
  const Solved stick = solve(scenes::incline(std::tan(21.7 * std::numbers::pi / 180), h, {0.4, c, c}));
  EXPECT_LT(stick.x.v.norm(), 1e-8);  // elastic creep c T / h = 4e-10 m/s, and the pitch caused by it
  const Solved slip = solve(scenes::incline(std::tan(21.9 * std::numbers::pi / 180), h, {0.4, c, c}));
  EXPECT_GT(slip.x.v[0], 1e-4);
}

// F_i = W (1/4 + x x_i / 4 + y y_i / 4) for legs of equal compliance, whatever its value.
TEST(Newton, TableLegsShareTheLoadByTheirLeverArms) {
  for (const double c : {1e-12, 1e-8, 1e-4}) {
    const ContactProblem problem = scenes::table(1000.0, 0.3, 0.2, 1e3, {0.4, c, c});
    const Solved s = solve(problem);
    ASSERT_EQ(s.summary.ending, SolveEnding::converged) << s.summary.message;
    const double share = 1.0 - 1000.0 / kGravity * c / (4 * 1e6);  // the rest is carried by inertia
    const std::array expected{0.375, 0.275, 0.225, 0.125};
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(normal_force(s, problem, i), share * 1000.0 * expected[i], 1e-6);
  }
}

// With b_t = 0 (paper eq. 8, 13-14) a sticking contact under the tangential force T creeps at the speed c_t T
// / h, independent of c_n. The contacts are at the height of the centroid, so the block does not pitch.
TEST(Newton, StickingContactCreepsWithoutMemory) {
  const double h = 0.01, c_n = 1e-9, c_t = 1e-8, mass = 400.0, T = 900.0;
  const double creep = c_t * T / 4 / h;
  scenes::Scene scene(h, {T / mass, 0, -kGravity});
  const int block = scene.add_block({0, 0, 0}, mass, mass * Mat3::Identity(), {creep, 0, 0});
  scene.add_patch(scenes::kGround, block, {0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 1}, {0.4, c_n, c_t});
  const Solved s = solve(scene.problem());
  EXPECT_NEAR(s.x.v[0], creep, 1e-12 * creep);
}

TEST(Newton, ContactLawResidualDetectsSelfStress) {
  // A block between two walls admits self-stress: gamma + t gamma_0 with D gamma_0 = 0. Add one percent of
  // it.
  scenes::Scene scene(1e3, {0, 0, -kGravity});
  const int block = scene.add_box({0, 0, 0}, {1, 1, 1}, 2000.0);
  const scenes::Joint joint{0.8, 1e-8, 1e-8};
  scene.add_patch(scenes::kGround, block, {0, 0, -0.5}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 1}, joint);
  scene.add_patch(scenes::kGround, block, {0, 0, 0.5}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, -1}, joint);
  const ContactProblem problem = scene.problem();
  Solved s = solve(problem);
  EXPECT_LE(s.residuals.contact_law, 1e-12);
  VecX self_stress = VecX::Zero(problem.b.size());
  for (int i = 0; i < 8; ++i) self_stress[3 * i] = 1.0;
  ASSERT_LE(generalized_impulse(problem, self_stress).norm(), 1e-15);
  s.x.gamma += 0.01 * s.x.gamma.norm() / self_stress.norm() * self_stress;
  const Residuals spoiled = compute_residuals(problem, s.x, kGravity * problem.h);
  EXPECT_GT(spoiled.contact_law, 1e-3);
  EXPECT_LE(spoiled.momentum, 1e-10);
}

TEST(Newton, DomeConvergesAtEveryStiffness) {
  scenes::DomeShape shape;
  shape.rings = 10;
  shape.blocks_per_ring = 16;
  for (const auto& [h, c] :
       {std::pair{1e-3, 1e-8}, {0.01, 1e-8}, {1.0, 1e-8}, {1e3, 1e-8}, {1e3, 1e-12}, {1e-3, 1e-4}}) {
    const Solved s = solve(scenes::dome(shape, h, {0.4, c, c}));
    EXPECT_EQ(s.summary.ending, SolveEnding::converged) << h << " " << c << " " << s.summary.message;
    EXPECT_LE(s.residuals.momentum, 1.1e-10);
    EXPECT_LE(s.residuals.contact_law, 1e-10);
    EXPECT_LE(s.residuals.cone_violation, 1e-14);
    ASSERT_TRUE(s.residuals.certificate.value.has_value());
    EXPECT_LE(*s.residuals.certificate.value, 1e-6);
  }
}

TEST(Newton, CertifiedErrorBoundsTheTrueError) {
  scenes::DomeShape shape;
  shape.rings = 10;
  shape.blocks_per_ring = 16;
  const ContactProblem problem = scenes::dome(shape, 1.0, {0.4, 1e-8, 1e-8});
  const Solved reference = solve(problem, 1e-12);
  for (const double tolerance : {0.9, 0.1, 1e-2, 1e-4}) {
    const Solved rough = solve(problem, tolerance);
    const double error = (rough.x.gamma - reference.x.gamma).norm() / rough.x.gamma.norm();
    EXPECT_GE(rough.residuals.certificate.value.value() * (1 + 1e-9) + 1e-11, error) << tolerance;
  }
}

TEST(Newton, WarmStartFromTheSolutionNeedsNoIteration) {
  const ContactProblem problem = scenes::stack({2000, 1000, 3000}, 0.01, {0.4, 1e-8, 1e-8});
  Solved s = solve(problem);
  SolveOptions options;
  options.reference_speed = kGravity * problem.h;
  EXPECT_EQ(NewtonSolver().solve(problem, options, &s.x).iterations, 0);
}

TEST(Newton, HeavyBlockOnALightOne) {
  const ContactProblem problem = scenes::stack({1.0, 1e6}, 1e3, {0.4, 1e-10, 1e-10});
  const Solved s = solve(problem);
  ASSERT_EQ(s.summary.ending, SolveEnding::converged) << s.summary.message;
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(normal_force(s, problem, i), (1e6 + 1) * kGravity / 4, 1.0);  // 1e-7 W: share of inertia
}

TEST(Newton, InvalidInputFailsWithAMessage) {
  const ContactProblem good = scenes::stack({2000}, 0.01, {0.4, 1e-8, 1e-8});
  const auto message_of = [](const ContactProblem& p) {
    const Solved s = solve(p);
    EXPECT_EQ(s.summary.ending, SolveEnding::failed);
    return s.summary.message;
  };
  ContactProblem p = good;
  p.v_star[3] = std::nan("");
  EXPECT_NE(message_of(p).find("v_star of block 0"), std::string::npos);
  p = good;
  p.M[0](5, 5) = -1.0;
  EXPECT_NE(message_of(p).find("not positive definite"), std::string::npos);
  p = good;
  p.M[0](0, 5) = 1e3;
  EXPECT_NE(message_of(p).find("the mass matrix of block 0 is not symmetric"), std::string::npos);
  p = good;
  p.D_b[3].frame(2, 1) = std::nan("");
  EXPECT_NE(message_of(p).find("D_b of contact 3 is not finite"), std::string::npos);
  p = good;
  p.E[3] = -1e-8;
  EXPECT_NE(message_of(p).find("E of contact 1 = (-1e-08, "), std::string::npos);
  p = good;
  p.E[5] *= 2.0;
  EXPECT_NE(message_of(p).find("E of contact 1 differs between the tangents"), std::string::npos);
  p = good;
  p.E[4] = p.E[5] = 0.0;
  EXPECT_NE(message_of(p).find("contact 1 has zero compliance"), std::string::npos);
  p = good;
  p.mu[2] = -0.1;
  EXPECT_NE(message_of(p).find("mu of contact 2"), std::string::npos);
  p = good;
  p.block_b[1] = 7;
  EXPECT_NE(message_of(p).find("contact 1 joins blocks "), std::string::npos);
  p = good;
  p.b.conservativeResize(2);
  EXPECT_NE(message_of(p).find("b has 2 entries, expected 12"), std::string::npos);
}

TEST(Newton, DoesNotReadTheRowsOfFixedBlocks) {
  ContactProblem problem = scenes::stack({2000}, 0.01, {0.0, 1e-8, 1e-8});
  const Solved clean = solve(problem);
  for (Lever& D : problem.D_a) D.frame.setConstant(std::nan(""));  // the side of the ground
  const Solved poisoned = solve(problem);
  EXPECT_EQ(poisoned.x.v, clean.x.v);
}

TEST(Newton, GivesTheSameBitsOnEveryRun) {
  scenes::DomeShape shape;
  shape.rings = 10;
  shape.blocks_per_ring = 16;
  shape.gap = 1e-4;
  const ContactProblem problem = scenes::dome(shape, 1.0, {0.4, 1e-8, 1e-8});
  const Solved first = solve(problem), second = solve(problem);
  EXPECT_EQ(first.x.v, second.x.v);
  EXPECT_EQ(first.x.gamma, second.x.gamma);
}

// One sector whose neighbours are images of its own blocks has the same contact forces as the whole dome.
TEST(Newton, SectorHasTheForcesOfTheWholeDome) {
  scenes::DomeShape shape;
  shape.rings = 8;
  shape.blocks_per_ring = 16;
  const Solved whole = solve(scenes::dome(shape, 1.0, {0.4, 1e-8, 1e-8}), 1e-12);
  shape.sectors = 4;
  const ContactProblem problem = scenes::dome(shape, 1.0, {0.4, 1e-8, 1e-8});
  const Solved sector = solve(problem, 1e-12);
  ASSERT_EQ(problem.num_blocks(), 8 * 4);
  for (int ring = 0; ring < 8; ++ring) {
    const Eigen::Index size = 4 * 12 * 3;  // slots, contacts, rows: the first sector of each ring
    const VecX expected = whole.x.gamma.segment(ring * 4 * size, size);
    EXPECT_LE((sector.x.gamma.segment(ring * size, size) - expected).norm(), 1e-9 * expected.norm()) << ring;
  }
}

}  // namespace
}  // namespace cupola::newton_test
