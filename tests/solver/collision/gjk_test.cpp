#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "solver/collision/contact_detector.hpp"
#include "tests/solver/scenes.hpp"

namespace cupola::gjk_test {
namespace {

using namespace testing;  // the scenes

std::vector<Plane> cube_planes(double half) {
  std::vector<Plane> planes;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) planes.push_back({side * Vec3::Unit(axis), half});
  return planes;
}

TEST(InsetPolytope, ShrinksACube) {
  const Polytope core = inset_polytope(cube_planes(1.0), 0.1, 1e-9);
  ASSERT_EQ(core.vertices.size(), 8u);
  ASSERT_EQ(core.faces.size(), 6u);
  for (const Vec3& x : core.vertices) EXPECT_LT((x.cwiseAbs() - Vec3::Constant(0.9)).norm(), 1e-14);
  for (const auto& face : core.faces) EXPECT_EQ(face.size(), 4u);
}

TEST(InsetPolytope, IsEmptyWhenTheInsetExceedsHalfTheThickness) {
  EXPECT_TRUE(inset_polytope(cube_planes(1.0), 1.0 + 1e-6, 1e-9).vertices.empty());
}

TEST(InsetPolytope, TruncatedCornerVanishesUnderALargeInset) {
  // A cube with one corner cut off, 0.2 along the diagonal.
  auto planes = cube_planes(1.0);
  const Vec3 diagonal = Vec3::Ones().normalized();
  planes.push_back({diagonal, std::sqrt(3.0) - 0.2});
  EXPECT_EQ(inset_polytope(planes, 0.0, 1e-9).vertices.size(), 10u);
  // The corner of the cube moves inwards by sqrt(3) times the inset, the cut only by the inset. The cut
  // vanishes at an inset of 0.2 / (sqrt 3 - 1) = 0.273.
  EXPECT_EQ(inset_polytope(planes, 0.2, 1e-9).vertices.size(), 10u);
  EXPECT_EQ(inset_polytope(planes, 0.28, 1e-9).vertices.size(), 8u);
}

TEST(ConvexBody, FindsTheNearestPointsOfTwoCubes) {
  const ConvexBody cube(inset_polytope(cube_planes(1.0), 0.0, 1e-9));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(M_PI / 4, Vec3::UnitY()).toRotationMatrix() *
                  Eigen::AngleAxisd(0.3, Vec3::UnitX()).toRotationMatrix();
  pose.translation() = Vec3(0.1, 0.2, 3.5);
  const auto nearest = cube.nearest_points(cube, pose);
  ASSERT_TRUE(nearest);
  double lowest = 1e300;  // a corner above a face: the distance is vertical
  for (const Vec3& x : inset_polytope(cube_planes(1.0), 0.0, 1e-9).vertices)
    lowest = std::min(lowest, (pose * x).z());
  EXPECT_NEAR((nearest->on_b - nearest->on_a).norm(), lowest - 1.0, 1e-9);
  EXPECT_FALSE(cube.nearest_points(cube, Eigen::Isometry3d::Identity()));
}

TEST(LargestPatch, ChoosesTheCornersOfASquare) {
  const std::vector<Vec2> points = {{0.5, 0.5}, {0, 0}, {0.4, 0.1}, {1, 0},
                                    {1, 1},     {0, 1}, {0.9, 0.9}, {1, 1}};
  const auto chosen = largest_patch(points, 4, 1e-3);
  EXPECT_EQ(chosen.size(), 4u);
  for (int i : chosen) {
    EXPECT_EQ(std::abs(points[i].x() - 0.5), 0.5);
    EXPECT_EQ(std::abs(points[i].y() - 0.5), 0.5);
  }
  EXPECT_EQ(std::set<int>(chosen.begin(), chosen.end()).size(), 4u);
  EXPECT_EQ(largest_patch(std::vector<Vec2>{{0, 0}, {1e-6, 0}}, 4, 1e-3).size(), 1u);
}

DetectionOptions perturbed(double margin, std::uint64_t seed = 1) {
  DetectionOptions options;
  options.perturbed_gjk = PerturbedGjkOptions{.margin = margin, .perturbations = 32, .seed = seed};
  return options;
}

// A box on the floor: four points near the corners, inset by the edge radius, with the gap of the faces.
TEST(PerturbedGjk, FindsTheCornersOfABox) {
  const double margin = 0.01;
  const Assembly scene = box_on_floor(Vec3(1, 2, 1));
  for (const double gap : {-0.015, 0.0, 0.004}) {
    auto poses = initial_poses(scene);
    poses[1].p_WB.z() += gap;
    const ContactSet set = ContactDetector(scene, perturbed(margin)).update(poses);
    ASSERT_EQ(set.points.size(), 4u) << gap;
    for (const Contact& contact : set.points) {
      EXPECT_EQ(set.patches[contact.patch].kind, JointKind::base);
      // The part is shrunk by the margin. A rotation by 0.01 moves a point at 1.2 m sideways by half its
      // square.
      EXPECT_NEAR(std::abs(contact.point_b.x()), 0.5 - margin, 1e-3);
      EXPECT_NEAR(std::abs(contact.point_b.y()), 1.0 - margin, 1e-3);
      EXPECT_LT((contact.normal - Vec3::UnitZ()).norm(), 0.011);  // of the perturbed query
      EXPECT_NEAR(contact.gap, gap, 2e-4);  // first order in the rotation and in the margin
    }
  }
}

TEST(PerturbedGjk, PointsDependOnTheSeedOnly) {
  const Assembly scene = running_bond_wall(Vec3(1.2, 1.0, 0.3), 3, 3);
  const auto contacts = [&](std::uint64_t seed) {
    return ContactDetector(scene, perturbed(0.002, seed)).update(initial_poses(scene)).points;
  };
  const auto first = contacts(1), again = contacts(1), other = contacts(2);
  ASSERT_EQ(first.size(), again.size());
  bool differs = first.size() != other.size();
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].point_a, again[i].point_a);
    EXPECT_EQ(first[i].gap, again[i].gap);
    if (!differs) differs = first[i].point_a != other[i].point_a;
  }
  EXPECT_TRUE(differs);
}

TEST(PerturbedGjk, FindsEveryJointOfAWall) {
  const Assembly scene = running_bond_wall(Vec3(1.2, 1.0, 0.3), 3, 4);
  const ContactSet exact = ContactDetector(scene, {}).update(initial_poses(scene));
  const ContactSet found = ContactDetector(scene, perturbed(0.002)).update(initial_poses(scene));
  std::set<std::pair<int, int>> expected, joints;
  for (const Patch& patch : exact.patches) expected.emplace(patch.block_a, patch.block_b);
  for (const Patch& patch : found.patches) joints.emplace(patch.block_a, patch.block_b);
  EXPECT_EQ(joints, expected);
}

TEST(PerturbedGjk, RejectsPartsThinnerThanTwiceTheMargin) {
  try {
    ContactDetector(box_on_floor(Vec3(1, 1, 0.1)), perturbed(0.06));
    FAIL() << "expected an InputError";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("block 1: a part is thinner"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace cupola::gjk_test
