// Each residual of residuals.hpp against its definition, with slow routines that share no code with it.

#include "solver/contact/problem/residuals.hpp"

#include <limits>
#include <random>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "solver/contact/methods/solve_contact.hpp"
#include "solver/contact/problem/duality_gap.hpp"
#include "tests/solver/contact/contact_scenes.hpp"
#include "tests/solver/contact/slow_contact.hpp"

namespace cupola::residuals_test {
namespace {

using scenes::kGravity;

constexpr double kStep = 0.01;  // s
constexpr double kReference = kGravity * kStep;

/// A block of 2 kg with one contact to the ground at its centroid, frame along the axes: u = v.
ContactProblem one_contact(double mu, double e_n, double e_t) {
  ContactProblem p;
  p.M.push_back(2.0 * Mat6::Identity());
  p.v_star = VecX::Zero(6);
  p.block_a = {ContactProblem::kFixed};
  p.block_b = {0};
  p.D_a.emplace_back();
  p.D_b = {{Mat3::Identity(), Vec3::Zero()}};
  p.b = VecX::Zero(3);
  p.E = Vec3(e_n, e_t, e_t);
  p.mu = VecX::Constant(1, mu);
  p.h = kStep;
  return p;
}

/// |gamma - P(gamma - rho (y + s n))| / max(|gamma|, |P|) by definition. P is in the norm of E; where E is
/// zero, P is Euclidean and rho = 1 / trace N = 2 kg / 3.
double slow_contact_law(const ContactProblem& p, const Vec3& v, const Vec3& gamma, FrictionLaw kind) {
  const Vec3 E = p.E.head<3>();
  Vec3 y = v + E.cwiseProduct(gamma);
  if (kind == FrictionLaw::coulomb) y[0] += p.mu[0] * y.tail<2>().norm();
  const bool rigid = E[0] == 0.0;
  const double trace = 1.5;
  const Vec3 metric = rigid ? Vec3::Constant(trace) : E;
  const Vec3 x = gamma - y.cwiseQuotient(metric);
  const Vec3 projected = scenes::slow_impulse({metric[0], metric[1], p.mu[0]}, -metric.cwiseProduct(x));
  return (gamma - projected).norm() / std::max(gamma.norm(), projected.norm());
}

struct Pair {
  const char* region;
  Vec3 v, gamma;
};

// e_n = 2, e_t = 0.5, mu = 0.4. The law holds where the impulse is -E^-1 v, or on the surface of the cone in
// slip.
const std::vector<Pair> kPairs{
    {"stick, correct", {-2.0, 0.1, 0.0}, {1.0, -0.2, 0.0}},
    {"stick, wrong", {-2.0, 0.1, 0.0}, {1.1, -0.1, 0.05}},
    {"slip", {-1.0, 3.0, 4.0}, {0.7, -0.1, -0.2}},
    {"slip, on the cone", {-1.0, 3.0, 4.0}, {1.0, -0.24, -0.32}},
    {"separation, correct", {3.0, 1.0, 1.0}, {0.0, 0.0, 0.0}},
    {"separation, wrong", {3.0, 1.0, 1.0}, {0.1, 0.0, 0.01}},
    {"apex", {1.0, 1.5, -2.0}, {0.01, 0.0, 0.0}},
    {"apex, just inside", {1.0 - 1e-9, 1.5, -2.0}, {0.01, 0.0, 0.0}},
    {"outside the cone", {-1.0, 0.2, 0.0}, {0.2, 0.5, 0.1}},
};

TEST(ResidualsOfAPair, ContactLawIsTheNaturalMap) {
  for (const Pair& pair : kPairs) {
    for (const auto& [e_n, e_t] : {std::pair{2.0, 0.5}, {0.5, 2.0}, {1.0, 1.0}, {0.0, 0.0}}) {
      const ContactProblem p = one_contact(0.4, e_n, e_t);
      ContactSolution x{VecX::Zero(6), pair.gamma};
      x.v.head<3>() = pair.v;
      for (const FrictionLaw kind : {FrictionLaw::associated, FrictionLaw::coulomb}) {
        const Residuals r = compute_residuals(p, x, kReference, kind);
        const double expected =
            pair.gamma.isZero() && pair.v[0] > 2.0 ? 0.0 : slow_contact_law(p, pair.v, pair.gamma, kind);
        // Bisection ends within a few roundings of the largest term, |y| / E <= 10.
        EXPECT_NEAR(r.contact_law, expected, 1e-13) << pair.region << ", E " << e_n << " " << e_t;
        EXPECT_EQ(r.rigid_contact_speed > 0.0, e_n == 0.0 && r.contact_law > 0.0) << pair.region;
      }
    }
  }
}

TEST(ResidualsOfAPair, AreZeroForASolution) {
  const ContactProblem p = one_contact(0.4, 2.0, 0.5);
  for (const int i : {0, 4}) {
    ContactSolution x{VecX::Zero(6), kPairs[i].gamma};
    x.v.head<3>() = kPairs[i].v;
    EXPECT_LE(compute_residuals(p, x, kReference).contact_law, 1e-15) << kPairs[i].region;
  }
}

TEST(ResidualsOfAPair, ConeViolationIsTheWorstContactOverTheLargestImpulse) {
  const ContactProblem p = one_contact(0.4, 2.0, 0.5);
  const auto violation = [&](const Vec3& gamma) {
    return compute_residuals(p, {VecX::Zero(6), gamma}, kReference).cone_violation;
  };
  EXPECT_EQ(violation({1.0, 0.2, 0.3}), 0.0);
  EXPECT_NEAR(violation({1.0, 0.3, 0.4}), 0.1, 1e-15);
  EXPECT_NEAR(violation({-2.0, 0.0, 0.0}), 1.0, 1e-15);
}

/// The problem of a dome, with v and gamma away from its solution and gamma inside the cones.
struct Disturbed {
  ContactProblem problem;
  ContactSolution x;
};
Disturbed disturbed_dome() {
  scenes::DomeShape shape;
  shape.rings = 4;
  shape.blocks_per_ring = 6;
  Disturbed d{scenes::dome(shape, kStep, {0.4, 1e-6, 3e-7}), {}};
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  d.x.v = d.problem.v_star;
  for (double& v : d.x.v) v += 1e-3 * normal(random);
  d.x.gamma.resize(d.problem.b.size());
  for (int i = 0; i < d.problem.num_contacts(); ++i) {
    const double n = 1e3 * std::abs(normal(random));
    d.x.gamma.segment<3>(3 * i) = n * Vec3(1.0, 0.2 * std::sin(i), 0.2 * std::cos(i));
  }
  return d;
}

TEST(ResidualsOfAPair, MomentumIsTheUnbalancedImpulseOverTheMeanWeight) {
  const auto [p, x] = disturbed_dome();
  double mass = 0.0, worst = 0.0;
  for (int k = 0; k < p.num_blocks(); ++k) {
    mass += p.M[k](0, 0) / p.num_blocks();
    Eigen::Matrix<double, 6, 1> r = p.M[k] * (x.v - p.v_star).segment<6>(6 * k);
    for (int i = 0; i < p.num_contacts(); ++i) {
      if (p.block_a[i] == k) r -= p.D_a[i].matrix() * x.gamma.segment<3>(3 * i);
      if (p.block_b[i] == k) r -= p.D_b[i].matrix() * x.gamma.segment<3>(3 * i);
    }
    worst = std::max(worst, std::sqrt(r.dot(p.M[k].inverse() * r)));
  }
  const double expected = worst / (std::sqrt(mass) * kReference);
  EXPECT_NEAR(compute_residuals(p, x, kReference).momentum, expected, 1e-12 * expected);
}

// Primal minus dual objective by definition. The pair is far enough from the solution to avoid cancellation.
TEST(ResidualsOfAPair, CertifiedErrorIsTheDualityGap) {
  const auto [p, x] = disturbed_dome();
  const VecX y = relative_velocity(p, x.v) + p.b;
  double primal = 0.0, dual = 0.0;
  const VecX impulse = generalized_impulse(p, x.gamma);
  for (int k = 0; k < p.num_blocks(); ++k) {
    const auto d = (x.v - p.v_star).segment<6>(6 * k);
    primal += 0.5 * d.dot(p.M[k] * d);
    dual -= 0.5 * impulse.segment<6>(6 * k).dot(p.M[k].inverse() * impulse.segment<6>(6 * k));
  }
  for (int i = 0; i < p.num_contacts(); ++i) {
    const Vec3 E = p.E.segment<3>(3 * i);
    const Vec3 of_v = scenes::slow_impulse(contact_law(p, i), y.segment<3>(3 * i));
    primal += 0.5 * of_v.dot(E.cwiseProduct(of_v));
    const Vec3 gamma = x.gamma.segment<3>(3 * i);
    dual -= 0.5 * gamma.dot(E.cwiseProduct(gamma));
  }
  dual -= x.gamma.dot(relative_velocity(p, p.v_star) + p.b);
  const double expected = std::sqrt(2.0 * (primal - dual));
  EXPECT_NEAR(force_error_bound(p, x), expected, 1e-9 * expected);
  const Residuals r = compute_residuals(p, x, kReference);
  ASSERT_TRUE(r.certificate.value.has_value());
  const double norm = std::sqrt(x.gamma.dot(p.E.cwiseProduct(x.gamma)));
  EXPECT_NEAR(*r.certificate.value, expected / norm, 1e-9 * expected / norm);
}

/// A dome in which the compliance of every third contact is 1e-7 times that of the others.
ContactProblem mixed_dome(double contrast) {
  scenes::DomeShape shape;
  shape.rings = 4;
  shape.blocks_per_ring = 6;
  ContactProblem p = scenes::dome(shape, kStep, {0.4, 1e-6, 1e-6});
  for (int i = 0; i < p.num_contacts(); i += 3) p.E.segment<3>(3 * i) *= contrast;
  return p;
}

ContactSolution solved(const ContactProblem& p, double tolerance) {
  ContactSolverOptions options;
  options.tolerance = tolerance;
  options.reference_speed = kReference;
  ContactSolution x;
  EXPECT_EQ(solve_contact(p, options, &x).ending, SolveEnding::converged);
  return x;
}

// The bound is in the norm of the compliance of each contact, so that stiff contacts do not spoil it. With
// the smallest compliance of the model in its place it was 3e3 times larger at a contrast of 1e7.
TEST(ForceErrorBound, HoldsAndStaysSharpForMixedCompliances) {
  for (const double contrast : {1.0, 1e-4, 1e-7}) {
    const ContactProblem p = mixed_dome(contrast);
    const ContactSolution exact = solved(p, 1e-13);
    for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
      const ContactSolution rough = solved(p, tolerance);
      const double error = compliance_norm(p, rough.gamma - exact.gamma);
      const double bound = force_error_bound(p, rough), exact_bound = force_error_bound(p, exact);
      EXPECT_GE(bound + exact_bound, error) << contrast << ", tolerance " << tolerance;
      // Newton may end far below the tolerance, where rounding is all that is left.
      EXPECT_LE(bound, 100.0 * error + exact_bound) << contrast << ", tolerance " << tolerance;
    }
  }
}

// Sliding contacts: gamma . z cancels to zero, and rounding must not turn 1e-16 into an error of 1e-8.
TEST(ForceErrorBound, IsOfTheOrderOfRoundingForASlidingContact) {
  const ContactProblem p = one_contact(0.4, 2.0, 0.5);
  for (const double angle : {0.1, 0.7, 2.0, 3.9}) {
    ContactSolution x{VecX::Zero(6), VecX()};
    x.v.head<3>() = Vec3(-1.0, 5.0 * std::cos(angle), 5.0 * std::sin(angle));
    x.gamma = contact_impulse(contact_law(p, 0), Vec3(x.v.head<3>()));
    ContactProblem balanced = p;
    balanced.v_star = x.v;
    balanced.v_star.head<3>() -= x.gamma / 2.0;  // M = 2 kg
    const double bound = force_error_bound(balanced, x);
    EXPECT_LE(bound, 200.0 * std::numeric_limits<double>::epsilon() * x.v.norm()) << angle;
    EXPECT_GT(bound, 0.0) << "rounding is counted";
  }
}

TEST(ForceErrorBound, IsAbsentWithItsReason) {
  const ContactSolution stick{VecX::Zero(6), Vec3(1.0, -0.2, 0.0)};
  const auto reason = [](const ContactProblem& p, const ContactSolution& x, FrictionLaw law) {
    const ForceCertificate c = compute_residuals(p, x, kReference, law).certificate;
    EXPECT_FALSE(c.value.has_value());
    return c.bounds;
  };
  const FrictionLaw associated = FrictionLaw::associated;
  EXPECT_NE(reason(one_contact(0.4, 0.0, 0.0), stick, associated).find("compliance is zero"),
            std::string::npos);
  EXPECT_NE(reason(one_contact(0.4, 2.0, 0.5), stick, FrictionLaw::coulomb).find("Coulomb"),
            std::string::npos);
  EXPECT_NE(reason(one_contact(0.1, 2.0, 0.5), stick, associated).find("exceed the limits of their joints"),
            std::string::npos);
  EXPECT_EQ(reason(one_contact(0.4, 2.0, 0.5), {VecX::Zero(6), VecX::Zero(3)}, associated),
            "no contact is loaded");
}

TEST(ForcesUnique, RequireAComplianceAndTheAssociatedLaw) {
  EXPECT_TRUE(forces_unique(one_contact(0.4, 2.0, 0.5), FrictionLaw::associated).value);
  EXPECT_FALSE(forces_unique(one_contact(0.4, 2.0, 0.0), FrictionLaw::associated).value);
  EXPECT_TRUE(forces_unique(one_contact(0.0, 2.0, 0.0), FrictionLaw::coulomb).value) << "no friction";
  EXPECT_FALSE(forces_unique(one_contact(0.4, 2.0, 0.5), FrictionLaw::coulomb).value);
}

// One contact of a dome with a wrong force of a millionth of the total: invisible in the global norm.
TEST(ContactLawErrors, ShowTheContactThatTheGlobalNormHides) {
  const ContactProblem p = mixed_dome(1.0);
  ContactSolution x = solved(p, 1e-13);
  constexpr int kWrong = 40;
  x.gamma[3 * kWrong] += 1e-7 * x.gamma.norm();
  EXPECT_LE(compute_residuals(p, x, kReference).contact_law, 1.1e-7);
  const VecX errors = contact_law_errors(p, x, FrictionLaw::associated);
  Eigen::Index worst = 0;
  EXPECT_NEAR(errors.maxCoeff(&worst), 1e-7 * x.gamma.norm(), 1e-10 * x.gamma.norm());
  EXPECT_EQ(worst, kWrong);
  EXPECT_NEAR(errors.norm() / x.gamma.norm(), compute_residuals(p, x, kReference).contact_law, 1e-15);
}

// The allowance for rounding ends at 1e-3, and messages state that it was used.
TEST(Excess, AllowsForRoundingUpToALimit) {
  Residuals r;
  r.contact_law = 5e-9;
  r.contact_law_rounding = 1e-9;
  EXPECT_LE(excess(r, 1e-10), 1.0);
  EXPECT_NE(residuals_text(r, 1e-10).find("because rounding of the velocities causes up to that much"),
            std::string::npos);
  EXPECT_EQ(residuals_text(r, 5e-9).find("rounding"), std::string::npos) << "not needed";
  r.contact_law = 5e-2;
  r.contact_law_rounding = 1e-2;
  EXPECT_DOUBLE_EQ(excess(r, 1e-10), 50.0);
  EXPECT_DOUBLE_EQ(excess(r, 0.1), 0.5);
}

TEST(ResidualsOfAPair, AreNotSmallForNaN) {
  auto [p, x] = disturbed_dome();
  x.v[7] = std::nan("");
  const Residuals r = compute_residuals(p, x, kReference);
  EXPECT_FALSE(r.momentum <= 1.0);
  EXPECT_FALSE(r.contact_law <= 1.0);
}

}  // namespace
}  // namespace cupola::residuals_test
