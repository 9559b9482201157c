#include "solver/dynamics/weak_joints.hpp"

#include <gtest/gtest.h>

#include "tests/solver/motion_scenes.hpp"

namespace cupola::weak_joints_test {
namespace {

// A cube of 1 m and 1000 kg/m3 presses on its bed with 9810 Pa.
TEST(WeakJoints, AreReportedIfTheyCannotCarryTheWeight) {
  const Assembly assembly = testing::box_on_floor({1, 1, 1});
  Case scene = testing::make_case(0.5, 1e-10, 0.01);
  scene.joints.compliance = {1e-10, 1e-10, Compliance::Per::area};
  const auto warnings = [&] {
    const ContactSet contacts =
        ContactDetector(assembly, detection_options(scene)).update(initial_poses(assembly));
    return weak_joints(scene, assembly, contacts);
  };
  EXPECT_TRUE(warnings().empty()) << "dry";
  scene.joints.strength.compression = 9900.0;
  EXPECT_TRUE(warnings().empty());
  scene.joints.strength.compression = 9700.0;
  ASSERT_EQ(warnings().size(), 1u);
  EXPECT_NE(warnings()[0].find("9.81e+03 Pa on average, more than the compressive strength of 9.7e+03 Pa"),
            std::string::npos)
      << warnings()[0];
}

}  // namespace
}  // namespace cupola::weak_joints_test
