#include <gtest/gtest.h>

#include "solver/contact/methods/local_contact.hpp"
#include "solver/contact/methods/solve_contact.hpp"
#include "solver/contact/problem/duality_gap.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/runtime/iteration_log.hpp"
#include "tests/solver/contact/contact_scenes.hpp"

namespace cupola::methods_test {
namespace {

using scenes::kGravity;

constexpr std::array kMethods{ContactMethod::newton, ContactMethod::interior_point, ContactMethod::spg,
                              ContactMethod::apgd,   ContactMethod::nsgs,           ContactMethod::admm};

struct Solved {
  ContactSolution x;
  SolveSummary summary;
  Residuals residuals;
};

Solved solve(const ContactProblem& problem, ContactMethod method, double tolerance,
             FrictionLaw law = FrictionLaw::associated) {
  Solved result;
  ContactSolverOptions options;
  options.tolerance = tolerance;
  options.reference_speed = kGravity * problem.h;
  options.method = method;
  options.law = law;
  result.summary = solve_contact(problem, options, &result.x);
  if (result.summary.usable())
    result.residuals = compute_residuals(problem, result.x, options.reference_speed, law);
  return result;
}

scenes::DomeShape small_dome() {
  scenes::DomeShape shape;
  shape.rings = 8;
  shape.blocks_per_ring = 12;
  return shape;
}

// A line in every iteration with an interval of 0 s, and none with an hour.
TEST(ContactMethods, FirstOrderMethodsSayWhereTheyAre) {
  const ContactProblem problem = scenes::dome(small_dome(), 0.01, {0.4, 1e-8, 3e-9});
  for (const ContactMethod method :
       {ContactMethod::spg, ContactMethod::apgd, ContactMethod::nsgs, ContactMethod::admm})
    for (const double interval : {0.0, 3600.0}) {
      std::vector<std::string> lines;
      const IterationLog log([&lines](const std::string& line) { lines.push_back(line); }, interval);
      solve(problem, method, 1e-6);
      EXPECT_EQ(lines.empty(), interval > 0.0) << to_string(method);
      if (lines.empty()) continue;
      EXPECT_TRUE(lines.back().starts_with(to_string(method))) << lines.back();
      EXPECT_NE(lines.back().find("tolerance 1e-06"), std::string::npos) << lines.back();
    }
}

TEST(ContactMethods, AgreeOnTheForcesOfAStep) {
  for (const double mu : {0.0, 0.4, 2.0}) {
    const ContactProblem problem = scenes::dome(small_dome(), 0.01, {mu, 1e-8, 3e-9});
    const Solved reference = solve(problem, ContactMethod::newton, 1e-13);
    for (const ContactMethod method : kMethods) {
      const Solved s = solve(problem, method, 1e-9);
      EXPECT_EQ(s.summary.ending, SolveEnding::converged) << to_string(method) << ": " << s.summary.message;
      EXPECT_LE((s.x.gamma - reference.x.gamma).norm(), 1e-8 * reference.x.gamma.norm())
          << to_string(method) << " mu " << mu;
      EXPECT_LE(s.residuals.cone_violation, 1e-14) << to_string(method);
      // The certificate bounds the true error in the norm of the compliance, up to the error of the
      // reference.
      const double norm = compliance_norm(problem, reference.x.gamma);
      EXPECT_GE(s.residuals.certificate.value.value() * norm + 1e-11 * norm,
                compliance_norm(problem, s.x.gamma - reference.x.gamma))
          << to_string(method);
    }
  }
}

TEST(ContactMethods, AgreeUnderCoulombsLaw) {
  const ContactProblem problem = scenes::dome(small_dome(), 0.01, {0.2, 1e-8, 1e-8});
  const Solved reference = solve(problem, ContactMethod::newton, 1e-12, FrictionLaw::coulomb);
  ASSERT_EQ(reference.summary.ending, SolveEnding::converged) << reference.summary.message;
  for (const ContactMethod method : kMethods) {
    const Solved s = solve(problem, method, 1e-8, FrictionLaw::coulomb);
    EXPECT_EQ(s.summary.ending, SolveEnding::converged) << to_string(method) << ": " << s.summary.message;
    EXPECT_LE((s.x.gamma - reference.x.gamma).norm(), 1e-6 * reference.x.gamma.norm()) << to_string(method);
    EXPECT_FALSE(s.residuals.certificate.value.has_value());
  }
}

TEST(ContactMethods, RigidJointsCarryTheWeightAbove) {
  const std::vector<double> densities{2000, 1000, 3000};
  const ContactProblem problem = scenes::stack(densities, 0.01, {0.4, 0.0, 0.0});
  for (const ContactMethod method : kMethods) {
    const Solved s = solve(problem, method, 1e-9);
    EXPECT_EQ(s.summary.ending, SolveEnding::converged) << to_string(method) << ": " << s.summary.message;
    double above = 6000.0 * kGravity;
    for (int k = 0; k < 3; ++k) {
      double joint = 0.0;
      for (int i = 4 * k; i < 4 * k + 4; ++i) joint += s.x.gamma[3 * i] / problem.h;
      EXPECT_NEAR(joint, above, 1e-6 * above) << to_string(method);
      above -= densities[k] * kGravity;
    }
  }
}

// The ending says that the limit was reached, and the residuals agree.
TEST(ContactMethods, ReportThatTheIterationLimitWasReached) {
  const ContactProblem problem = scenes::dome(small_dome(), 1e3, {0.4, 1e-8, 1e-8});
  for (const ContactMethod method :
       {ContactMethod::spg, ContactMethod::apgd, ContactMethod::nsgs, ContactMethod::admm}) {
    ContactSolverOptions options;
    options.tolerance = 1e-8;
    options.reference_speed = kGravity * problem.h;
    options.method = method;
    options.max_iterations = 10;
    ContactSolution x;
    const SolveSummary summary = solve_contact(problem, options, &x);
    EXPECT_EQ(summary.ending, SolveEnding::max_iterations) << to_string(method);
    const Residuals r = compute_residuals(problem, x, options.reference_speed);
    EXPECT_GT(r.certificate.value.value_or(1.0), 1e-8) << to_string(method);
  }
}

TEST(ContactMethods, WarmStartFromTheSolutionNeedsNoIteration) {
  const ContactProblem problem = scenes::dome(small_dome(), 0.01, {0.4, 1e-8, 1e-8});
  const Solved reference = solve(problem, ContactMethod::newton, 1e-12);
  for (const ContactMethod method : {ContactMethod::spg, ContactMethod::apgd, ContactMethod::nsgs}) {
    ContactSolverOptions options;
    options.tolerance = 1e-9;
    options.reference_speed = kGravity * problem.h;
    options.method = method;
    ContactSolution x = reference.x;
    EXPECT_EQ(solve_contact(problem, options, &x).iterations, 0) << to_string(method);
  }
}

// Slow, independent reference: projected gradient with small steps.
Vec3 slow_local(const Mat3& A, const Vec3& r, double mu) {
  const double L = A.trace();
  Vec3 gamma = Vec3::Zero();
  for (int k = 0; k < 200000; ++k) {
    Vec3 x = gamma - (A * gamma + r) / L;
    const double t = x.tail<2>().norm();
    if (t <= mu * x[0]) {
      gamma = x;
    } else if (mu * t <= -x[0]) {
      gamma.setZero();
    } else {
      const double n = (x[0] + mu * t) / (1 + mu * mu);
      gamma << n, mu * n / t * x[1], mu * n / t * x[2];
    }
  }
  return gamma;
}

TEST(LocalContact, SolvesStickSlipAndSeparation) {
  Mat3 A;
  A << 3.0, 0.9, -0.4, 0.9, 2.0, 0.3, -0.4, 0.3, 1.5;
  for (const double mu : {0.1, 0.4, 3.0}) {
    for (const Vec3& r : {Vec3(-1, 0, 0), Vec3(-1, 0.1, 0.05), Vec3(-1, 2, -1), Vec3(0.1, 2, -1),
                          Vec3(1, 0.1, 0.1), Vec3(0, 0, 0), Vec3(5, -1, 2), Vec3(-1e-9, 1, 1)}) {
      const Vec3 gamma = solve_local_contact(A, r, {.mu = mu}, Vec3::Zero()), slow = slow_local(A, r, mu);
      EXPECT_LE((gamma - slow).norm(), 1e-12 * r.norm())
          << r.transpose() << " mu " << mu << ": " << gamma.transpose() << " | " << slow.transpose();
    }
  }
}

TEST(LocalContact, FrictionlessContactUsesTheNormalRowOnly) {
  Mat3 A = Mat3::Constant(std::nan(""));
  A(0, 0) = 2.0;
  EXPECT_EQ(solve_local_contact(A, {-3.0, std::nan(""), 1.0}, {.mu = 0.0}, Vec3::Zero()), Vec3(1.5, 0, 0));
  EXPECT_EQ(solve_local_contact(A, {3.0, std::nan(""), 1.0}, {.mu = 0.0}, Vec3::Zero()), Vec3::Zero().eval());
}

}  // namespace
}  // namespace cupola::methods_test
