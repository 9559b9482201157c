// Scenes that rigid analyses refuse.

#include "solver/analysis/admissible/rigid_scene.hpp"

#include <gtest/gtest.h>

#include "tests/solver/motion_scenes.hpp"

namespace cupola::rigid_scene_test {
namespace {

// Only a limit has another method.
TEST(RigidScene, CohesionWithoutFrictionIsRefusedWithAdviceThatHelps) {
  Case scene = testing::make_case(0.0, 1e-8, 0.01);
  scene.geometry.surface = WallSurface{};
  scene.joints.compliance.per = Compliance::Per::area;
  scene.joints.strength.cohesion = 1e5;
  const Assembly assembly = testing::box_on_floor({1.0, 1.0, 1.0});
  const auto refusal = [&](AnalysisType type) {
    scene.analysis.type = type;
    try {
      rigid_scene(scene, std::make_shared<const Assembly>(assembly));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string range = refusal(AnalysisType::range);
  EXPECT_TRUE(range.ends_with("give joints.friction")) << range;
  EXPECT_EQ(refusal(AnalysisType::limit), range + ", or analysis.limit.method: bisection");
  scene.analysis.limit.parameter = LimitSearch::Parameter::joint_extent;
  EXPECT_EQ(refusal(AnalysisType::limit), range) << "which bisection does not apply to";
  scene.joints.friction = 0.4;
  scene.joints.base.emplace();
  scene.joints.base->friction = 0.0;
  const std::string of_class = refusal(AnalysisType::range);
  EXPECT_TRUE(of_class.ends_with("give joints.base.friction")) << of_class;
}

}  // namespace
}  // namespace cupola::rigid_scene_test
