#include "postproc/mechanics/planar_hull.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace cupola::planar_hull_test {
namespace {

constexpr double kTolerance = 1e-12;

/// A b x d rectangle in a tilted plane, with an inner point, a point on an edge and a repeated corner.
std::vector<Vec3> rectangle(double b, double d, const Mat3& R, const Vec3& at) {
  std::vector<Vec3> points;
  for (const auto& [x, y] : {std::pair{-b, -d}, {b, -d}, {b, d}, {-b, d}, {0.0, 0.0}, {b, d}, {0.1 * b, -d}})
    points.push_back(at + R * Vec3(x / 2, y / 2, 0.0));
  return points;
}

TEST(PlanarHull, AreaCentroidAndSecondMomentsOfARectangle) {
  const Mat3 R = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Vec3 at(100, -50, 20);
  const PlanarHull hull = planar_hull(rectangle(3.0, 2.0, R, at), R.col(2));
  EXPECT_NEAR(hull.area, 6.0, 1e-11);  // coordinates near 100 have 14 digits after the point
  EXPECT_LT((hull.centroid - at).norm(), 1e-11);
  // Moments about the principal axes: b d^3 / 12 and d b^3 / 12.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(hull.second_moment);
  EXPECT_NEAR(eigen.eigenvalues()[0], 3.0 * 8.0 / 12.0, 1e-10);
  EXPECT_NEAR(eigen.eigenvalues()[1], 2.0 * 27.0 / 12.0, 1e-10);
}

TEST(PlanarHull, KernUtilisationOfARectangleIsSixEOverB) {
  const double b = 3.0, d = 2.0;
  const PlanarHull hull = planar_hull(rectangle(b, d, Mat3::Identity(), Vec3::Zero()), Vec3::UnitZ());
  for (const double e : {0.0, 0.1, b / 6, 0.9, b / 2}) {
    const auto along_b = hull.coordinates(Vec3(e, 0, 0));
    EXPECT_NEAR(kern_use(hull, along_b), 6.0 * e / b, kTolerance);
    EXPECT_NEAR(distance_to_outline(hull, along_b), std::min(b / 2 - e, d / 2), kTolerance);
  }
  // Eccentric in both directions: 6 (ex / b + ey / d).
  EXPECT_NEAR(kern_use(hull, hull.coordinates(Vec3(0.2, -0.3, 0))), 6.0 * (0.2 / b + 0.3 / d), kTolerance);
  EXPECT_LT(distance_to_outline(hull, hull.coordinates(Vec3(2.0, 0, 0))), 0.0) << "outside";
}

TEST(PlanarHull, TriangleMatchesClosedForm) {
  const PlanarHull hull = planar_hull({{0, 0, 0}, {6, 0, 0}, {0, 3, 0}}, Vec3::UnitZ());
  EXPECT_NEAR(hull.area, 9.0, kTolerance);
  EXPECT_LT((hull.centroid - Vec3(2, 1, 0)).norm(), kTolerance);
  const auto x = hull.coordinates(hull.centroid + Vec3::UnitX());
  EXPECT_NEAR(x.dot(hull.second_moment * x), 3.0 * 216.0 / 36.0, 1e-11);  // h b^3 / 36
}

TEST(PlanarHull, DegeneratePointsGiveZeroArea) {
  for (const std::vector<Vec3>& points : {std::vector<Vec3>{{1, 1, 1}},
                                          {{0, 0, 0}, {1, 0, 0}},
                                          {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}},
                                          {{0, 0, 0}, {1, 1e-15, 0}, {2, 0, 0}}}) {
    const PlanarHull hull = planar_hull(points, Vec3::UnitZ());
    EXPECT_EQ(hull.area, 0.0);
    EXPECT_TRUE(std::isnan(kern_use(hull, {0.3, 0.0}))) << "a hinge has no kern";
    EXPECT_EQ(distance_to_outline(hull, {0.3, 0.0}), 0.0);
    EXPECT_TRUE(hull.centroid.allFinite());
  }
}

}  // namespace
}  // namespace cupola::planar_hull_test
