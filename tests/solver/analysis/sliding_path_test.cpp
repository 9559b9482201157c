// Joints that slide along a path.
#include <cmath>

#include "tests/solver/analysis/path_run.hpp"

namespace cupola::path_test {
namespace {

constexpr double kFriction = 0.6, kSlip = 5e-3;  // m

Case sliding_case(int steps) {
  Case scene = testing::make_case(kFriction, 0.0, 0.01);
  scene.joints.compliance = {1e-9, 1e-9, Compliance::Per::area};
  scene.contact.subdivide = 2;
  scene.analysis.type = AnalysisType::path;
  scene.analysis.tolerance = 1e-7;
  scene.analysis.path.steps = steps;
  return scene;
}

// A block between a floor and a plate, which presses it by 0.1 mm and then moves along by 5 mm. Under the
// associated law its joint opens by friction times slip, which the floor and the plate prevent: statics press
// it with a hundred times as much. A path that forgets the opening of each step ends at the force of Coulomb's
// law; its geometry is that of its steps, which changes the force by 0.3 %.
TEST(SlidingPath, DilatesByTheSameInAnyNumberOfSteps) {
  const Assembly pressed =
      testing::make_boxes({{.center = {0, 0, -0.5}, .size = {4, 4, 1}, .fixed = true},
                           {.center = {0, 0, 0.1}, .size = {1, 1, 0.2}, .density = 2000},
                           {.center = {0, 0, 0.35}, .size = {2, 2, 0.3}, .fixed = true}});
  const auto force = [&](int steps, PathGeometry geometry) {
    Case scene = sliding_case(steps);
    scene.analysis.path.geometry = geometry;
    scene.analysis.path.control = LoadPath::Control{BlockRef{2}, {}, Vec3::UnitX()};
    scene.supports.moves = {
        {.region = {.blocks = {BlockRef{2}}}, .displacement = {0, 0, -1e-4}, .time = {}},
        {.region = {.blocks = {BlockRef{2}}}, .displacement = {kSlip, 0, 0}, .time = RampInTime{}}};
    const PathResult path = run(scene, pressed);
    EXPECT_EQ(path.summary.status, Status::stable) << path.summary.message;
    return path.rows.back()[2];
  };
  const double at_once = force(1, PathGeometry::start);
  EXPECT_GT(at_once, 6e5) << "N; 2.9e4 N under Coulomb's law";
  for (const int steps : {10, 40}) EXPECT_NEAR(force(steps, PathGeometry::start), at_once, 0.005 * at_once);
  EXPECT_NEAR(force(10, PathGeometry::end), at_once, 0.005 * at_once);
}

// The ground of a block that is held moves under it, along both of its sides, and the block turns by rounding:
// their overlap is no parallelogram any more and gets 29 points for 13. All of them have slipped, so that the
// joint bears friction times weight. The pressure moves with the overlap; points at which it grows reach their
// limit only in further slip, which leaves 4 % of the force.
TEST(SlidingPath, KeepsItsShearWhenTheJointGetsMorePoints) {
  const Assembly cube = testing::make_boxes({{.center = {0, 0, -0.25}, .size = {1, 1, 0.5}, .fixed = true},
                                             {.center = {0, 0, 0.25}, .size = {1, 1, 0.5}, .density = 2000}});
  Case scene = sliding_case(1);
  scene.analysis.friction_law = FrictionLaw::coulomb;
  scene.analysis.path.geometry = PathGeometry::end;
  scene.analysis.path.control = LoadPath::Control{BlockRef{0}, {}, Vec3::UnitX()};
  scene.contact.margin = 0.05;
  const Vec3 moved(0.02236, 0.01118, 0);
  scene.supports.moves = {{.region = {.blocks = {BlockRef{0}}}, .displacement = moved, .time = RampInTime{}}};
  scene.supports.restraints = {{BlockRef{1}, Vec3(0, 0, 0), Vec3::UnitX()},
                               {BlockRef{1}, Vec3(0, 0.5, 0), Vec3::UnitY()},
                               {BlockRef{1}, Vec3(0.5, 0, 0), Vec3::UnitY()}};
  const PathResult path = run(scene, cube);
  ASSERT_EQ(path.summary.status, Status::stable) << path.summary.message;
  EXPECT_GT(path.frames.back().contacts.size(), path.frames.front().contacts.size());
  const double expected = kFriction * free_weight(cube, testing::kG) * moved.normalized().x();
  EXPECT_NEAR(path.rows.back()[2], expected, 0.05 * expected);
}

}  // namespace
}  // namespace cupola::path_test
