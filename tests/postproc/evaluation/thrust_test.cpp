#include "postproc/evaluation/thrust.hpp"

#include <array>

#include <gtest/gtest.h>

#include "postproc/report/answers.hpp"
#include "postproc/tables/post_summary.hpp"

namespace cupola::thrust_test {
namespace {

/// Stones on two supports, without courses, about an axis or not.
Evaluation stones(Sheet::ThrustLines lines) {
  Evaluation e;
  e.assembly.sheets = {{.name = "blocks", .thrust_lines = lines}};
  e.reactions = {{.block = 0, .outward = 3e3}, {.block = 1, .outward = 4e3}};
  e.summary.status = Status::stable;
  e.summary.weight_N = 14e3;
  return e;
}

// As the range of the thrust, which needs an axis and no courses.
TEST(Thrust, OfStonesWithoutCoursesIsTheSumOverTheSupports) {
  const Evaluation e = stones(Sheet::ThrustLines::radial);
  EXPECT_EQ(outward_thrust(e), 7e3);
  const auto answer = thrust_answer(e);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->value, "7 kN");
  EXPECT_TRUE(
      answer->detail().starts_with("the sum over the supports; between 3 kN and 4 kN on each of 2 supports; "
                                   "0.5 of the weight"))
      << answer->detail();
}

// Supports under an upright drum take no thrust: rounding per metre, or over the weight, is none.
TEST(Thrust, ThatIsNegligibleHasNoDetails) {
  Evaluation e = stones(Sheet::ThrustLines::radial);
  for (Reaction& r : e.reactions) r.outward = 0.0;
  const auto answer = thrust_answer(e);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->value, "negligible");
  EXPECT_EQ(answer->detail().find("of the weight"), std::string::npos) << answer->detail();
}

// The stiffness of the joints chose nothing where a limit without a critical value shows a state that
// balances.
TEST(Thrust, OfAStateOfAConicSolverDependsOnNoStiffness) {
  Evaluation e = stones(Sheet::ThrustLines::radial);
  EXPECT_NE(thrust_answer(e)->detail().find("depends on the stiffness"), std::string::npos);
  e.scene.joints.strength.cohesion = 1e5;  // more states, none of which is certain
  EXPECT_NE(thrust_answer(e)->detail().find("depends on the stiffness"), std::string::npos);
  e.summary.forces_unique = {false, ForcesUnique::kOneOfMany};
  EXPECT_TRUE(
      thrust_answer(e)->detail().ends_with("of one of the admissible states: their range was not computed"))
      << thrust_answer(e)->detail();
  EXPECT_NE(certain_sentence(e).find("stiffness"), std::string::npos) << certain_sentence(e);
  e.summary.analysis = AnalysisType::limit;  // without a critical value
  EXPECT_EQ(certain_sentence(e).find("stiffness"), std::string::npos) << certain_sentence(e);
  EXPECT_EQ(post_summary(e).compliance_per, "none");
}

/// A joint at x that pushes on its lower block, of smaller number, along x.
JointWrench pushing(int lower, int upper, double x, double force) {
  JointWrench joint;
  joint.block_a = lower;
  joint.block_b = upper;
  joint.centroid = {x, 0, 0};
  joint.patch.plane.normal = Vec3::UnitX();
  joint.wrench.force = {-force, 0, 0};  // on the upper block
  return joint;
}

Block in_course(int ring) {
  Block block;
  block.ring = ring;
  block.fixed = ring < 0;
  return block;
}

/// Two half arches of two courses each, blocks 3 to 6, on a wall (block 1) at x > 0 and a support (block 0) at
/// x < 0, which lean on a rib, block 2.
Evaluation half_arches() {
  Evaluation e;
  for (const int ring : {-1, 0, 1, 2, 3, 4, 5}) e.assembly.blocks.push_back(in_course(ring));
  e.assembly.num_rings = 6;
  e.assembly.sheets = {
      {.name = "wall", .first_ring = 0, .num_rings = 1},
      {.name = "rib", .first_ring = 1, .num_rings = 1, .thrust_lines = Sheet::ThrustLines::one},
      {.name = "half ribs", .first_ring = 2, .num_rings = 4, .thrust_lines = Sheet::ThrustLines::one}};
  e.last.joints.wrenches = {pushing(1, 3, 2.0, 10.0),   // springing on the wall
                            pushing(3, 4, 1.0, 7.0),    // within the arch
                            pushing(2, 4, 0.1, -20.0),  // crown on the rib
                            pushing(2, 5, -0.1, 21.0),  // and of the other half
                            pushing(5, 6, -1.0, -7.0),
                            pushing(0, 6, -2.0, -9.0)};  // springing on the support
  e.rings.resize(6);
  e.rings[2].blocks = 1;
  return e;
}

// A crown that leans on another member is no springing: the push of each side is that of its feet.
TEST(Thrust, OfBothSidesIsThatOfTheSpringings) {
  const Evaluation e = half_arches();
  const std::vector<Thrust> thrusts = thrusts_of(e, e.assembly.sheets.back());
  ASSERT_EQ(thrusts.size(), 2u);
  EXPECT_EQ(thrusts[0].force, 10.0);
  EXPECT_EQ(thrusts[1].force, 9.0);
  EXPECT_EQ(thrusts[1].towards, Vec3(-1, 0, 0));
  EXPECT_EQ(outward_thrust(e), 10.0);
}

TEST(Thrust, IsThatOfWhatStands) {
  Evaluation e = half_arches();
  e.assembly.blocks.push_back(in_course(6));
  e.assembly.num_rings = 7;
  e.assembly.sheets.push_back(
      {.name = "fallen", .first_ring = 6, .num_rings = 1, .thrust_lines = Sheet::ThrustLines::one});
  e.rings.resize(7);
  EXPECT_EQ(outward_thrust(e), 10.0);
}

// Heads that meet in a mitre lean on each other: neither member stands on the other.
TEST(Thrust, CountsNoMitre) {
  Evaluation e = half_arches();
  JointWrench& joint = e.last.joints.wrenches.emplace_back(pushing(2, 3, 1.8, -3.0));
  const Vec3 level = joint.patch.plane.normal;
  EXPECT_EQ(outward_thrust(e), 10.0) << "a springer of another arch beside it";
  joint.patch.plane.normal = Vec3(3, 0, 4) / 5.0;
  EXPECT_EQ(outward_thrust(e), 9.0) << "a rib under the springing";
  joint.patch.plane.normal = level;
  joint.kind = JointKind::head;
  EXPECT_EQ(outward_thrust(e), 10.0);
}

// Skewbacks are heads of the abutments, on which an arch leans, and walls stand on an arch.
TEST(Thrust, CountsSkewbacksAndNoWallAbove) {
  Evaluation e = half_arches();
  e.assembly.blocks[3].centroid = {1.8, 0, 0.3};  // over the wall and beside the rib
  JointWrench& joint = e.last.joints.wrenches.front();
  joint.kind = JointKind::head;
  joint.patch.plane.normal = Vec3(-3, 0, -4) / 5.0;
  EXPECT_EQ(outward_thrust(e), 10.0);
  e.assembly.blocks[2].centroid = {1.8, 0, 1.0};  // as a wall, over the springer
  e.last.joints.wrenches.push_back(pushing(2, 3, 1.8, 5.0));
  e.last.joints.wrenches.back().patch.plane.normal = Vec3::UnitZ();
  EXPECT_EQ(outward_thrust(e), 10.0);
}

// Walls that hold the edges of a vault are fixed blocks beside its higher courses.
TEST(Thrust, CountsSupportsOfEveryCourse) {
  Evaluation e;
  for (const int ring : {-1, -1, 0, 1}) e.assembly.blocks.push_back(in_course(ring));
  e.assembly.num_rings = 2;
  e.assembly.sheets = {{.name = "vault", .num_rings = 2, .thrust_lines = Sheet::ThrustLines::by_azimuth}};
  e.last.joints.wrenches = {pushing(0, 2, 3.0, -2.0), pushing(1, 3, 2.0, 50.0), pushing(2, 3, 2.5, 8.0)};
  e.rings.resize(2);
  e.rings[0].blocks = 1;
  EXPECT_EQ(outward_thrust(e), 48.0);
  e.summary.status = Status::stable;
  e.summary.weight_N = 100.0;
  EXPECT_NE(thrust_answer(e).value().detail().find("m, and at supports of higher courses"), std::string::npos)
      << thrust_answer(e)->detail();
  // The first course is upright, the second leans: of its ring sum, one support takes an unknown share.
  e.assembly.vertices = {{0, 0, 0}, {0, 1, 0}, {1, 0, 1}};
  e.assembly.parts = {{.block = 3, .ring = 1}};
  e.assembly.add_face(std::array{0, 1, 2}, FaceKind::intrados);
  EXPECT_EQ(thrust_answer(e)->detail().find("at the springing"), std::string::npos)
      << thrust_answer(e)->detail();
  EXPECT_NE(thrust_answer(e)->detail().find("at the base, z = 0 m, and at supports of higher courses"),
            std::string::npos)
      << thrust_answer(e)->detail();
}

// A rib stands on one of the two supports of its vault. Those of the vault are both, of its joints alone.
TEST(Thrust, OfASharedSupportIsThatOfEachMember) {
  Evaluation e;
  for (const int ring : {-1, -1, 0, 1}) e.assembly.blocks.push_back(in_course(ring));
  e.assembly.num_rings = 2;
  using enum Sheet::ThrustLines;
  e.assembly.sheets = {{.name = "rib", .num_rings = 1, .thrust_lines = by_azimuth},
                       {.name = "vault", .first_ring = 1, .num_rings = 1, .thrust_lines = by_azimuth}};
  e.last.joints.wrenches = {pushing(0, 2, 3.0, 2.0), pushing(0, 3, 3.0, 5.0), pushing(1, 3, 3.0, 6.0)};
  const std::vector<Thrust> thrusts = thrusts_of(e, e.assembly.sheets.back());
  ASSERT_EQ(thrusts.size(), 1u);
  EXPECT_EQ(thrusts[0].force, 11.0);
  ASSERT_EQ(thrusts[0].supports.size(), 2u);
  EXPECT_EQ(thrusts[0].supports[0].outward, 5.0);
  EXPECT_EQ(thrusts[0].supports[1].outward, 6.0);
  EXPECT_EQ(thrusts_of(e, e.assembly.sheets.front()).at(0).supports.size(), 1u);
}

// Cuts have left no stone of the first course of a sail vault, as its springing lies outside its walls.
TEST(Thrust, IsThatOfTheLowestCourseThatWasBuilt) {
  Evaluation e;
  for (const int ring : {-1, 1}) e.assembly.blocks.push_back(in_course(ring));
  e.assembly.num_rings = 2;
  e.assembly.sheets = {{.name = "vault", .num_rings = 2, .thrust_lines = Sheet::ThrustLines::by_azimuth}};
  e.last.joints.wrenches = {pushing(0, 1, 3.0, 5.0)};
  e.rings.resize(2);
  e.rings[1].blocks = 1;
  EXPECT_EQ(outward_thrust(e), 5.0);
  e.summary.status = Status::stable;
  EXPECT_EQ(thrust_answer(e).value().detail().find("of higher courses"), std::string::npos);
}

TEST(Thrust, NeedsAnAxis) {
  EXPECT_FALSE(outward_thrust(stones(Sheet::ThrustLines::none)));
  Evaluation e = stones(Sheet::ThrustLines::none);
  e.assembly.sheets.clear();
  EXPECT_FALSE(outward_thrust(e));
}

}  // namespace
}  // namespace cupola::thrust_test
