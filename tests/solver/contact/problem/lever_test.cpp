#include <gtest/gtest.h>

#include "solver/contact/problem/contact_problem.hpp"

namespace cupola::lever_test {
namespace {

constexpr double kRounding = 1e-15;  // of sums of three products of order one

Lever some_lever() {
  const Mat3 frame = Eigen::Quaterniond(0.4, -0.1, 0.7, 0.2).normalized().toRotationMatrix();
  return {frame, Vec3(0.3, -0.5, 0.2)};
}

// A unit impulse along each axis of the contact, and its moment about the centroid.
TEST(Lever, HasTheAxesAndTheirMomentsAsColumns) {
  const Lever D = some_lever();
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 force = D.frame.col(axis);
    const Mat63 columns = D.matrix();
    EXPECT_EQ(columns.col(axis).head<3>(), force);
    EXPECT_LE((columns.col(axis).tail<3>() - D.arm.cross(force)).norm(), kRounding);
    Vec6 sum = Vec6::Ones();
    D.add_impulse(Vec3(Vec3::Unit(axis)), sum);
    EXPECT_LE((sum - Vec6::Ones() - columns.col(axis)).norm(), kRounding);
  }
}

TEST(Lever, TakesTheVelocityOfThePoint) {
  const Lever D = some_lever();
  const Vec6 v{0.3, -0.2, 0.1, 0.5, -0.4, 0.2};
  const Vec3 at_point = v.head<3>() + v.tail<3>().cross(D.arm);
  EXPECT_LE((D.velocity(v) - D.frame.transpose() * at_point).norm(), kRounding);
  EXPECT_LE((D.velocity(v) - D.matrix().transpose() * v).norm(), 2.0 * kRounding);
}

TEST(Lever, BoundsTheSizeOfItsColumns) {
  const Lever D = some_lever();
  const Mat63 columns = D.matrix().cwiseAbs();
  const Vec6 v{0.3, -0.2, 0.1, 0.5, -0.4, 0.2};
  const Vec3 gamma(0.7, -0.3, 0.2);
  EXPECT_TRUE(
      (D.size_of_velocity(v).array() >= (columns.transpose() * v.cwiseAbs()).array() - kRounding).all());
  EXPECT_TRUE((D.size_of_impulse(gamma).array() >= (columns * gamma.cwiseAbs()).array() - kRounding).all());
  // Equal where no terms cancel.
  const Lever along{Mat3::Identity(), Vec3::UnitX()};
  EXPECT_EQ(along.size_of_velocity(v), along.matrix().cwiseAbs().transpose() * v.cwiseAbs());
}

}  // namespace
}  // namespace cupola::lever_test
