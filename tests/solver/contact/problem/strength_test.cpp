#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "solver/contact/methods/primal_cost.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/duality_gap.hpp"

// Contacts with tension, cohesion and compressive strength.

namespace cupola::strength_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec3 times_compliance(const ContactLaw& law, const Vec3& gamma) {
  return Vec3(law.e_n, law.e_t, law.e_t).cwiseProduct(gamma);
}

/// 1/2 g E g + g y, which the impulse minimises under the associated law.
double energy(const ContactLaw& law, const Vec3& y, const Vec3& gamma) {
  return gamma.dot(0.5 * times_compliance(law, gamma) + y);
}

/// Slow, independent reference: for a given normal impulse the best shear is known; the energy is convex in
/// the normal impulse, which golden-section search finds to about the root of the rounding.
Vec3 slow_impulse(const ContactLaw& law, const Vec3& y) {
  const double y_t = y.tail<2>().norm();
  const Eigen::Vector2d t = y_t > 0.0 ? Eigen::Vector2d(y.tail<2>() / y_t) : Eigen::Vector2d::UnitX();
  const auto at = [&](double n) {
    const double shear = std::min(y_t / law.e_t, std::max(0.0, law.shear_limit(n)));
    return Vec3(n, -shear * t[0], -shear * t[1]);
  };
  double low = -law.tension_limit();
  double high = std::min(law.strength.compression, (std::abs(y[0]) + law.mu * y_t) / law.e_n + 1.0);
  for (int k = 0; k < 200; ++k) {
    const double third = (high - low) / 3.0;
    if (energy(law, y, at(low + third)) < energy(law, y, at(high - third)))
      high -= third;
    else
      low += third;
  }
  return at(0.5 * (low + high));
}

/// Laws of every sort of strength, with and without friction.
std::vector<ContactLaw> laws() {
  std::vector<ContactLaw> laws;
  for (const double mu : {0.0, 0.4, 3.0})
    for (const ContactStrength strength :
         {ContactStrength{0.0, 0.5, kInfinity}, ContactStrength{0.3, 0.5, kInfinity},
          ContactStrength{0.0, 0.0, 2.0}, ContactStrength{0.3, 0.5, 2.0},
          ContactStrength{5.0, 0.5, 2.0}})  // tension beyond cohesion / friction
      laws.push_back({2.0, 0.5, mu, 1.0, strength});
  return laws;
}

/// Relative velocities that reach every region.
std::vector<Vec3> velocities() {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::vector<Vec3> samples;
  for (int k = 0; k < 400; ++k)
    samples.emplace_back(3.0 * normal(random), normal(random) * (k % 3), normal(random) * (k % 2));
  return samples;
}

TEST(Strength, ImpulseMinimisesTheEnergyOverTheAdmissibleSet) {
  std::array<int, 5> visits{};
  for (const ContactLaw& law : laws())
    for (const Vec3& y : velocities()) {
      const Vec3 gamma = contact_impulse(law, y);
      ++visits[static_cast<std::size_t>(contact_region(law, y))];
      EXPECT_LE((gamma - slow_impulse(law, y)).norm(), 1e-6) << y.transpose();  // the root of rounding
      EXPECT_LE(limit_excess(law, gamma), 1e-15 * (1.0 + gamma.norm()));
    }
  for (const int count : visits) EXPECT_GT(count, 50);  // every region was reached
}

TEST(Strength, StiffnessIsTheDerivative) {
  for (ContactLaw law : laws())
    for (const double dilatancy : {0.0, 0.3, 1.0})
      for (const Vec3& y : velocities()) {
        law.dilatancy = dilatancy;
        constexpr double kStep = 1e-6;
        bool kink = false;
        for (int k = 0; k < 3; ++k)
          for (const double side : {-1.0, 1.0})
            kink |= contact_region(law, y + side * kStep * Vec3::Unit(k)) != contact_region(law, y);
        if (kink) continue;
        const Mat3 G = contact_stiffness(law, y);
        for (int k = 0; k < 3; ++k) {
          const Vec3 e = kStep * Vec3::Unit(k);
          const Vec3 slope = (contact_impulse(law, y + e) - contact_impulse(law, y - e)) / (2.0 * kStep);
          // step^2 times the curvature of the direction of slip, 1 / |y_t|^2, and eps / step
          const double curvature = y.tail<2>().norm() > 0.0 ? 1.0 / y.tail<2>().squaredNorm() : 0.0;
          EXPECT_LE((G.col(k) + slope).norm(), 1e-8 + 1e-11 * (1.0 + G.norm()) * curvature) << y.transpose();
        }
        if (dilatancy < 1.0) continue;
        EXPECT_LE((G - G.transpose()).norm(), 1e-15 * G.norm());
        EXPECT_GE(G.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-14 * (G.norm() + 1.0));
      }
}

// Plastic opening is dilatancy times friction times plastic slip, and a joint that yields opens or crushes.
TEST(Strength, PlasticVelocityObeysTheFlowRule) {
  for (ContactLaw law : laws())
    for (const double dilatancy : {0.0, 0.3, 1.0})
      for (const Vec3& y : velocities()) {
        law.dilatancy = dilatancy;
        const Vec3 gamma = contact_impulse(law, y), z = y + times_compliance(law, gamma);
        const double dilation = dilatancy * law.mu * z.tail<2>().norm();
        constexpr double kRounding = 1e-13;
        const bool pulled = gamma[0] <= -law.tension_limit() + 1e-14;
        switch (contact_region(law, y)) {
          case ContactRegion::stick:
            EXPECT_LE(z.norm(), kRounding);
            break;
          case ContactRegion::slip:
            EXPECT_NEAR(z[0], dilation, kRounding);
            EXPECT_NEAR(gamma.tail<2>().norm(), law.shear_limit(gamma[0]), kRounding);
            break;
          case ContactRegion::separation:
          case ContactRegion::yield:
          case ContactRegion::yield_and_slip:
            if (pulled)
              EXPECT_GE(z[0], dilation - kRounding);
            else
              EXPECT_LE(z[0], dilation + kRounding);
        }
        EXPECT_LE(z.tail<2>().dot(gamma.tail<2>()), kRounding);  // slip dissipates
      }
}

// The cost of Newton's method is a potential of the impulses: its slope along y is -gamma.
TEST(Strength, CostIsThePotentialOfTheImpulses) {
  for (const ContactLaw& law : laws())
    for (const Vec3& y : velocities()) {
      ContactProblem p;
      p.M = {Mat6::Identity()};
      p.block_a = {ContactProblem::kFixed};
      p.block_b = {0};
      p.D_a.resize(1);
      p.D_b = {{Mat3::Identity(), Vec3::Zero()}};
      p.v_star = VecX::Zero(6);
      p.b = VecX::Zero(3);
      p.E = Vec3(law.e_n, law.e_t, law.e_t);
      p.mu = VecX::Constant(1, law.mu);
      p.strength = {law.strength};
      p.h = 1.0;
      const auto cost = [&](const Vec3& at) {
        VecX w = VecX::Zero(6);
        w.head<3>() = at;
        return primal_point(whiten(p), w).cost - 0.5 * at.squaredNorm();
      };
      constexpr double kStep = 1e-5;
      for (int k = 0; k < 3; ++k) {
        const Vec3 e = kStep * Vec3::Unit(k);
        // The impulse is Lipschitz with 1 / e <= 2 per axis, so that a central difference errs by 2 kStep at
        // kinks.
        EXPECT_NEAR((cost(y + e) - cost(y - e)) / (2.0 * kStep), -contact_impulse(law, y)[k], 2.0 * kStep);
      }
    }
}

// The gap of two impulses is at least their squared distance, and zero where they agree.
TEST(Strength, DualityGapBoundsTheDistance) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const ContactLaw& law : laws())
    for (const Vec3& y : velocities()) {
      const Vec3 gamma = contact_impulse(law, y);
      EXPECT_LE(contact_duality_gap(law, y, gamma), 1e-14 * (1.0 + y.squaredNorm()));
      const Vec3 other =
          project_on_admissible(law, gamma + Vec3(normal(random), normal(random), normal(random)));
      const double gap = contact_duality_gap(law, y, other);
      // By definition of the two energies, primal minus dual.
      const double exact = energy(law, y, other) - energy(law, y, gamma);
      EXPECT_NEAR(gap, exact, 1e-12 * (1.0 + std::abs(exact) + y.squaredNorm()));
      EXPECT_GE(gap, 0.5 * (other - gamma).dot(times_compliance(law, other - gamma)) - 1e-12);
    }
}

// A law whose strengths are those of a dry joint is a dry joint, to the bit.
TEST(Strength, TendsToTheDryJoint) {
  const ContactLaw dry{2.0, 0.5, 0.4};
  for (const Vec3& y : velocities()) {
    ContactLaw nearly = dry;
    nearly.strength = {1e-12, 1e-12, 1e12};
    EXPECT_LE((contact_impulse(nearly, y) - contact_impulse(dry, y)).norm(), 1e-11);
  }
}

}  // namespace
}  // namespace cupola::strength_test
