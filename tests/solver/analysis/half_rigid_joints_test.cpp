// Joints that are rigid along and give way across, or the reverse, in statics and along paths under both laws,
// against closed forms.
#include <gtest/gtest.h>

#include "solver/analysis/analysis.hpp"
#include "tests/solver/analysis/path_run.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::half_rigid_joints_test {
namespace {

constexpr FrictionLaw kBothLaws[] = {FrictionLaw::associated, FrictionLaw::coulomb};

/// A force along x on the centroid of the last block.
Case pushed(const Assembly& assembly, const Compliance& compliance, FrictionLaw law, double force,
            AnalysisType type) {
  Case scene = testing::make_case(0.5, 0.0, 0.01);
  scene.joints.compliance = compliance;
  scene.analysis.type = type;
  scene.analysis.friction_law = law;
  scene.analysis.tolerance = 1e-9;
  BlockForce load;
  load.block.number = static_cast<int>(assembly.blocks.size()) - 1;
  load.force = {force, 0, 0};
  if (type == AnalysisType::path) load.time = RampInTime{};
  scene.loads.forces = {load};
  return scene;
}

struct Result {
  Summary summary;
  Vec3 displacement = Vec3::Zero();  ///< m, of the last block at the end
};

Result run(Case scene, const Assembly& assembly, int steps) {
  Result result;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { result.displacement = frame.blocks.displacement.back(); };
  if (steps == 0) {
    result.summary = run_static(scene, assembly, sinks);
  } else {
    scene.analysis.path.steps = steps;
    const path_test::PathResult path = path_test::run(scene, assembly);
    result.summary = path.summary;
    if (!path.frames.empty()) result.displacement = path.frames.back().blocks.displacement.back();
  }
  return result;
}

AnalysisType type_of(int steps) {
  return steps == 0 ? AnalysisType::static_ : AnalysisType::path;
}

/// Three cubes of 1 m on each other.
Assembly tower() {
  return testing::stack_of_cubes(1.0, {2000.0, 2000.0, 2000.0});
}
constexpr double kCubeWeight = 2000.0 * testing::kG;  // N
constexpr double kSoft = 1e-9;                        // m3/N

// Each bed is pressed all over and turns by the moment c M / I, with I = 1/12. Joints give way along by 1e-4
// of c, which adds 3e-6 to x; along a path the tower leans, which adds 1e-3.
TEST(HalfRigidJoints, ATowerOnJointsRigidAlongTurnsByItsClosedForm) {
  const double push = 3000.0;
  const double x = kSoft * 12.0 * push * (2.5 * 2.5 + 1.5 * 1.5 + 0.5 * 0.5);
  const double z = -kSoft * kCubeWeight * (3 + 2 + 1);
  for (const FrictionLaw law : kBothLaws)
    for (const int steps : {0, 1, 2, 8}) {
      const Case scene = pushed(tower(), {kSoft, 0.0, Compliance::Per::area}, law, push, type_of(steps));
      const auto [summary, displacement] = run(scene, tower(), steps);
      const double tolerance = steps == 0 ? 1e-5 : 3e-3;
      EXPECT_EQ(summary.status, Status::stable) << summary.message;
      EXPECT_NEAR(displacement.x(), x, tolerance * x) << to_string(law) << ", steps " << steps;
      EXPECT_NEAR(displacement.z(), z, tolerance * -z) << to_string(law) << ", steps " << steps;
    }
}

// It would slide under 0.5 and overturn under 0.6 of the weight of a cube: "no equilibrium exists" at 0.1.
TEST(HalfRigidJoints, ATowerOnJointsRigidAlongBearsWhatItCan) {
  for (const FrictionLaw law : kBothLaws) {
    const Case scene =
        pushed(tower(), {kSoft, 0.0, Compliance::Per::area}, law, 0.3 * kCubeWeight, AnalysisType::path);
    const Summary summary = run(scene, tower(), 8).summary;
    EXPECT_EQ(summary.status, Status::stable) << to_string(law) << ": " << summary.message;
  }
}

/// A cube, drawn by `gap` above the floor.
Assembly cube(double gap) {
  return testing::make_boxes({{.center = {0, 0, -0.5}, .size = {4, 4, 1}, .fixed = true},
                              {.center = {0, 0, 0.5 + gap}, .density = 2000.0}});
}

// It moves by c F. The joint gives way across by 1e-4 of c, which turns it: 3e-4 of c F at its centroid.
TEST(HalfRigidJoints, ACubeOnAJointRigidAcrossMovesByItsSpring) {
  const double push = 3000.0, x = kSoft * push;
  for (const FrictionLaw law : kBothLaws)
    for (const double gap : {0.0, 1e-11, 1e-9, 1e-7})
      for (const int steps : {0, 1, 4}) {
        const Case scene = pushed(cube(gap), {0.0, kSoft, Compliance::Per::area}, law, push, type_of(steps));
        const auto [summary, displacement] = run(scene, cube(gap), steps);
        EXPECT_EQ(summary.status, Status::stable)
            << to_string(law) << ", gap " << gap << ", steps " << steps << ": " << summary.message;
        EXPECT_NEAR(displacement.x(), x, 5e-4 * x)
            << to_string(law) << ", gap " << gap << ", steps " << steps;
      }
}

}  // namespace
}  // namespace cupola::half_rigid_joints_test
