#include "assembly/model/block_motion.hpp"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/assembly/scene.hpp"

namespace cupola::block_motion_test {
namespace {

constexpr double kRounding = 1e-12;  // m, of coordinates of a metre

/// Distance of the free block of test::two_block_assembly() if it and its support move as given.
double distance(const Eigen::Isometry3d& support, const Eigen::Isometry3d& free) {
  const Assembly assembly = test::two_block_assembly();
  std::vector<Vec3> displacement;
  std::vector<Eigen::Vector4d> turn;
  for (const Eigen::Isometry3d& motion : {support, free}) {
    const Vec3& centroid = assembly.blocks[displacement.size()].centroid;
    displacement.push_back(motion * centroid - centroid);
    const Eigen::Quaterniond q(motion.linear());
    turn.emplace_back(q.w(), q.x(), q.y(), q.z());
  }
  return distances_moved(assembly, displacement, turn).at(1);
}

Eigen::Isometry3d shift(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

TEST(DistancesMoved, AreThoseOfTheFarthestVertex) {
  const Assembly assembly = test::two_block_assembly();
  const Vec3& centroid = assembly.blocks[1].centroid;
  double radius = 0.0;  // from the upright through the centroid
  for (size_t v = 6; v < assembly.vertices.size(); ++v)
    if (v != 12 && v != 14 && v != 15 && v != 17)  // no vertices of the block
      radius = std::max(radius, (assembly.vertices[v] - centroid).head<2>().norm());
  constexpr double kAngle = 1.2;
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.translate(centroid).rotate(Eigen::AngleAxisd(kAngle, Vec3::UnitZ())).translate(-centroid);
  EXPECT_NEAR(distance(shift(0, 0, 0), turn), 2.0 * radius * std::sin(0.5 * kAngle), kRounding);
  EXPECT_NEAR(distance(shift(0, 0, 0), shift(0.3, 0, -0.4)), 0.5, kRounding);
}

TEST(DistancesMoved, DoNotCountWhatABlockFollowsOfASupport) {
  Eigen::Isometry3d tilt = shift(0.5, 0, 2.0);
  tilt.rotate(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  EXPECT_NEAR(distance(tilt, tilt), 0.0, kRounding);
  EXPECT_NEAR(distance(shift(0.2, 0, 0), shift(0.1, 0, -0.03)), 0.03, kRounding)
      << "midway between a support that moves and one that does not";
  EXPECT_NEAR(distance(shift(0, 0, 1.0), shift(0, 0, -0.4)), 0.4, kRounding)
      << "it falls as the support rises";
  EXPECT_NEAR(distance(shift(0, 0, 1.0), shift(0, 0, 1.2)), 0.2, kRounding);
}

}  // namespace
}  // namespace cupola::block_motion_test
