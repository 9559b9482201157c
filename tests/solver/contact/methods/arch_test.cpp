// Limits of arches with rigid contacts, in one step from rest.
//
// For rigid contacts without gaps, one step from rest under the associated law gives zero velocity if and
// only if contact forces inside the friction cones can balance the loads (strong duality). The limits below
// are thresholds of that linear program, which independent scripts solved with HiGHS; they are exact for
// voussoirs of the stated shape. Continuum limits for comparison: t/R = 0.1075 for the semicircle
// (Milankovitch, radial joints; Makris and Alexakis), 0.107426 (Cocchetti and Rizzi 2020, Frattura ed
// Integrita Strutturale 51, table 3).

#include <gtest/gtest.h>

#include "solver/contact/methods/solve_contact.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "tests/solver/contact/contact_scenes.hpp"

namespace cupola::arch_test {
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
double speed_ratio(int n, double thickness, double mu, double tilt_deg = 0.0, double beta_deg = 90.0,
                   int facets = 1) {
  const double h = 0.01;
  const ContactProblem problem =
      scenes::arch(n, thickness, beta_deg * pi / 180, tilt_deg * pi / 180, h, {mu, 0.0, 0.0}, facets);
  ContactSolution x;
  solve(problem, 1e-9, &x);
  double fastest = 0.0;
  for (int k = 0; k < problem.num_blocks(); ++k)
    fastest = std::max(fastest, x.v.segment<3>(6 * k).lpNorm<Eigen::Infinity>());
  return fastest / (kGravity * h);
}

// Exact speeds after one step from an independent quadratic program (2D, NNLS), to 1e-3.
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

TEST(Arch, StandsJustAboveTheLimits) {
  EXPECT_LT(speed_ratio(27, 0.1068, 0.8), 1e-5);
  EXPECT_LT(speed_ratio(27, 0.25, 0.31), 1e-5);
  EXPECT_LT(speed_ratio(27, 0.15, 0.8, 8.2), 1e-5);
}

// Minimum t/R of a semicircle of n polygonal voussoirs at mu = 0.8, which fails by rotation. 1 % on either
// side.
TEST(Arch, MinimumThickness) {
  for (const auto& [n, limit] : {std::pair{7, .09570},
                                 {8, .09997},
                                 {9, .10153},
                                 {11, .10459},
                                 {13, .10253},
                                 {15, .10607},
                                 {16, .10708},
                                 {20, .10735},
                                 {21, .10670},
                                 {27, .10672},
                                 {30, .10741},
                                 {50, .10744},
                                 {51, .10736},
                                 {100, .10746}}) {
    EXPECT_LT(speed_ratio(n, 1.01 * limit, 0.8), 1e-5) << n << " voussoirs";
    EXPECT_GT(speed_ratio(n, 0.99 * limit, 0.8), 2e-3) << n << " voussoirs";
  }
}

// Voussoirs that are sectors of a ring have more mass outside than polygonal ones; their limits are up to 0.9
// % higher. 32 facets per voussoir leave a thousandth of that difference; the last digit of the limits is
// 0.05 %.
constexpr int kSectorFacets = 32;
constexpr double kSectorTolerance = 2e-3;

// Sectors of a ring: 0.2 % on either side, which distinguishes them from polygonal voussoirs up to n = 16.
TEST(Arch, MinimumThicknessOfExactSectors) {
  for (const auto& [n, limit] : {std::pair{7, .09624},
                                 {8, .10086},
                                 {9, .10213},
                                 {11, .10491},
                                 {13, .10284},
                                 {15, .10627},
                                 {16, .10724},
                                 {20, .10746},
                                 {21, .10679},
                                 {27, .10678},
                                 {30, .10746},
                                 {50, .10746},
                                 {51, .10737},
                                 {100, .10746}}) {
    const auto speed = [&, n = n, limit = limit](double factor) {
      return speed_ratio(n, factor * limit, 0.8, 0.0, 90.0, kSectorFacets);
    };
    EXPECT_LT(speed(1.0 + kSectorTolerance), 1e-5) << n << " voussoirs";
    EXPECT_GT(speed(1.0 - kSectorTolerance), 5e-4) << n << " voussoirs";
  }
}

// 100 sectors of a ring, by half embrace in degrees: 0.3 % on either side.
TEST(Arch, MinimumThicknessByEmbraceOfExactSectors) {
  for (const auto& [beta, limit] : {std::pair{45.0, .007496},
                                    {60.0, .022849},
                                    {75.0, .053675},
                                    {90.0, .10746},
                                    {100.0, .16072},
                                    {120.0, .35183}}) {
    const auto speed = [&, beta = beta, limit = limit](double factor) {
      return speed_ratio(100, factor * limit, 0.8, 0.0, beta, 4);
    };
    EXPECT_LT(speed(1.003), 1e-5) << "beta " << beta;
    EXPECT_GT(speed(0.997), 5e-6) << "beta " << beta;
  }
}

// Minimum t/R of 27 voussoirs by friction, to 0.5 %; at mu <= 0.305 no thickness stands. The modes are those
// of Gilbert, Casapulla and Ahmed (2006): rotation above mu of about 0.395, mixed between 0.31 and 0.395.
TEST(Arch, MinimumThicknessByFriction) {
  for (const auto& [mu, limit] : {std::pair{.39, .11163},
                                  {.38, .12112},
                                  {.37, .13087},
                                  {.36, .14089},
                                  {.35, .15118},
                                  {.34, .16177},
                                  {.33, .17265},
                                  {.32, .18384},
                                  {.31, .19600}}) {
    EXPECT_LT(speed_ratio(27, 1.005 * limit, mu), 1e-5) << "mu " << mu;
    EXPECT_GT(speed_ratio(27, 0.995 * limit, mu), 1e-4) << "mu " << mu;
  }
  for (const double thickness : {0.2, 0.5, 0.9})
    EXPECT_GT(speed_ratio(27, thickness, 0.305), 1e-4) << thickness;
}

// Minimum friction by number of voussoirs and t/R, to +-0.003.
TEST(Arch, MinimumFriction) {
  for (const auto& [n, thickness, limit] : {std::tuple{27, .12, .38118},
                                            {27, .15, .35114},
                                            {27, .2, .30899},
                                            {27, .3, .30899},
                                            {10, .12, .38566},
                                            {10, .15, .35433},
                                            {10, .2, .30778},
                                            {10, .25, .30300},
                                            {20, .12, .38245},
                                            {20, .15, .35127},
                                            {20, .2, .30888},
                                            {100, .12, .38170},
                                            {100, .15, .35179},
                                            {100, .2, .30922}}) {
    EXPECT_LT(speed_ratio(n, thickness, limit + 0.003), 1e-5) << n << " voussoirs, t/R " << thickness;
    EXPECT_GT(speed_ratio(n, thickness, limit - 0.003), 1e-4) << n << " voussoirs, t/R " << thickness;
  }
}

// Minimum t/R of 27 polygonal voussoirs by half embrace in degrees, to 1 %.
TEST(Arch, MinimumThicknessByEmbrace) {
  for (const auto& [beta, limit] : {std::pair{30.0, .001520},
                                    {40.0, .004703},
                                    {45.0, .007438},
                                    {50.0, .011177},
                                    {60.0, .022646},
                                    {70.0, .041073},
                                    {75.0, .053491},
                                    {80.0, .068390},
                                    {85.0, .086040},
                                    {90.0, .10672},
                                    {100.0, .15928},
                                    {110.0, .23118},
                                    {120.0, .34885}}) {
    EXPECT_LT(speed_ratio(27, 1.01 * limit, 0.8, 0.0, beta), 1e-5) << "beta " << beta;
    EXPECT_GT(speed_ratio(27, 0.99 * limit, 0.8, 0.0, beta), 2e-5) << "beta " << beta;
  }
}

// Collapse tilt of gravity in degrees, to 3 %: arctan of the horizontal load factor (problems of Oppenheim
// 1992 and Clemente 1998).
TEST(Arch, CollapseTilt) {
  for (const auto& [n, beta, thickness, mu, limit] : {std::tuple{27, 90.0, .15, .4, 2.997},
                                                      {27, 90.0, .15, .8, 8.269},
                                                      {20, 90.0, .15, .4, 3.003},
                                                      {20, 90.0, .15, .8, 8.494},
                                                      {27, 90.0, .20, .4, 5.659},
                                                      {27, 90.0, .20, .8, 15.872},
                                                      {15, 60.0, .10, .4, 30.282},
                                                      {15, 60.0, .10, .8, 30.282},
                                                      {15, 60.0, .15, .4, 35.345},
                                                      {15, 60.0, .15, .8, 42.645}}) {
    EXPECT_LT(speed_ratio(n, thickness, mu, 0.97 * limit, beta), 1e-5) << n << " " << thickness << " " << mu;
    EXPECT_GT(speed_ratio(n, thickness, mu, 1.03 * limit, beta), 1e-4) << n << " " << thickness << " " << mu;
  }
}

}  // namespace
}  // namespace cupola::arch_test
