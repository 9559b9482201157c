// Loads that a case gives by course or by place, and moments, in a static model.

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/model/applied_loads.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/solver/scenes.hpp"

namespace cupola {
namespace {

/// Ground, and two courses of two blocks of unequal size.
Assembly two_courses() {
  return testing::make_boxes({{.center = {0, 0, -0.5}, .size = {8, 2, 1}, .fixed = true, .ring = -1},
                              {.center = {-1, 0, 0.5}, .size = {2, 1, 1}, .ring = 0},
                              {.center = {1, 0, 0.5}, .size = {2, 1, 1}, .ring = 0},
                              {.center = {-1.5, 0, 1.5}, .size = {1, 1, 1}, .ring = 1},
                              {.center = {0.5, 0, 1.5}, .size = {3, 1, 1}, .ring = 1}});
}

TEST(SharedLoads, ACourseSharesAForceByVolume) {
  Loads loads;
  loads.forces = {{.block = 0,
                   .point = {},
                   .force = {0, 0, -8.0},
                   .time = {},
                   .moment = {},
                   .over = SharingBlocks{1, ""}}};
  const std::vector<PointForce> forces = applied_loads(loads, two_courses());
  ASSERT_EQ(forces.size(), 2u);
  EXPECT_EQ(forces[0].block, 3);
  EXPECT_NEAR(forces[0].force.z(), -2.0, 1e-15);
  EXPECT_EQ(forces[1].block, 4);
  EXPECT_NEAR(forces[1].force.z(), -6.0, 1e-15);
  loads.forces[0].over->course = 2;
  EXPECT_THROW(applied_loads(loads, two_courses()), InputError);
}

TEST(SharedLoads, APointChoosesTheBlockThatContainsItOrTheNearest) {
  const Assembly wall = two_courses();
  const auto block_at = [&wall](const Vec3& point) {
    Loads loads;
    loads.forces = {{.block = BlockForce::kAtPoint, .point = point, .force = {0, 0, -1.0}, .time = {}}};
    return applied_loads(loads, wall).at(0).block;
  };
  EXPECT_EQ(block_at({-0.9, 0, 1.5}), 4);
  EXPECT_EQ(block_at({-1.1, 0, 1.5}), 3);
  EXPECT_EQ(block_at({0.5, 0, 2.1}), 4) << "above the wall, by less than a tenth of the cube root of 3 m3";
  EXPECT_EQ(block_at({1.0, 0, -0.1}), 2) << "in the ground, which is fixed";
  try {
    block_at({0.5, 0, 2.2});
    ADD_FAILURE() << "a force in the air";
  } catch (const InputError& error) {
    EXPECT_NE(
        std::string(error.what()).find("lies in the air, 0.2 m beyond the faces of the nearest block, 4"),
        std::string::npos)
        << error.what();
  }
}

// A cube tips about its edge where the moment is its weight times half of its width.
TEST(SharedLoads, AMomentOverturnsABlock) {
  const Assembly cube =
      testing::make_boxes({{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true, .ring = -1},
                           {.center = {0, 0, 0.5}, .size = {1, 1, 1}}});
  Case scene;
  scene.joints.friction = 0.5;
  scene.joints.compliance = {1e-9, 1e-9, Compliance::Per::area};
  scene.analysis.type = AnalysisType::limit;
  scene.analysis.limit.parameter = LimitSearch::Parameter::load;
  scene.analysis.limit.low = 0.0;
  scene.analysis.limit.high = 2.0;
  const double weight = cube.blocks[1].mass * 9.81;
  scene.loads.forces = {
      {.block = 1, .point = {}, .force = Vec3::Zero(), .time = {}, .moment = Vec3(0, weight, 0)}};
  const std::optional<Summary> found = run_limit(scene, cube, {});
  ASSERT_TRUE(found && found->critical);
  EXPECT_NEAR(found->critical->value, 0.5, 1e-5) << "the default relative width of a direct limit";
}

}  // namespace
}  // namespace cupola
