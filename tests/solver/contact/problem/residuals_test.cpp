// Each residual of residuals.hpp against its definition, with slow routines that share no code with it.

#include "solver/contact/problem/residuals.hpp"

#include <random>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

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
  p.D_a.emplace_back(Mat63::Zero());
  p.D_b.emplace_back(Mat63::Identity());
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
      if (p.block_a[i] == k) r -= p.D_a[i] * x.gamma.segment<3>(3 * i);
      if (p.block_b[i] == k) r -= p.D_b[i] * x.gamma.segment<3>(3 * i);
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
  const double expected = std::sqrt(2.0 * (primal - dual) / p.E.minCoeff()) / x.gamma.norm();
  const Residuals r = compute_residuals(p, x, kReference);
  ASSERT_TRUE(r.certificate.value.has_value());
  EXPECT_NEAR(*r.certificate.value, expected, 1e-9 * expected);
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
