#include "postproc/mechanics/wrench.hpp"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace cupola::wrench_test {
namespace {

constexpr double kTolerance = 1e-12;  // some dozen rounding errors of numbers near 1

struct PointedForce {
  Vec3 point, force;
};

Wrench sum_about(const Vec3& about, const std::vector<PointedForce>& forces) {
  Wrench w;
  w.point = about;
  for (const PointedForce& f : forces) w.add_force(f.point, f.force);
  return w;
}

// Unit forces along x at the origin, along y at (0, 0, 1) and along z at (1, 0, 0). About the origin
//
//     F = (1, 1, 1),   M = (0,0,1) x (0,1,0) + (1,0,0) x (0,0,1) = (-1, -1, 0)
//
// With M.F = -2 and |F|^2 = 3, the couple is -2/3 F, its length 2/3 m, and the axis passes through
// F x M / |F|^2 = (1, -1, 0) / 3.
const std::vector<PointedForce> kThreeSkewForces{
    {{0, 0, 0}, {1, 0, 0}}, {{0, 0, 1}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, 1}}};

TEST(Wrench, CentralAxisOfThreeSkewForces) {
  const Wrench w = sum_about(Vec3::Zero(), kThreeSkewForces);
  const CentralAxis axis = central_axis(w);
  ASSERT_TRUE(axis.exists);
  EXPECT_LT((w.force - Vec3(1, 1, 1)).norm(), kTolerance);
  EXPECT_LT((w.moment - Vec3(-1, -1, 0)).norm(), kTolerance);
  EXPECT_LT((axis.point - Vec3(1, -1, 0) / 3.0).norm(), kTolerance);
  EXPECT_LT((axis.couple - Vec3::Constant(-2.0 / 3.0)).norm(), kTolerance);
  EXPECT_NEAR(axis.couple_length, 2.0 / 3.0, kTolerance);
}

TEST(Wrench, CentralAxisDoesNotDependOnTheReferencePoint) {
  const CentralAxis reference = central_axis(sum_about(Vec3::Zero(), kThreeSkewForces));
  const Vec3 direction = Vec3(1, 1, 1).normalized();
  for (const Vec3& about : {Vec3(3, -2, 5), Vec3(-0.1, 0.7, 0.2), Vec3(10, 20, -30)}) {
    const double tolerance = kTolerance * (1.0 + about.norm());  // moments grow with the lever arm
    const Wrench direct = sum_about(about, kThreeSkewForces);
    const Wrench moved = moved_to(sum_about(Vec3::Zero(), kThreeSkewForces), about);
    EXPECT_LT((direct.moment - moved.moment).norm(), tolerance);
    const CentralAxis axis = central_axis(direct);
    EXPECT_LT((axis.couple - reference.couple).norm(), tolerance);
    EXPECT_LT((axis.point - reference.point).cross(direction).norm(), tolerance) << "on one line";
  }
}

TEST(Wrench, CentralAxisRotatesAndTranslatesWithTheForces) {
  const Mat3 R = Eigen::AngleAxisd(1.1, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  const Vec3 shift(7.0, -4.0, 2.0);
  std::vector<PointedForce> moved;
  for (const PointedForce& f : kThreeSkewForces) moved.push_back({R * f.point + shift, R * f.force});
  const CentralAxis a = central_axis(sum_about(Vec3::Zero(), kThreeSkewForces));
  const CentralAxis b = central_axis(sum_about(shift, moved));
  EXPECT_LT((R * a.point + shift - b.point).norm(), 10 * kTolerance);
  EXPECT_LT((R * a.couple - b.couple).norm(), 10 * kTolerance);
  EXPECT_NEAR(a.couple_length, b.couple_length, 10 * kTolerance);
}

TEST(Wrench, SumOfWrenchesIsTheWrenchOfTheSum) {
  Wrench sum;
  sum.point = {2, 2, 2};
  for (const PointedForce& f : kThreeSkewForces) {
    Wrench single;
    single.point = {-1, 5, 0.5};
    single.add_force(f.point, f.force);
    sum.add(single);
  }
  const Wrench direct = sum_about({2, 2, 2}, kThreeSkewForces);
  EXPECT_LT((sum.force - direct.force).norm(), kTolerance);
  EXPECT_LT((sum.moment - direct.moment).norm(), 10 * kTolerance);
}

TEST(Wrench, PureCoupleHasNoAxis) {
  const Wrench couple{{1, 2, 3}, Vec3::Zero(), {0, 0, 5}};
  EXPECT_FALSE(central_axis(couple).exists);
  EXPECT_EQ(central_axis(couple).couple_length, 0.0);
}

TEST(Wrench, CentralAxisIntersectsAPlane) {
  const Wrench w = sum_about(Vec3::Zero(), kThreeSkewForces);
  const Plane plane{Vec3(0, 0, 1), 4.0};
  const Vec3 x = axis_in_plane(central_axis(w), w.force, plane);
  EXPECT_LT((x - Vec3(1.0 / 3.0 + 4.0, -1.0 / 3.0 + 4.0, 4.0)).norm(), 10 * kTolerance);
  // An axis parallel to the plane returns its own point.
  const Plane along{Vec3(1, -1, 0).normalized(), 9.0};
  EXPECT_EQ(axis_in_plane(central_axis(w), w.force, along), central_axis(w).point);
}

}  // namespace
}  // namespace cupola::wrench_test
