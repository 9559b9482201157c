#include <gtest/gtest.h>

#include "solver/analysis/analysis.hpp"
#include "tests/solver/scenes.hpp"

namespace cupola::winkler_test {
namespace {

// A block on a bed of area compliance c (m3/N) under a horizontal load. The resultant stays inside the kern,
// so that no point opens and the bed is a Winkler foundation. The settlement is c W / A; the centroid moves
// sideways by
//
//     c_t T / A + theta H / 2,    theta = c M / I,    M = T H / 2,    I = depth width^3 / 12
TEST(Winkler, SettlementAndTiltAgreeWithTheClosedForm) {
  const double width = 1.2, depth = 0.7, H = 0.9;
  const Assembly assembly = testing::box_on_floor({width, depth, H});
  const double c = 2e-9, c_t = 3e-9;
  for (const double sideways : {0.0, 0.5, 2.0}) {  // of 9.81 m/s2; eccentricity 0.09 m < width / 6
    Case scene;
    scene.joints.friction = 0.4;
    scene.joints.compliance = {c, c_t, Compliance::Per::area};
    scene.loads.gravity = {sideways, 0.0, -9.81};
    scene.analysis.tolerance = 1e-11;
    Frame frame;
    AnalysisSinks sinks;
    sinks.frame = [&frame](const Frame& f) { frame = f; };
    const Summary summary = run_static(scene, assembly, sinks);
    ASSERT_EQ(summary.status, Status::stable) << summary.message;

    const double A = width * depth, I = depth * width * width * width / 12.0;
    const double W = assembly.blocks[1].mass * 9.81, T = assembly.blocks[1].mass * sideways;
    const double theta = c * (T * H / 2.0) / I;
    const Vec3 moved = frame.blocks.displacement[1];
    EXPECT_NEAR(-moved.z() / (c * W / A), 1.0, 1e-9) << sideways;
    if (sideways > 0.0) {
      EXPECT_NEAR(moved.x() / (c_t * T / A + theta * H / 2.0), 1.0, 1e-9) << sideways;
    }
  }
}

}  // namespace
}  // namespace cupola::winkler_test
