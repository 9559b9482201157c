#include "solver/contact/problem/cone.hpp"

#include <cmath>
#include <set>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "tests/solver/contact/slow_contact.hpp"

namespace cupola::cone_test {
namespace {

using scenes::slow_impulse;

struct Sample {
  ContactLaw law;
  Vec3 y;
  ContactRegion region;
};

/// Each region, its boundaries, and points close to both sides of them, with c_n != c_t. For e_n = 2, e_t =
/// 0.5, mu = 0.4: stick if |y_t| <= mu (-y_n) e_t / e_n = 0.1 (-y_n); separation if y_n >= 0.4 |y_t|.
const std::vector<Sample> kSamples{
    {{2.0, 0.5, 0.4}, {-1.0, 0.0, 0.0}, ContactRegion::stick},
    {{2.0, 0.5, 0.4}, {-1.0, 0.03, -0.04}, ContactRegion::stick},
    {{2.0, 0.5, 0.4}, {-1.0, 0.0999999, 0.0}, ContactRegion::stick},
    {{2.0, 0.5, 0.4}, {-1.0, 0.1000001, 0.0}, ContactRegion::slip},
    {{2.0, 0.5, 0.4}, {-1.0, 3.0, 4.0}, ContactRegion::slip},
    {{2.0, 0.5, 0.4}, {0.0, 3.0, -4.0}, ContactRegion::slip},
    {{2.0, 0.5, 0.4}, {1.9999999, 3.0, 4.0}, ContactRegion::slip},
    {{2.0, 0.5, 0.4}, {2.0, 3.0, 4.0}, ContactRegion::separation},
    {{2.0, 0.5, 0.4}, {2.0000001, 3.0, 4.0}, ContactRegion::separation},
    {{2.0, 0.5, 0.4}, {1.0, 0.0, 0.0}, ContactRegion::separation},
    {{2.0, 0.5, 0.4}, {0.0, 0.0, 0.0}, ContactRegion::separation},
    {{1e-12, 1e-9, 10.0}, {-1e-3, 1e-2, 2e-3}, ContactRegion::stick},
    {{1e-12, 1e-9, 10.0}, {-1e-6, 1e-2, 2e-2}, ContactRegion::slip},
    {{1e-9, 1e-12, 10.0}, {-1e-3, 1e-6, 2e-7}, ContactRegion::stick},
    {{1e-9, 1e-12, 10.0}, {-1e-3, 1e-4, 2e-5}, ContactRegion::slip},
    {{1e-9, 1e-9, 1e-3}, {-1e-3, 1e-2, 2e-3}, ContactRegion::slip},
};

TEST(Cone, RegionsMatchTheClosedForm) {
  for (const Sample& s : kSamples) EXPECT_EQ(contact_region(s.law, s.y), s.region) << s.y.transpose();
}

TEST(Cone, ImpulseMinimisesTheEnergyOverTheCone) {
  for (const Sample& s : kSamples) {
    const Vec3 gamma = contact_impulse(s.law, s.y), slow = slow_impulse(s.law, s.y);
    // Half an ulp of the slope changes the root by a few ulp of its largest term.
    EXPECT_LE((gamma - slow).norm(), 1e-14 * (std::abs(s.y[0]) + s.law.mu * s.y.norm()) / s.law.e_n)
        << gamma.transpose() << " | " << slow.transpose();
  }
}

TEST(Cone, ImpulseIsComplementaryToTheDualVelocity) {
  for (const Sample& s : kSamples) {
    const Vec3 gamma = contact_impulse(s.law, s.y);
    const Vec3 z = s.y + Vec3(s.law.e_n, s.law.e_t, s.law.e_t).cwiseProduct(gamma);
    const double scale = s.y.norm();
    EXPECT_LE(gamma.tail<2>().norm(), s.law.mu * gamma[0] * (1 + 4e-16));
    EXPECT_GE(z[0], s.law.mu * z.tail<2>().norm() - 1e-14 * scale * (1 + s.law.mu));
    EXPECT_NEAR(gamma.dot(z), 0.0, 1e-14 * scale * gamma.norm() * (1 + s.law.mu));
  }
}

TEST(Cone, StiffnessIsTheDerivativeOfTheImpulse) {
  for (const Sample& s : kSamples) {
    if (s.y.isZero() || std::abs(s.y[0] - s.law.mu * s.y.tail<2>().norm()) < 1e-5)
      continue;  // on or near a kink
    if (std::abs(s.y.tail<2>().norm() - 0.1) < 1e-5) continue;
    const Mat3 G = contact_stiffness(s.law, s.y);
    const double step = 1e-6 * s.y.norm();
    for (int k = 0; k < 3; ++k) {
      const Vec3 e = step * Vec3::Unit(k);
      const Vec3 slope = (contact_impulse(s.law, s.y + e) - contact_impulse(s.law, s.y - e)) / (2 * step);
      EXPECT_LE((G.col(k) + slope).norm(), 1e-5 * std::max(G.norm(), 1e-300))
          << s.y.transpose();  // step^2 and eps/step
    }
    EXPECT_EQ(G, G.transpose());
    EXPECT_GE(G.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-14 * G.norm());
  }
}

// The definition of the flow rule, checked on the impulse, and the derivative by differences.
TEST(Cone, SlidingContactsOpenByTheirDilatancy) {
  for (const double dilatancy : {0.0, 0.3, 1.0}) {
    for (Sample s : kSamples) {
      s.law.dilatancy = dilatancy;
      const Vec3 gamma = contact_impulse(s.law, s.y);
      const Vec3 z = s.y + Vec3(s.law.e_n, s.law.e_t, s.law.e_t).cwiseProduct(gamma);
      const double rounding = 1e-14 * s.y.norm() * (1 + s.law.mu);
      switch (contact_region(s.law, s.y)) {
        case ContactRegion::separation:
          EXPECT_TRUE(gamma.isZero(0.0));
          EXPECT_GE(s.y[0], dilatancy * s.law.mu * s.y.tail<2>().norm());
          break;
        case ContactRegion::stick:
          EXPECT_LE(z.norm(), rounding);
          EXPECT_LE(gamma.tail<2>().norm(), s.law.mu * gamma[0] * (1 + 4e-16));
          break;
        case ContactRegion::slip:
          EXPECT_NEAR(gamma.tail<2>().norm(), s.law.mu * gamma[0], 1e-14 * gamma.norm());
          EXPECT_NEAR(z[0], dilatancy * s.law.mu * z.tail<2>().norm(), rounding);
          EXPECT_NEAR(z.tail<2>().dot(gamma.tail<2>()), -z.tail<2>().norm() * gamma.tail<2>().norm(),
                      rounding * gamma.norm());
          break;
        case ContactRegion::yield:
        case ContactRegion::yield_and_slip:
          ADD_FAILURE() << "a dry joint has no strength to reach";
      }
    }
  }
}

TEST(Cone, StiffnessIsTheDerivativeForAnyDilatancy) {
  for (const double dilatancy : {0.0, 0.3}) {
    const ContactLaw law{2.0, 0.5, 0.4, dilatancy};
    for (const Vec3& y :
         {Vec3(-1.0, 0.03, -0.04), Vec3(-1.0, 3.0, 4.0), Vec3(1.0, 3.0, -4.0), Vec3(0.1, 3.0, 4.0)}) {
      const Mat3 G = contact_stiffness(law, y);
      for (int k = 0; k < 3; ++k) {
        const Vec3 e = 1e-6 * Vec3::Unit(k);
        const Vec3 slope = (contact_impulse(law, y + e) - contact_impulse(law, y - e)) / 2e-6;
        EXPECT_LE((G.col(k) + slope).norm(), 1e-8 * std::max(G.norm(), 1.0)) << y.transpose();  // eps / step
      }
    }
  }
}

TEST(Cone, ResponseIsImpulseAndCurvatureInEveryRegion) {
  const Vec3 dy(0.3, -0.7, 1.1);
  const ContactStrength dry, mortar{.tension = 0.1, .cohesion = 0.2, .compression = 0.6};
  std::set<ContactRegion> regions;
  for (const ContactStrength& strength : {dry, mortar})
    for (const double dilatancy : {0.0, 0.3, 1.0})
      for (const double mu : {0.0, 0.4})
        for (const double y_n : {-2.0, -1.0, -0.1, 0.1, 1.0})
          for (const double y_t : {0.0, 0.03, 0.2, 3.0}) {
            const ContactLaw law{2.0, 0.5, mu, dilatancy, strength};
            const Vec3 y(y_n, 0.6 * y_t, -0.8 * y_t);
            const ContactResponse response = contact_response(law, y, dy);
            regions.insert(contact_region(law, y));
            EXPECT_EQ(response.impulse, contact_impulse(law, y)) << y.transpose();
            const double curvature = dy.dot(contact_stiffness(law, y) * dy);
            EXPECT_NEAR(response.curvature, curvature, 1e-14 * dy.squaredNorm() / law.e_t) << y.transpose();
          }
  EXPECT_EQ(regions.size(), 5u);
}

TEST(Cone, FrictionlessContactIgnoresTangentialValues) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const ContactLaw law{2.0, nan, 0.0};
  EXPECT_EQ(contact_impulse(law, {-1.0, 5.0, 7.0}), Vec3(0.5, 0.0, 0.0));
  EXPECT_EQ(contact_impulse(law, {-1.0, 0.0, 0.0}), Vec3(0.5, 0.0, 0.0));
  EXPECT_EQ(contact_impulse(law, {1.0, 5.0, 7.0}), Vec3::Zero().eval());
  EXPECT_EQ(contact_stiffness(law, {-1.0, 5.0, 7.0}), Mat3(Vec3(0.5, 0.0, 0.0).asDiagonal()));
}

TEST(Cone, ProjectionKeepsTheConeAndMapsItsPolarToZero) {
  const ContactLaw metric{2.0, 0.5, 0.4};
  EXPECT_LE((project_on_admissible(metric, {1.0, 0.3, 0.2}) - Vec3(1.0, 0.3, 0.2)).norm(), 1e-15);
  EXPECT_EQ(project_on_admissible(metric, {-1.0, 0.3, 0.2}), Vec3::Zero().eval());
  const Vec3 x(0.1, 3.0, -4.0), on_cone = project_on_admissible(metric, x);
  EXPECT_LE((project_on_admissible(metric, on_cone) - on_cone).norm(), 1e-15);
  EXPECT_NEAR(on_cone.tail<2>().norm(), 0.4 * on_cone[0], 1e-15);
}

TEST(Cone, ScalingVelocitiesScalesImpulses) {  // the cone has no length scale
  for (const Sample& s : kSamples) {
    const Vec3 gamma = contact_impulse(s.law, s.y);
    EXPECT_LE((contact_impulse(s.law, 1024.0 * s.y) - 1024.0 * gamma).norm(), 1e-15 * 1024.0 * gamma.norm());
  }
}

}  // namespace
}  // namespace cupola::cone_test
