// A plane scene stays in its plane along a path, although nothing holds it there.
#include <cmath>

#include "tests/solver/analysis/path_run.hpp"

namespace cupola::path_test {
namespace {

// Two halves of a wall, t = 0.11 m thick and h = 1.5 m high, its head held across and free to rise, pushed at
// mid-height (cases/wall_griffith.yaml). The load lies out of the middle plane by what counts as rounding. A
// static step takes up to an hour: without a hold, that turns the blocks by 1e-7 rad, the points of a joint
// across the plane are no longer one, and the residual of the path stalls at 3 %.
TEST(PlanePath, RoundedLoadsDoNotTurnBlocksOutOfTheirPlane) {
  constexpr double kT = 0.11, kH = 1.5, kWidth = 0.95;
  const Assembly wall = testing::make_boxes(
      {{.center = {0, 0.5 * kWidth, -0.5}, .size = {2, kWidth, 1}, .fixed = true},
       {.center = {0, 0.5 * kWidth, 0.25 * kH}, .size = {kT, kWidth, 0.5 * kH}, .density = 1800, .ring = 0},
       {.center = {0, 0.5 * kWidth, 0.75 * kH}, .size = {kT, kWidth, 0.5 * kH}, .density = 1800, .ring = 1}});
  const double weight = free_weight(wall, testing::kG);
  Case scene = testing::make_case(0.7, 0.0, 0.01);
  scene.joints.compliance = {1e-10, 1e-10, Compliance::Per::area};
  scene.contact.subdivide = 16;
  scene.analysis.type = AnalysisType::path;
  scene.analysis.tolerance = 1e-8;
  scene.analysis.plane = true;
  scene.analysis.path.steps = 60;
  scene.analysis.path.length = 0.03;
  scene.analysis.path.control = LoadPath::Control{BlockRef{1}, {}, Vec3::UnitX()};
  BlockForce load;
  load.block = BlockRef{1};
  load.point = Vec3(0.5 * kT, 0.5 * kWidth + 1e-10, 0.5 * kH);
  load.force = {weight, 0, 0};
  load.time = RampInTime{};
  scene.loads.forces = {load};
  scene.supports.restraints = {{BlockRef{2}, Vec3(0.5 * kT, 0.5 * kWidth, kH), Vec3::UnitX()}};
  const PathResult path = run(scene, wall);
  ASSERT_EQ(path.rows.size(), 61u) << path.summary.message;
  EXPECT_EQ(path.frames.back().blocks.displacement[1].y(), 0.0);
  const double moved = 2.0 * path.rows.back()[1] / kT;  // at mid-height, over the thickness
  // The joints bear on a strip, not on an edge, and the geometry is that of the step before:
  // docs/experiments.md.
  EXPECT_NEAR(path.rows.back()[0], 2.0 * kT / kH * (1.0 - moved), 0.03 * 2.0 * kT / kH);
}

// Coordinates of 5e6 m are multiples of 9e-10 m, and the centroid lies on one of them, although the width of
// these piers is an odd number of them. What is off by more than 16, 1.9e-8 m, is not plane.
TEST(PlaneScene, MayLieAtMapCoordinates) {
  constexpr double kX = 400000.77, kY = 5300000.91, kEnd = 5300001.0;
  Case scene = testing::make_case(0.7, 0.0, 0.01);
  scene.analysis.plane = true;
  for (int i = 0; i < 20; ++i) {
    const double width = 0.37 + 0.001 * i;
    Assembly pier = testing::make_boxes({{.center = {kX, kY, 431.5}, .size = {0.8, width, 1}, .fixed = true},
                                         {.center = {kX, kY, 432.3}, .size = {0.5, width, 0.6}}});
    for (Vec3& corner : pier.vertices)
      if (corner.y() > kY) corner.y() = std::nextafter(corner.y(), kEnd);
    compute_mass_properties(&pier);
    EXPECT_NO_THROW(make_model(scene, pier)) << width;
    pier.vertices.back().y() += 1e-6;
    EXPECT_THROW(make_model(scene, pier), InputError) << width;
  }
}

}  // namespace
}  // namespace cupola::path_test
