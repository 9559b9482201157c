#include "solver/dynamics/joints_on_supports.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/solver/motion_scenes.hpp"

namespace cupola::joints_on_supports_test {
namespace {

std::vector<std::string> warnings_of(const Case& scene, const Assembly& assembly, bool rigid = false) {
  return joint_warnings(scene, assembly,
                        ContactDetector(assembly, detection_options(scene)).update(initial_poses(assembly)),
                        rigid);
}

Case per_area(double normal) {
  Case scene;
  scene.joints.compliance = {normal, normal, Compliance::Per::area};
  return scene;
}

// Ten cubes of side s = 0.2 m: the joint under cube k from the top carries k rho g s, so that the top sinks
// by c rho g s (1 + ... + 10) = 55 c rho g s; 1 % of the height of 2 m at c = 1.85e-7 m3/N.
TEST(SoftJoints, WarnWhereTheTopOfAStackSinksByAHundredthOfItsHeight) {
  const Assembly stack = testing::stack_of_cubes(0.2, std::vector<double>(10, 1000.0));
  EXPECT_TRUE(warnings_of(per_area(1.8e-7), stack).empty());
  const std::vector<std::string> found = warnings_of(per_area(1.9e-7), stack);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].starts_with(
      "joints.compliance.normal = 1.9e-07 m3/N lets the model sink by about 0.021 m, 1 % of its height; "))
      << found[0];
  EXPECT_TRUE(warnings_of(per_area(0.0), stack).empty()) << "rigid joints";
  EXPECT_TRUE(warnings_of(per_area(1.9e-7), stack, true).empty()) << "an analysis without compliance";
}

// Four contact points carry each cube.
TEST(SoftJoints, CountThePointsOfCompliancePerPoint) {
  const Assembly stack = testing::stack_of_cubes(0.2, std::vector<double>(10, 1000.0));
  Case scene;
  const double limit = 0.02 / (55 * 1000.0 * 9.81 * 0.008) * 4.0;  // m/N
  scene.joints.compliance.normal = 0.98 * limit;
  EXPECT_TRUE(warnings_of(scene, stack).empty());
  scene.joints.compliance.normal = 1.02 * limit;
  EXPECT_EQ(warnings_of(scene, stack).size(), 1u);
  scene.joints.compliance.normal = 0.98 * limit;
  scene.loads.forces.resize(1);
  scene.loads.forces[0].block = 10;
  scene.loads.forces[0].force = Vec3(0, 0, -100.0);  // an eighth of the weight
  EXPECT_EQ(warnings_of(scene, stack).size(), 1u) << "loads count";
}

// A wall of 2 m under ten times its weight.
TEST(SoftJoints, AreNotTheDefaults) {
  const Assembly wall = testing::running_bond_wall(Vec3(0.4, 0.3, 0.1), 5, 20);
  for (const Compliance::Per per : {Compliance::Per::point, Compliance::Per::area}) {
    Case scene;
    scene.joints.compliance = Compliance::default_per(per);
    scene.loads.gravity *= 11.0;
    EXPECT_TRUE(warnings_of(scene, wall).empty()) << to_string(per);
  }
}

// A cube of 1 m and 1000 kg/m3 presses on its bed with 9810 Pa.
TEST(WeakJoints, AreReportedIfTheyCannotCarryTheWeight) {
  const Assembly assembly = testing::box_on_floor({1, 1, 1});
  for (const double compliance : {1e-10, 0.0}) {
    Case scene = per_area(compliance);
    EXPECT_TRUE(warnings_of(scene, assembly).empty()) << "dry";
    scene.joints.strength.compression = 9900.0;
    EXPECT_TRUE(warnings_of(scene, assembly).empty());
    scene.joints.strength.compression = 9700.0;
    const std::vector<std::string> found = warnings_of(scene, assembly);
    ASSERT_EQ(found.size(), 1u) << compliance;
    EXPECT_NE(found[0].find("9.81e+03 Pa on average, more than the compressive strength of 9.7e+03 Pa"),
              std::string::npos)
        << found[0];
  }
}

// Against 1e6 N/m2 a force of 1e7 N counts as far as it acts within the analysis: at the time 0, on a path and
// in a motion until they end, and not where a limit multiplies it.
TEST(WeakJoints, CountLoadsThatAct) {
  const Assembly assembly = testing::box_on_floor({1, 1, 1});
  Case scene = per_area(1e-10);
  scene.joints.strength.compression = 1e6;
  scene.loads.forces = {{.block = 1, .point = {}, .force = {0, 0, -1e7}, .time = {}}};
  const auto count = [&](AnalysisType type, TimeFunction time) {
    scene.analysis.type = type;
    scene.loads.forces[0].time = std::move(time);
    return warnings_of(scene, assembly).size();
  };
  using enum AnalysisType;
  scene.analysis.path.end = scene.analysis.duration = 1.0;  // s
  const RampInTime late{0.0, 1.0, 2.0, 1.0}, part{0.0, 0.05, 0.0, 1.0}, full{0.0, 1.0, 0.0, 1.0};
  const TableInTime peak{"", {0.0, 0.5, 1.0}, {0.0, 1.0, 0.0}};
  EXPECT_EQ(count(static_, {}), 1u);
  EXPECT_EQ(count(static_, full), 0u);
  for (const AnalysisType type : {path, dynamic}) {
    EXPECT_EQ(count(type, late), 0u) << to_string(type);
    EXPECT_EQ(count(type, part), 0u) << to_string(type);
    EXPECT_EQ(count(type, full), 1u) << to_string(type);
    EXPECT_EQ(count(type, peak), 1u) << to_string(type);
  }
  scene.analysis.limit.parameter = LimitSearch::Parameter::load;
  EXPECT_EQ(count(limit, {}), 0u);
  scene.analysis.limit.parameter = LimitSearch::Parameter::friction;
  EXPECT_EQ(count(limit, {}), 1u);
}

// A cube on the edge of another has no area that could be crushed.
TEST(EdgesOfStrongJoints, AreNotLimitedAndSaidToBeSo) {
  const Eigen::Quaterniond on_edge(Eigen::AngleAxisd(0.25 * std::numbers::pi, Vec3::UnitY()));
  const Assembly cube = testing::make_boxes(
      {{.center = {0, 0, -std::sqrt(0.5)}, .fixed = true, .rotation = on_edge}, {.center = {0, 0, 0.5}}});
  Case scene = per_area(1e-10);
  EXPECT_TRUE(warnings_of(scene, cube).empty());
  scene.joints.strength.compression = 1e6;
  const std::vector<std::string> found = warnings_of(scene, cube);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].starts_with("the blocks of 1 joint, the first 0 and 1, touch at edges or corners"))
      << found[0];
  EXPECT_TRUE(warnings_of(scene, testing::box_on_floor({1, 1, 1})).empty());
}

// Two stacks of two cubes, courses 0 and 1, and 2 and 3.
TEST(LawsOfRings, AreSaidToSelectNoJoint) {
  std::vector<testing::BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {20, 20, 1}, .fixed = true}};
  for (int k = 0; k < 4; ++k) boxes.push_back({.center = {k < 2 ? 0.0 : 5.0, 0.0, 0.5 + k % 2}, .ring = k});
  Assembly stacks = testing::make_boxes(boxes);
  stacks.num_rings = 4;
  Case scene = per_area(1e-10);
  using enum RingJoints::Sort;
  scene.joints.rings = {{2, 3, base, {}}, {1, 1, all, {}}, {3, 3, base, {}}};
  scene.analysis.type = AnalysisType::limit;
  scene.analysis.limit.joints = RingJoints{1, kLastRing, head, {}};
  const std::vector<std::string> found = warnings_of(scene, stacks);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_TRUE(found[0].starts_with("joints.rings[2]: no joint of kind base belongs to rings 3 to 3, so"))
      << found[0];
  EXPECT_TRUE(found[1].starts_with("analysis.limit.joints: no joint of kind head belongs to rings 1 to 3,"))
      << found[1];
}

}  // namespace
}  // namespace cupola::joints_on_supports_test
