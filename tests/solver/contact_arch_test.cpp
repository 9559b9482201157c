// Published and derived limits of arches (VERIFICATION 0, 2) on one step of exact rigidity, and scenes at the
// extremes.

#include <gtest/gtest.h>

#include "solver/contact/residuals.hpp"
#include "solver/contact/solve_contact.hpp"
#include "tests/solver/contact_scenes.hpp"

namespace cupola {
namespace {

using scenes::kGravity;
using std::numbers::pi;

Residuals solve(const ContactProblem& problem, double tolerance, ContactSolution* x) {
  ContactSolverOptions options;
  options.tolerance = tolerance;
  options.reference_speed = kGravity * problem.h;
  const SolveSummary summary = solve_contact(problem, options, x);
  EXPECT_EQ(summary.ending, SolveEnding::converged) << summary.message;
  return compute_residuals(problem, *x, options.reference_speed);
}

/// Largest component of a centroid's velocity over g h after one step of a rigid semicircular arch.
double speed_ratio(int n, double thickness, double mu, double tilt_deg = 0.0, double beta_deg = 90.0) {
  const double h = 0.01;
  const ContactProblem problem =
      scenes::arch(n, thickness, beta_deg * pi / 180, tilt_deg * pi / 180, h, {mu, 0.0, 0.0});
  ContactSolution x;
  solve(problem, 1e-9, &x);
  double fastest = 0.0;
  for (int k = 0; k < problem.num_blocks(); ++k)
    fastest = std::max(fastest, x.v.segment<3>(6 * k).lpNorm<Eigen::Infinity>());
  return fastest / (kGravity * h);
}

// VERIFICATION 0: exact one-step speeds by an independent QP, to 1e-3.
TEST(Arch, OneStepSpeedsOfMechanisms) {
  for (const auto& [below, expected] :
       {std::pair{0.99, .006331}, {0.98, .01264}, {0.95, .03142}, {0.90, .06221}, {.08 / .10672, .1587}}) {
    EXPECT_NEAR(speed_ratio(27, below * .10672, 0.8), expected, 1e-3 * expected) << below << " of the limit";
  }
  for (const auto& [mu, expected] : {std::pair{.30, .01635}, {.28, .05213}, {.20, .2091}}) {
    EXPECT_NEAR(speed_ratio(27, 0.25, mu), expected, 1e-3 * expected) << "mu " << mu;
  }
  for (const auto& [tilt, expected] : {std::pair{8.4, .002830}, {8.7, .009331}, {9.5, .02664}}) {
    EXPECT_NEAR(speed_ratio(27, 0.15, 0.8, tilt), expected, 1e-3 * expected) << "tilt " << tilt;
  }
}

TEST(Arch, StandsAtTheLimitsOfTheTables) {
  EXPECT_LT(speed_ratio(27, 0.1068, 0.8), 1e-5);
  EXPECT_LT(speed_ratio(27, 0.25, 0.31), 1e-5);
  EXPECT_LT(speed_ratio(27, 0.15, 0.8, 8.2), 1e-5);
}

// VERIFICATION 2.1: minimum t/R of n polygonal voussoirs, rotation mode: 1 % on either side.
TEST(Arch, MinimumThickness) {
  for (const auto& [n, limit] :
       {std::pair{7, .09570}, {8, .09997}, {11, .10459}, {16, .10708}, {21, .10670}, {50, .10744}}) {
    EXPECT_LT(speed_ratio(n, 1.01 * limit, 0.8), 1e-5) << n << " voussoirs";
    EXPECT_GT(speed_ratio(n, 0.99 * limit, 0.8), 2e-3) << n << " voussoirs";
  }
}

// VERIFICATION 2.2: minimum friction, n = 27, to +-0.003.
TEST(Arch, MinimumFriction) {
  for (const auto& [thickness, limit] : {std::pair{.12, .38118}, {.15, .35114}, {.2, .30899}}) {
    EXPECT_LT(speed_ratio(27, thickness, limit + 0.003), 1e-5) << "t/R " << thickness;
    EXPECT_GT(speed_ratio(27, thickness, limit - 0.003), 1e-4) << "t/R " << thickness;
  }
}

// VERIFICATION 2.4: collapse tilt.
TEST(Arch, CollapseTilt) {
  for (const auto& [thickness, mu, limit] :
       {std::tuple{.15, .4, 2.997}, {.15, .8, 8.269}, {.20, .4, 5.659}, {.20, .8, 15.872}}) {
    EXPECT_LT(speed_ratio(27, thickness, mu, 0.97 * limit), 1e-5) << thickness << " " << mu;
    EXPECT_GT(speed_ratio(27, thickness, mu, 1.03 * limit), 1e-4) << thickness << " " << mu;
  }
}

// VERIFICATION 2.3: half embrace below and above 90 deg.
TEST(Arch, MinimumThicknessByEmbrace) {
  for (const auto& [beta, limit] : {std::pair{45.0, .007438}, {70.0, .041073}, {110.0, .23118}}) {
    EXPECT_LT(speed_ratio(27, 1.01 * limit, 0.8, 0.0, beta), 1e-5) << "beta " << beta;
    EXPECT_GT(speed_ratio(27, 0.99 * limit, 0.8, 0.0, beta), 1e-6) << "beta " << beta;
  }
}

}  // namespace
}  // namespace cupola
