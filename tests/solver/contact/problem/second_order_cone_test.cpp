#include "solver/contact/problem/second_order_cone.hpp"

#include <gtest/gtest.h>

namespace cupola::second_order_cone_test {
namespace {

const std::vector<Vec3> kInterior{
    {1, 0, 0}, {1, 0.3, -0.2}, {5, 4.9, 0.5}, {1e-6, 9e-7, 0}, {1e6, -3e5, 9e5}};

TEST(SecondOrderCone, NesterovTodScalingMapsThePairOntoOnePoint) {
  for (const Vec3& z : kInterior) {
    for (const Vec3& gamma : kInterior) {
      const NesterovTodd nt = nesterov_todd(z, gamma);
      const double condition =
          std::sqrt(gamma.squaredNorm() / cone_determinant(gamma) * z.squaredNorm() / cone_determinant(z));
      // Rounding grows as the pair approaches the boundary.
      const double tolerance = 1e-15 * 16 * condition * nt.lambda.norm();
      EXPECT_LE((nt.W * gamma - nt.lambda).norm(), tolerance);
      EXPECT_LE((nt.W_inverse * z - nt.lambda).norm(), tolerance);
      EXPECT_LE((nt.W_squared * gamma - z).norm(), 1e-15 * 16 * condition * condition * z.norm());
      EXPECT_NEAR(nt.lambda.squaredNorm(), z.dot(gamma), 1e-14 * condition * z.norm() * gamma.norm());
    }
  }
}

TEST(SecondOrderCone, QuotientInvertsTheProduct) {
  for (const Vec3& x : kInterior) {
    for (const Vec3& y : kInterior) {
      const double condition = x.squaredNorm() / cone_determinant(x);
      EXPECT_LE((jordan_quotient(x, jordan_product(x, y)) - y).norm(),
                1e-14 * condition * condition * y.norm());
    }
  }
}

TEST(SecondOrderCone, StepEndsExactlyOnTheBoundary) {
  const std::vector<Vec3> directions{{-1, 0, 0},  {0, 1, 0}, {1, 2, -1}, {-1, 0.5, 3},
                                     {-1, -1, 0}, {1, 1, 0}, {2, 0, 1}};
  for (const Vec3& x : kInterior) {
    for (const Vec3& unit : directions) {
      const Vec3 d = x.norm() * unit;
      const double t = step_to_boundary(x, d, 10.0);
      const Vec3 end = x + t * d, before = x + 0.999 * t * d;
      EXPECT_GE(before[0] - before.tail<2>().norm(), 0.0) << x.transpose() << " + " << d.transpose();
      const double margin = end[0] - end.tail<2>().norm();
      EXPECT_GE(margin, -1e-13 * (end.norm() + x.norm()));
      if (t < 10.0) {
        EXPECT_LE(margin, 1e-13 * (end.norm() + x.norm()));
      }
    }
  }
}

// The double root of the determinant must not be lost to rounding.
TEST(SecondOrderCone, StepAlongTheAxisEndsAtTheApex) {
  for (int k = 1; k <= 1000; ++k) {
    const Vec3 x(0.1 * k / 7.0, 1e-17 * k, 0.0), d(-0.3 * k / 11.0, 1e-17, -1e-17 * k);
    EXPECT_NEAR(step_to_boundary(x, d, 10.0), -x[0] / d[0], 1e-7) << k;
  }
}

TEST(SecondOrderCone, DeterminantIsAccurateNearTheBoundary) {
  const Vec3 x(1.0, 1.0 - 1e-15, 0.0);
  EXPECT_NEAR(cone_determinant(x), 2e-15, 1e-16 * 4);
}

}  // namespace
}  // namespace cupola::second_order_cone_test
