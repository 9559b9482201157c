#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "solver/collision/collision_model.hpp"
#include "tests/solver/scenes.hpp"

namespace cupola::box_test {
namespace {

using namespace testing;  // the scenes

Pose some_pose(std::mt19937* random) {
  std::normal_distribution<double> normal;
  Pose pose;
  pose.p_WB = Vec3(normal(*random), normal(*random), normal(*random));
  pose.q_WB =
      Eigen::Quaterniond(normal(*random), normal(*random), normal(*random), normal(*random)).normalized();
  return pose;
}

TEST(OrientedBox, OfABrickIsTheBrick) {
  const CollisionModel model = make_collision_model(box_on_floor(Vec3(1, 2, 3)));
  Vec3 half = model.block_box[1].half_sizes;
  std::ranges::sort(half);
  EXPECT_LT((half - Vec3(0.5, 1.0, 1.5)).norm(), 1e-15);
  EXPECT_LT(model.block_box[1].center.norm(), 1e-15);  // the centroid
}

TEST(OrientedBox, ContainsEveryVertexAtAnyPose) {
  std::mt19937 random(7);
  const CollisionModel model = make_collision_model(running_bond_wall(Vec3(1.2, 1.0, 0.3), 3, 3));
  for (int block = 0; block < model.num_blocks(); ++block) {
    const Pose pose = some_pose(&random);
    const double padding = 0.01;
    const OrientedBox box = model.box_at(block, pose, padding);
    const Eigen::AlignedBox3d aligned = bounding_box(box);
    for (int part = model.part_start[block]; part < model.part_start[block + 1]; ++part) {
      for (const Vec3& r : model.vertices_of(model.parts[part])) {
        const Vec3 x = pose.q_WB * r + pose.p_WB;
        const Vec3 inside = (box.axes.transpose() * (x - box.center)).cwiseAbs();
        EXPECT_LT((inside - box.half_sizes).maxCoeff(), -padding + 1e-14);
        EXPECT_GT(aligned.exteriorDistance(x), -1e-14);
        EXPECT_TRUE(aligned.contains(x));
      }
    }
  }
}

/// Inclined needles do not overlap although their axis-aligned boxes do.
TEST(OrientedBox, SeparatesInclinedNeedles) {
  OrientedBox needle;
  needle.axes = Eigen::AngleAxisd(0.25 * std::numbers::pi, Vec3::UnitY()).toRotationMatrix();
  needle.half_sizes = Vec3(1.0, 0.01, 0.01);
  OrientedBox other = needle;
  for (const double distance : {0.0199, 0.0201, 0.5}) {
    other.center = distance * needle.axes.col(2);
    EXPECT_TRUE(bounding_box(needle).intersects(bounding_box(other))) << distance;
    EXPECT_EQ(overlap(needle, other), distance < 0.02) << distance;
  }
}

/// Two boxes with a common point overlap, also far from the origin.
TEST(OrientedBox, FindsEveryTouchingPair) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int k = 0; k < 1000; ++k) {
    const auto box_through = [&](const Vec3& point) {
      OrientedBox box;
      box.axes = some_pose(&random).q_WB.toRotationMatrix();
      box.half_sizes = Vec3(uniform(random), uniform(random), uniform(random)).cwiseAbs();
      Vec3 within(uniform(random), uniform(random), uniform(random));
      within[k % 3] = k % 2 == 0 ? 1.0 : -1.0;  // on a face
      box.center = point - box.axes * within.cwiseProduct(box.half_sizes);
      return box;
    };
    const Vec3 point = 1e3 * some_pose(&random).p_WB;
    EXPECT_TRUE(overlap(box_through(point), box_through(point)));
  }
}

}  // namespace
}  // namespace cupola::box_test
