#include "solver/contact/methods/coulomb_newton.hpp"

#include <gtest/gtest.h>

#include "solver/contact/methods/solve_contact.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "tests/solver/contact/contact_scenes.hpp"

namespace cupola::coulomb_newton_test {
namespace {

using scenes::kGravity;

ContactSolverOptions options_for(const ContactProblem& problem, double tolerance) {
  ContactSolverOptions options;
  options.law = FrictionLaw::coulomb;
  options.tolerance = tolerance;
  options.reference_speed = kGravity * problem.h;
  return options;
}

/// Solves with a cold start and checks the residuals of the solution.
ContactSolution solve(const ContactProblem& problem, double tolerance = 1e-10) {
  ContactSolution x;
  const SolveSummary summary = CoulombNewton().solve(problem, options_for(problem, tolerance), &x);
  EXPECT_EQ(summary.ending, SolveEnding::converged) << summary.message;
  if (!summary.usable()) return x;
  const Residuals residuals = compute_residuals(problem, x, kGravity * problem.h, FrictionLaw::coulomb);
  EXPECT_LE(excess(residuals, tolerance), 1.0) << summary.message;
  return x;
}

// A block on an incline under Coulomb's law gains the speed g (sin a - mu cos a) h in a step, with rigid
// contacts or with compliant ones (whose effect is 1e-10 of the weight here).
TEST(CoulombNewton, SlidesDownTheIncline) {
  const double h = 0.01, angle = std::atan(0.5), A = kGravity * (std::sin(angle) - 0.4 * std::cos(angle));
  for (const double c : {0.0, 1e-15}) {
    const ContactSolution x = solve(scenes::incline(0.5, h, {0.4, c, c}));
    EXPECT_NEAR(x.v[0], A * h, 1e-9 * kGravity * h) << c;
    EXPECT_NEAR(x.v[2], 0.0, 1e-9 * kGravity * h) << c;
  }
}

// The first step of a rigid dome whose contacts stick: symmetric factors and inexact subproblems lead to the
// solution that exact steps from free fall lead to.
TEST(CoulombNewton, SticksAsFromFreeFall) {
  scenes::DomeShape shape;
  shape.rings = 8;
  shape.blocks_per_ring = 12;
  const ContactProblem problem = scenes::dome(shape, 0.01, {0.4, 0.0, 0.0});
  const ContactSolverOptions options = options_for(problem, 1e-8);
  ContactSolution x, falling{problem.v_star, {}};
  const SolveSummary summary = CoulombNewton().solve(problem, options, &x);
  const SolveSummary slow = CoulombNewton().solve(problem, options, &falling);
  EXPECT_EQ(summary.ending, SolveEnding::converged) << summary.message;
  EXPECT_EQ(slow.ending, SolveEnding::converged) << slow.message;
  EXPECT_LE(excess(compute_residuals(problem, x, options.reference_speed, options.law), options.tolerance),
            1.0);
  const double speed = options.reference_speed;
  EXPECT_LE((x.v - falling.v).lpNorm<Eigen::Infinity>(), 1e-6 * speed);  // 100 tolerances: condition
  EXPECT_LE((x.gamma - falling.gamma).norm(), 1e-4 * x.gamma.norm());    // self-stress depends on the path
  EXPECT_LE(3 * summary.factorizations, summary.iterations);
  EXPECT_LE(5 * summary.factorizations, slow.factorizations);
}

// The next step of a dome that slides: the proximal compliance that ended the last solve suits it.
TEST(CoulombNewton, CarriesTheProximalComplianceAlongASlide) {
  scenes::DomeShape shape;
  shape.rings = 8;
  shape.blocks_per_ring = 12;
  const ContactProblem first = scenes::dome(shape, 0.01, {0.05, 0.0, 0.0});
  const ContactSolverOptions options = options_for(first, 1e-3);
  CoulombNewton solver;
  ContactSolution x;
  solver.solve(first, options, &x);
  ContactProblem second = first;
  second.v_star += x.v;
  ContactSolution carried = x, fresh = x;
  const SolveSummary by_carried = solver.solve(second, options, &carried);
  const SolveSummary by_fresh = CoulombNewton().solve(second, options, &fresh);
  EXPECT_EQ(by_carried.ending, SolveEnding::converged) << by_carried.message;
  EXPECT_LE(2 * by_carried.outer_iterations, by_fresh.outer_iterations);
  EXPECT_LE(
      excess(compute_residuals(second, carried, options.reference_speed, options.law), options.tolerance),
      1.0);
}

// A step from rest with dilatancy theta: v_n = theta mu v_t and N = m (g h cos a + v_n), so that
// v_t = A h / (1 + theta mu^2). At theta = 1 this is the first speed of the associated law's closed form.
TEST(CoulombNewton, OpensTheContactByTheDilatancy) {
  const double h = 0.01, mu = 0.4, angle = std::atan(0.5);
  const double A = kGravity * (std::sin(angle) - mu * std::cos(angle));
  for (const double dilatancy : {0.0, 0.25, 0.75}) {
    for (const double c : {0.0, 1e-15}) {
      const ContactProblem problem = scenes::incline(0.5, h, {mu, c, c});
      ContactSolverOptions options = options_for(problem, 1e-10);
      options.law = FlowRule(dilatancy);
      ContactSolution x;
      const SolveSummary summary = CoulombNewton().solve(problem, options, &x);
      ASSERT_EQ(summary.ending, SolveEnding::converged) << summary.message;
      const double v_t = A * h / (1.0 + dilatancy * mu * mu);
      EXPECT_NEAR(x.v[0], v_t, 1e-9 * kGravity * h) << dilatancy;
      EXPECT_NEAR(x.v[2], dilatancy * mu * v_t, 1e-9 * kGravity * h) << dilatancy;
    }
  }
}

TEST(CoulombNewton, AgreesWithTheOuterIterations) {
  scenes::DomeShape shape;
  shape.rings = 8;
  shape.blocks_per_ring = 12;
  for (const double mu : {0.0, 0.2, 0.4}) {
    const ContactProblem problem = scenes::dome(shape, 1.0, {mu, 1e-8, 1e-8});
    ContactSolverOptions options = options_for(problem, 1e-10);
    options.method = ContactMethod::interior_point;
    ContactSolution reference;
    const SolveSummary summary = solve_contact(problem, options, &reference);
    ASSERT_EQ(summary.ending, SolveEnding::converged) << summary.message;
    EXPECT_LE((solve(problem).gamma - reference.gamma).norm(), 1e-7 * reference.gamma.norm()) << mu;
  }
}

TEST(CoulombNewton, ReportsItsEndingForAnyInput) {
  ContactProblem broken = scenes::incline(0.5, 0.01, {0.4, 1e-8, 1e-8});
  broken.mu[0] = -1.0;
  ContactSolution x;
  EXPECT_EQ(CoulombNewton().solve(broken, options_for(broken, 1e-8), &x).ending, SolveEnding::failed);
  // Above mu = 1 there may be no solution. `converged` must agree with the residuals.
  scenes::DomeShape shape;
  shape.rings = 4;
  shape.blocks_per_ring = 8;
  for (const double mu : {1.5, 10.0})
    for (const double c : {1e-8, 0.0}) {
      const ContactProblem problem = scenes::dome(shape, 0.01, {mu, c, c});
      ContactSolution answer;
      const SolveSummary summary = CoulombNewton().solve(problem, options_for(problem, 1e-8), &answer);
      if (!summary.usable()) continue;
      const Residuals residuals =
          compute_residuals(problem, answer, kGravity * problem.h, FrictionLaw::coulomb);
      EXPECT_EQ(summary.ending == SolveEnding::converged, excess(residuals, 1e-8) <= 1.0) << mu << " " << c;
    }
}

}  // namespace
}  // namespace cupola::coulomb_newton_test
