#include "tests/solver/analysis/path_run.hpp"

// Steps of a path so long that their linear geometry says little of where they end.

namespace cupola::path_test {
namespace {

Case long_step_case(double friction, int steps) {
  Case scene = testing::make_case(friction, 1e-9, 0.01);
  scene.analysis.type = AnalysisType::path;
  scene.analysis.friction_law = FrictionLaw::coulomb;
  scene.analysis.tolerance = 1e-9;
  scene.analysis.path.steps = steps;
  return scene;
}

// A block pushed over by a force beside its middle. Cracks that bear after one solve pull after the next.
TEST(LongStep, NoticesThatCracksComeBackToAnEarlierState) {
  const Assembly block = testing::box_on_floor({0.8, 1, 0.7}, 2000);
  Case scene = long_step_case(0.3, 1);
  scene.joints.compliance = {1e-11, 1e-11, Compliance::Per::area};
  scene.joints.strength = {1e4, 100.0};
  scene.analysis.tolerance = 1e-8;
  scene.loads.forces = {{BlockRef{1}, Vec3(0, 0.3, 0.7), Vec3(-3708, 0, 0), RampInTime{}}};
  const std::string message = run(scene, block).summary.message;
  EXPECT_NE(message.find("came back to what it was before after 2 solves"), std::string::npos) << message;
}

}  // namespace
}  // namespace cupola::path_test
