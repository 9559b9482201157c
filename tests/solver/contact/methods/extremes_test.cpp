// Contact problems with extreme mass ratios, time steps, friction, compliance, heights and sizes.

#include <gtest/gtest.h>

#include "solver/contact/methods/solve_contact.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "tests/solver/contact/contact_scenes.hpp"

namespace cupola::extremes_test {
namespace {

using scenes::kGravity;

Residuals solve(const ContactProblem& problem, double tolerance, ContactSolution* x) {
  ContactSolverOptions options;
  options.tolerance = tolerance;
  options.reference_speed = kGravity * problem.h;
  const SolveSummary summary = solve_contact(problem, options, x);
  EXPECT_EQ(summary.ending, SolveEnding::converged) << summary.message;
  return compute_residuals(problem, *x, options.reference_speed);
}

TEST(Extremes, MassRatios) {
  for (const double ratio : {1e2, 1e4, 1e6}) {
    const ContactProblem problem = scenes::stack({1.0, ratio, 1.0, ratio}, 1e3, {0.4, 1e-10, 1e-10});
    ContactSolution x;
    const Residuals r = solve(problem, 1e-10, &x);
    EXPECT_LE(r.contact_law, 1e-10);
    double joint = 0.0;
    for (int i = 0; i < 4; ++i) joint += x.gamma[3 * i] / problem.h;
    EXPECT_NEAR(joint, (2 + 2 * ratio) * kGravity, 1e-6 * ratio * kGravity);  // 1e-7: share of inertia
  }
}

// Steps of 1e-5 to 10 s, friction 0 to 10, compliance 1e-14 to 1e-4 m/N. Where blocks slide on contacts of
// tiny compliance, contact_law_rounding limits the accuracy of the contact law.
TEST(Extremes, TimeStepsAndFriction) {
  scenes::DomeShape shape;
  shape.rings = 6;
  shape.blocks_per_ring = 8;
  for (const double h : {1e-5, 0.1, 10.0}) {
    for (const double mu : {0.0, 1e-3, 0.4, 10.0}) {
      for (const double c : {1e-14, 1e-9, 1e-4}) {
        const ContactProblem problem = scenes::dome(shape, h, {mu, c, c});
        ContactSolverOptions options;
        options.tolerance = 1e-9;
        options.reference_speed = kGravity * h;
        ContactSolution x;
        const SolveSummary summary = solve_contact(problem, options, &x);
        const Residuals r = compute_residuals(problem, x, options.reference_speed);
        EXPECT_LE(r.momentum, 1e-9) << h << " " << mu << " " << c << ": " << summary.message;
        EXPECT_EQ(summary.ending, SolveEnding::converged)
            << h << " " << mu << " " << c << ": " << summary.message;
        EXPECT_LE(r.contact_law, std::max(1e-9, 16 * r.contact_law_rounding)) << h << " " << mu << " " << c;
      }
    }
  }
}

TEST(Extremes, HundredBlockStack) {
  for (const double c : {0.0, 1e-12, 1e-6}) {
    const double h = c == 0.0 ? 0.01 : 1e3;
    const ContactProblem problem = scenes::stack(std::vector<double>(100, 2000.0), h, {0.4, c, c});
    ContactSolution x;
    solve(problem, 1e-10, &x);
    double joint = 0.0;
    for (int i = 0; i < 4; ++i) joint += x.gamma[3 * i] / problem.h;
    // Share of inertia, 100 m v / h: the displacement of the top is c W n / 8, divided by h^2 g.
    EXPECT_NEAR(joint / (100 * 2000.0 * kGravity), 1.0, 1e-8 + c * 100 * 2000.0 * 100 / (h * h));
  }
}

TEST(Extremes, SizesFromMillimetresToKilometres) {
  for (const double size : {1e-3, 1.0, 1e3}) {
    scenes::DomeShape shape;
    shape.rings = 8;
    shape.blocks_per_ring = 12;
    shape.radius *= size;
    shape.thickness *= size;
    const double c = 1e-8 / (size * size);  // the same displacement over size as at size 1
    const ContactProblem problem = scenes::dome(shape, 1e2 * std::sqrt(size), {0.4, c, c});
    ContactSolution x;
    solve(problem, 1e-10, &x);
    EXPECT_GT(x.gamma.norm(), 0.0);
  }
}

}  // namespace
}  // namespace cupola::extremes_test
