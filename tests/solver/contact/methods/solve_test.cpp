#include <gtest/gtest.h>

#include "solver/contact/methods/solve_contact.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "tests/solver/contact/contact_scenes.hpp"

namespace cupola::solve_test {
namespace {

using scenes::kGravity;

struct Solved {
  ContactSolution x;
  SolveSummary summary;
  Residuals residuals;
};

Solved solve(const ContactProblem& problem, FrictionLaw law, double tolerance = 1e-10,
             ContactMethod method = ContactMethod::newton) {
  Solved result;
  ContactSolverOptions options;
  options.tolerance = tolerance;
  options.reference_speed = kGravity * problem.h;
  options.method = method;
  options.law = law;
  result.summary = solve_contact(problem, options, &result.x);
  if (result.summary.usable()) {
    result.residuals = compute_residuals(problem, result.x, options.reference_speed, law);
  }
  return result;
}

constexpr auto kAssociated = FrictionLaw::associated;
constexpr auto kCoulomb = FrictionLaw::coulomb;

/// Steps of a block that slides down an incline, as pairs (speed, gap).
std::vector<std::pair<double, double>> slide(double h, double c, FrictionLaw law, int num_steps) {
  std::vector<std::pair<double, double>> history;
  double speed = 0.0, normal_speed = 0.0, gap = 0.0;
  for (int n = 0; n < num_steps; ++n) {
    ContactProblem problem = scenes::incline(0.5, h, {0.4, c, c}, speed, gap);
    problem.v_star[2] += normal_speed;
    const Solved s = solve(problem, law, 1e-12);
    EXPECT_EQ(s.summary.ending, SolveEnding::converged) << s.summary.message;
    speed = s.x.v[0];
    normal_speed = s.x.v[2];
    gap += h * normal_speed;
    history.emplace_back(speed, gap);
  }
  return history;
}

// Closed form for zero compliance under the associated law: speed s_N = A h (N - mu^2 (1 - r^N)), gap h mu
// s_N.
TEST(SolveContact, RigidInclineMatchesTheClosedForm) {
  const double h = 0.01, mu = 0.4, angle = std::atan(0.5);
  const double A = kGravity * (std::sin(angle) - mu * std::cos(angle)), r = mu * mu / (1 + mu * mu);
  for (const double c : {0.0, 1e-12 * h * h / 400.0}) {
    const auto history = slide(h, c, kAssociated, 10);
    for (int n = 1; n <= 10; ++n) {
      const double expected = A * h * (n - mu * mu * (1 - std::pow(r, n)));
      EXPECT_NEAR(history[n - 1].first, expected, 1e-12 * h * kGravity * n) << "c = " << c << " step " << n;
      EXPECT_NEAR(history[n - 1].second, h * mu * expected, 1e-12 * h * h * kGravity * n)
          << "c = " << c << " step " << n;
    }
    EXPECT_NEAR(history[0].first, 0.007564078227, 1e-12);
    EXPECT_NEAR(history[9].first, 0.086339414522, 1e-12);
  }
}

TEST(SolveContact, CoulombInclineKeepsContact) {  // s_N = A h N, gap 0
  const double h = 0.01, angle = std::atan(0.5), A = kGravity * (std::sin(angle) - 0.4 * std::cos(angle));
  const auto history = slide(h, 0.0, kCoulomb, 10);
  for (int n = 1; n <= 10; ++n) {
    EXPECT_NEAR(history[n - 1].first, A * h * n, 1e-10 * n * h * kGravity);
    EXPECT_NEAR(history[n - 1].second, 0.0, 1e-10 * n * h * h * kGravity);
  }
}

// Without compliance any distribution of the load over the legs with the correct resultants is a solution.
TEST(SolveContact, RigidTableHasTheCorrectResultants) {
  const ContactProblem problem = scenes::table(1000.0, 0.3, 0.2, 0.01, {0.4, 0.0, 0.0});
  const Solved s = solve(problem, kAssociated);
  ASSERT_EQ(s.summary.ending, SolveEnding::converged) << s.summary.message;
  EXPECT_FALSE(forces_unique(problem, kAssociated).value);
  EXPECT_LE(s.x.v.norm(), 1e-10 * kGravity * problem.h);
  Vec3 resultant = Vec3::Zero();  // W, moments about x and y
  const double x[] = {1, 1, -1, -1}, y[] = {1, -1, 1, -1};
  for (int i = 0; i < 4; ++i) resultant += s.x.gamma[3 * i] / problem.h * Vec3(1, x[i], y[i]);
  EXPECT_LE((resultant - Vec3(1000, 300, 200)).norm(), 1e-7);
  EXPECT_FALSE(s.residuals.certificate.value.has_value());
}

// Limits of tilt. Associated law, from rest: tan theta = mu / sqrt(cos^2 phi - mu^2 sin^2 phi), 47.96 deg.
// Coulomb's law, prism in motion: tan theta = mu / cos phi, 44.13 deg. (At rest and with rigid contacts
// self-stress may hold the prism under Coulomb's law too.)
TEST(SolveContact, GrooveDistinguishesTheLaws) {
  const double phi = std::numbers::pi / 6, deg = std::numbers::pi / 180, mu = 0.84, h = 0.01;
  const double associated =
      std::atan(mu / std::sqrt(std::pow(std::cos(phi), 2) - std::pow(mu * std::sin(phi), 2)));
  const double coulomb = std::atan(mu / std::cos(phi));
  EXPECT_NEAR(associated / deg, 47.96, 0.005);
  EXPECT_NEAR(coulomb / deg, 44.13, 0.005);
  const auto speed_after = [&](double theta, double speed, FrictionLaw law) {
    const Solved s = solve(scenes::groove(phi, theta, h, {mu, 0, 0}, {speed, 0, 0}), law);
    EXPECT_EQ(s.summary.ending, SolveEnding::converged) << s.summary.message;
    return s.x.v[0];
  };
  EXPECT_LT(std::abs(speed_after(associated - 0.1 * deg, 0.0, kAssociated)), 1e-5 * kGravity * h);
  EXPECT_GT(speed_after(associated + 0.1 * deg, 0.0, kAssociated), 5e-4 * kGravity * h);
  EXPECT_LT(speed_after(coulomb - 0.1 * deg, 0.5, kCoulomb), 0.5);
  EXPECT_GT(speed_after(coulomb + 0.1 * deg, 0.5, kCoulomb), 0.5);
}

TEST(SolveContact, CoulombGrooveMatchesTheClosedForm) {  // a = g (sin th - mu cos th / cos phi)
  const double phi = std::numbers::pi / 6, theta = 49 * std::numbers::pi / 180, mu = 0.84, h = 0.01;
  const Solved s = solve(scenes::groove(phi, theta, h, {mu, 0, 0}, {0.5, 0, 0}), kCoulomb);
  ASSERT_EQ(s.summary.ending, SolveEnding::converged) << s.summary.message;
  const double a = kGravity * (std::sin(theta) - mu * std::cos(theta) / std::cos(phi));
  EXPECT_NEAR(s.x.v[0], 0.5 + a * h, 1e-9);
  EXPECT_NEAR(s.x.v[2], 0.0, 1e-9);
}

// At rest, with all contacts sticking, both laws give the same forces.
TEST(SolveContact, LawsAgreeWithoutSliding) {
  scenes::DomeShape shape;
  shape.rings = 8;
  shape.blocks_per_ring = 12;
  const ContactProblem problem = scenes::dome(shape, 1.0, {10.0, 1e-8, 1e-8});
  const Solved associated = solve(problem, kAssociated), coulomb = solve(problem, kCoulomb);
  EXPECT_EQ(coulomb.summary.ending, SolveEnding::converged) << coulomb.summary.message;
  EXPECT_LE((associated.x.gamma - coulomb.x.gamma).norm(), 1e-8 * coulomb.x.gamma.norm());
}

TEST(SolveContact, CompliantDomeUnderCoulombsLaw) {
  scenes::DomeShape shape;
  shape.rings = 8;
  shape.blocks_per_ring = 12;
  for (const double mu : {0.2, 0.4, 1.0}) {
    const Solved s = solve(scenes::dome(shape, 1.0, {mu, 1e-8, 1e-8}), kCoulomb);
    EXPECT_EQ(s.summary.ending, SolveEnding::converged) << mu << " " << s.summary.message;
    EXPECT_LE(s.residuals.contact_law, 1e-10);
    EXPECT_LE(s.residuals.momentum, 1e-10);
  }
}

// Above mu = 1 a step under Coulomb's law may have no solution. The ending must agree with the residuals.
TEST(SolveContact, CoulombAboveOneReportsItsEnding) {
  scenes::DomeShape shape;
  shape.rings = 8;
  shape.blocks_per_ring = 12;
  for (const double mu : {1.5, 3.0, 10.0}) {
    for (const double c : {1e-8, 0.0}) {
      const Solved s = solve(scenes::dome(shape, 0.01, {mu, c, c}), kCoulomb, 1e-8);
      EXPECT_TRUE(s.summary.usable()) << mu << " " << s.summary.message;
      EXPECT_TRUE(s.x.v.allFinite() && s.x.gamma.allFinite());
      const bool met = s.residuals.momentum <= 1e-8 && s.residuals.contact_law <= 1e-8;
      EXPECT_EQ(s.summary.ending == SolveEnding::converged, met)
          << mu << " " << c << " " << s.summary.message;
    }
  }
}

// With random gaps many contacts open and close: the interior point method takes over from Newton.
TEST(SolveContact, FallbackSolvesProblemsWithGaps) {
  scenes::DomeShape shape;
  shape.rings = 12;
  shape.blocks_per_ring = 16;
  shape.gap = 1e-2;
  for (const double c : {1e-8, 1e-10, 1e-12}) {
    const Solved s = solve(scenes::dome(shape, 1.0, {0.4, c, c}), kAssociated, 1e-8);
    EXPECT_EQ(s.summary.ending, SolveEnding::converged) << c << " " << s.summary.message;
    EXPECT_LE(s.residuals.momentum, 1.1e-8);
    EXPECT_LE(s.residuals.contact_law, 1e-8);
  }
}

TEST(SolveContact, InteriorPointAndNewtonAgree) {
  scenes::DomeShape shape;
  shape.rings = 8;
  shape.blocks_per_ring = 12;
  for (const double mu : {0.0, 0.1, 0.4, 10.0}) {
    const ContactProblem problem = scenes::dome(shape, 1.0, {mu, 1e-8, 1e-8});
    const Solved newton = solve(problem, kAssociated),
                 interior = solve(problem, kAssociated, 1e-10, ContactMethod::interior_point);
    EXPECT_EQ(interior.summary.ending, SolveEnding::converged) << mu << " " << interior.summary.message;
    EXPECT_LE((newton.x.gamma - interior.x.gamma).norm(), 1e-8 * newton.x.gamma.norm()) << mu;
  }
}

TEST(SolveContact, RigidDomeStandsAndFalls) {
  scenes::DomeShape shape;
  shape.rings = 8;
  shape.blocks_per_ring = 12;
  const double h = 0.01;
  const Solved stands = solve(scenes::dome(shape, h, {0.6, 0, 0}), kAssociated);
  EXPECT_EQ(stands.summary.ending, SolveEnding::converged) << stands.summary.message;
  EXPECT_LT(stands.x.v.norm(), 1e-5 * kGravity * h);
  const Solved falls = solve(scenes::dome(shape, h, {0.01, 0, 0}), kAssociated);
  EXPECT_EQ(falls.summary.ending, SolveEnding::converged) << falls.summary.message;
  EXPECT_GT(falls.x.v.norm(), 2e-3 * kGravity * h);
}

}  // namespace
}  // namespace cupola::solve_test
