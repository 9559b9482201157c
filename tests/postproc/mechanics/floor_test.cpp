// What is below the floor of a frame is no result: a joint with a rounding error has no utilisation.

#include "postproc/mechanics/floor.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "postproc/figures/plot_style.hpp"
#include "postproc/mechanics/joint_wrenches.hpp"
#include "postproc/tables/post_summary.hpp"
#include "postproc/tables/result_tables.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::floor_test {
namespace {

TEST(Floor, IsTheLargerOfAShareOfTheLargestForceAndTheUnbalancedForce) {
  const Floor by_share = floor_of(2e6, 1.0, 0.5);
  EXPECT_DOUBLE_EQ(by_share.force, 2.0) << "1e-6 of the largest joint force";
  EXPECT_DOUBLE_EQ(by_share.length, 0.5e-6);
  const Floor by_error = floor_of(2e6, 200.0, 0.5);
  EXPECT_DOUBLE_EQ(by_error.force, 200.0);
  EXPECT_DOUBLE_EQ(by_error.share, 1e-4);
  EXPECT_EQ(floor_of(0.0, 0.0, 0.5).force, 0.0) << "an unloaded model";
}

TEST(Floor, CoupleLengthNeedsAForceAboveIt) {
  const Floor floor = floor_of(1e6, 0.0, 1.0);  // 1 N, 1e-6 m
  const auto wrench = [](double force, double couple) {
    return Wrench{Vec3::Zero(), Vec3(0, 0, force), Vec3(0, 0, couple)};
  };
  EXPECT_TRUE(std::isnan(couple_length(wrench(1.0, 0.2), floor)));
  EXPECT_DOUBLE_EQ(couple_length(wrench(1.001, 0.2002), floor), 0.2);
  EXPECT_EQ(couple_length(wrench(1e3, 0.9e-3), floor), 0.0);
}

/// A column whose top joint carries `force` and slides, as rounding errors do.
Frame column_with_idle_top(const Assembly& a, double force) {
  Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.6, 0.4);
  ContactTable& c = frame.contacts;
  for (int i = 0; i < c.size(); ++i) {
    if (c.joint[i] != 2) continue;
    c.force[i] = Vec3(0.1 * force, 0.0, 0.25 * force);
    c.normal_force[i] = 0.25 * force;
    c.friction_use[i] = 1.0;
  }
  return frame;
}

TEST(Floor, JointsBelowItHaveNoUtilisationAndCountInNoExtreme) {
  const Assembly a = test::column(3);
  const double weight = free_weight(a, test::kGravity);  // on the base joint
  for (const double share : {0.9e-6, 1.2e-6}) {          // a hair below and above the floor of 1e-6
    const Evaluation e =
        test::evaluated(a, {column_with_idle_top(a, share * weight)}, test::column_summary(a),
                        test::column_case(), test::fresh_folder("results"));
    const JointWrench& top = e.last.joints.wrenches[2];
    const bool idle = share < 1e-6;
    EXPECT_EQ(top.negligible, idle);
    for (const double value : {top.friction_use, top.kern, top.couple_length, top.eccentricity})
      EXPECT_EQ(std::isnan(value), idle);
    EXPECT_EQ(std::isnan(e.last.fields[3].friction_use), idle) << "its only joint";
    EXPECT_EQ(e.last.fields[2].friction_use, idle ? 0.0 : 1.0);
    EXPECT_EQ(post_summary(e).largest_friction_use, idle ? 0.0 : 1.0);
    EXPECT_EQ(e.rings[2].largest_friction_use, idle ? 0.0 : 1.0);
  }
}

// The upper bed of two is pulled, and has no kern use; that of the lower one is 1.5.
TEST(Floor, JointsWithoutKernUseCountInNoMean) {
  const Assembly a = test::column(2);
  Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.9, 0.4);
  ContactTable& c = frame.contacts;
  for (int i = 0; i < c.size(); ++i) {
    if (c.joint[i] != 1) continue;
    c.force[i] = -c.force[i];
    c.normal_force[i] = -c.normal_force[i];
  }
  const Evaluation e = test::evaluated(a, {frame}, test::column_summary(a), test::column_case(),
                                       test::fresh_folder("results"));
  EXPECT_NEAR(post_summary(e).mean_kern_use.value(), 1.5, 1e-12) << "rounding";
}

// A slip of 8e-18 m is rounding: the floor of lengths is 1e-6 of a block.
TEST(Floor, SlipBelowItIsNoFinding) {
  const Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.6, 0.4);
  frame.contacts.slip[0] = 7.9e-18;
  frame.contacts.slip.back() = 1e-5;
  const Evaluation e = test::evaluated(a, {frame}, test::column_summary(a), test::column_case(),
                                       test::fresh_folder("results"));
  double least = 1.0, largest = 0.0;
  for (const JointWrench& joint : e.last.joints.wrenches) {
    least = std::min(least, joint.slip);
    largest = std::max(largest, joint.slip);
  }
  EXPECT_EQ(least, 0.0);
  EXPECT_EQ(largest, 1e-5);
  EXPECT_EQ(normal_force_text(-5664.0), "a pull of 5.664 kN");
  EXPECT_EQ(normal_force_text(5664.0), "a normal force of 5.664 kN");
}

// Forces per metre are negligible where those on a metre of a block of that size are.
TEST(Floor, OfForcesPerMetreIsThatOfForcesOverTheSizeOfABlock) {
  const Evaluation e = test::column_evaluation(0.6, 0.4);
  int found = 0;
  visit_tables(e, [&](const Table& table) {
    for (const Table::Column& column : table.columns) {
      if (column.unit != "N/m") continue;
      ++found;
      EXPECT_DOUBLE_EQ(column.floor, e.last.joints.floor.force / block_size(e.assembly)) << column.key;
    }
  });
  EXPECT_EQ(found, 6) << "outwards and down on supports, two each of the map and of blocks";
}

// The floor follows the error of the run: an equilibrium that leaves 1e-3 of a block's weight unbalanced.
TEST(Floor, FollowsTheUnbalancedForceOfTheEquilibrium) {
  const Assembly a = test::column(3);
  Summary summary = test::column_summary(a);
  summary.equilibrium_residual = 1e-3;
  const auto floor = [&] {
    return test::evaluated(a, {test::column_at_rest(a, test::kGravity, 0.0, 0.6, 0.4)}, summary,
                           test::column_case(), test::fresh_folder("results"))
        .last.joints.floor.force;
  };
  EXPECT_NEAR(floor(), 1e-3 * summary.weight_N / 3, 1e-9);
  summary.status = Status::moving;  // what is not balanced is inertia
  EXPECT_NEAR(floor(), 1e-6 * summary.weight_N, 1e-9);
}

}  // namespace
}  // namespace cupola::floor_test
