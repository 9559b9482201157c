// Frames say where the blocks stood when their contacts were found: there the forces balance, and there the
// contact points lie on the blocks.
#include "tests/solver/analysis/path_run.hpp"

namespace cupola::contact_poses_test {
namespace {

/// m, the contact point of a frame that lies foremost on block 1, in the axes of the block as built.
double foremost(const Frame& frame) {
  const BlockTable& blocks = frame.blocks;
  const Eigen::Vector4d& q = blocks.contact_quaternion_wxyz[1];
  const Eigen::Quaterniond back = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate();
  double x = -1.0;
  for (const Vec3& point : frame.contacts.point)
    x = std::max(x, (back * (point - blocks.contact_position[1])).x());
  return x;
}

// Without `geometry: end`, the contacts of an equilibrium are those of the one before, and so is a tie.
TEST(ContactPoses, OfAPathAreThoseOfTheFrameBefore) {
  Case scene = path_test::couplet_case(3);
  scene.supports.moves.push_back(
      {.region = {.blocks = {BlockRef{3}}}, .displacement = {0, 0, 2e-6}, .time = RampInTime{}});
  PairTie tie;
  tie.block_a = BlockRef{0};
  tie.block_b = BlockRef{2};
  tie.point_a = {1, 0, 0};
  tie.point_b = {0.5, 0, 0.3};
  tie.stiffness = 1e8;
  scene.ties.pairs = {tie};
  for (const PathGeometry geometry : {PathGeometry::start, PathGeometry::end}) {
    scene.analysis.path.geometry = geometry;
    const path_test::PathResult path = path_test::run(scene, path_test::couplet());
    ASSERT_EQ(path.frames.size(), 4u) << path.summary.message;
    for (size_t k = 1; k < path.frames.size(); ++k) {
      const Frame &frame = path.frames[k], &before = path.frames[k - 1];
      const bool at_end = geometry == PathGeometry::end;
      EXPECT_GT((frame.blocks.position[3] - before.blocks.position[3]).norm(), 6e-7);
      const Vec3& then = (at_end ? frame : before).blocks.position[3];
      EXPECT_NEAR((frame.blocks.contact_position[3] - then).norm(), 0.0, at_end ? 1e-8 : 0.0);
      const Eigen::Vector4d& q = frame.blocks.contact_quaternion_wxyz[2];
      const Vec3 end =
          frame.blocks.contact_position[2] + Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * Vec3(0.5, 0, 0);
      EXPECT_NEAR((frame.ties.point_b[0] - end).norm(), 0.0, 1e-14);
    }
  }
}

// A block that slides: at the end of each step its contact points trail it by 2 to 40 mm.
TEST(ContactPoses, OfAMotionHaveTheContactsOnTheirBlocks) {
  for (const TimeIntegrator integrator : {TimeIntegrator::euler, TimeIntegrator::generalized_alpha}) {
    Case scene = testing::make_case(0.2, 1e-10, 0.02);
    scene.loads.gravity = testing::tilted_gravity(1.0);
    scene.analysis.duration = 0.3;
    scene.output.frames_every = 0.02;
    scene.analysis.integrator = integrator;
    std::vector<Frame> frames;
    AnalysisSinks sinks;
    sinks.frame = [&](const Frame& frame) { frames.push_back(frame); };
    run_dynamic(scene, testing::box_on_floor({1.0, 0.5, 0.2}), sinks);
    ASSERT_GT(frames.size(), 5u);
    EXPECT_GT((frames.back().blocks.position[1] - frames.back().blocks.contact_position[1]).norm(), 2e-3);
    for (const Frame& frame : frames) EXPECT_NEAR(foremost(frame), foremost(frames.front()), 1e-6);
  }
}

}  // namespace
}  // namespace cupola::contact_poses_test
