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
#include "tests/verification/references.hpp"

namespace cupola::arch_test {
namespace {

using scenes::kGravity;
using std::numbers::pi;
using verification::reference;
using verification::ReferenceRow;

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

// Limits and speeds are those of tests/verification/references.yaml, which names their sources.
TEST(Arch, OneStepSpeedsOfMechanisms) {
  for (const ReferenceRow& row : reference("one_step_arch").rows)
    EXPECT_NEAR(speed_ratio(27, row.number("thickness_over_least") * .10672, row.number("mu"),
                            row.number("tilt_deg")),
                row.expected(), 1e-3 * row.expected())
        << row.name();
}

TEST(Arch, StandsJustAboveTheLimits) {
  EXPECT_LT(speed_ratio(27, 0.1068, 0.8), 1e-5);
  EXPECT_LT(speed_ratio(27, 0.25, 0.31), 1e-5);
  EXPECT_LT(speed_ratio(27, 0.15, 0.8, 8.2), 1e-5);
}

// Minimum t/R of a semicircle of n polygonal voussoirs at mu = 0.8, which fails by rotation. 1 % on either
// side.
TEST(Arch, MinimumThickness) {
  for (const ReferenceRow& row : reference("arch_thickness").rows) {
    EXPECT_LT(speed_ratio(row.integer("voussoirs"), 1.01 * row.expected(), 0.8), 1e-5) << row.name();
    EXPECT_GT(speed_ratio(row.integer("voussoirs"), 0.99 * row.expected(), 0.8), 2e-3) << row.name();
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
  for (const ReferenceRow& row : reference("arch_thickness_by_friction").rows) {
    EXPECT_LT(speed_ratio(27, 1.005 * row.expected(), row.number("mu")), 1e-5) << row.name();
    EXPECT_GT(speed_ratio(27, 0.995 * row.expected(), row.number("mu")), 1e-4) << row.name();
  }
  for (const double thickness : {0.2, 0.5, 0.9})
    EXPECT_GT(speed_ratio(27, thickness, 0.305), 1e-4) << thickness;
}

// Minimum friction by number of voussoirs and t/R, to +-0.003.
TEST(Arch, MinimumFriction) {
  for (const ReferenceRow& row : reference("arch_friction").rows) {
    const int n = row.integer("voussoirs");
    EXPECT_LT(speed_ratio(n, row.number("t_R"), row.expected() + 0.003), 1e-5) << row.name();
    EXPECT_GT(speed_ratio(n, row.number("t_R"), row.expected() - 0.003), 1e-4) << row.name();
  }
}

// Minimum t/R of 27 polygonal voussoirs by half embrace in degrees, to 1 %.
TEST(Arch, MinimumThicknessByEmbrace) {
  for (const ReferenceRow& row : reference("arch_thickness_by_embrace").rows) {
    const double beta = row.number("beta_deg");
    EXPECT_LT(speed_ratio(27, 1.01 * row.expected(), 0.8, 0.0, beta), 1e-5) << row.name();
    EXPECT_GT(speed_ratio(27, 0.99 * row.expected(), 0.8, 0.0, beta), 2e-5) << row.name();
  }
}

// Collapse tilt of gravity in degrees, to 3 %: arctan of the horizontal load factor (problems of Oppenheim
// 1992 and Clemente 1998).
TEST(Arch, CollapseTilt) {
  for (const ReferenceRow& row : reference("arch_acceleration").rows) {
    const int n = row.integer("voussoirs");
    const double limit = std::atan(row.expected()) * 180 / pi, beta = row.number("beta_deg");
    EXPECT_LT(speed_ratio(n, row.number("t_R"), row.number("mu"), 0.97 * limit, beta), 1e-5) << row.name();
    EXPECT_GT(speed_ratio(n, row.number("t_R"), row.number("mu"), 1.03 * limit, beta), 1e-4) << row.name();
  }
}

}  // namespace
}  // namespace cupola::arch_test
