// The hoop force of a course in a range: what its masonry carries, of all forces on it at their points.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "solver/analysis/analysis.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::hoop_range_test {
namespace {

constexpr int kBlocks = 8;
constexpr double kLoad = 500.0;  // N, outwards on every block

/// Blocks that do not touch, in a circle on a frictionless floor. Bars between their centroids hold them.
Assembly chained_blocks() {
  constexpr double r = 10.0;
  std::vector<testing::BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {40, 40, 1}, .fixed = true}};
  for (int i = 0; i < kBlocks; ++i) {
    const Eigen::AngleAxisd turn(2.0 * std::numbers::pi * i / kBlocks, Vec3::UnitZ());
    boxes.push_back({.center = turn * Vec3(r, 0, 0.5), .rotation = Eigen::Quaterniond(turn)});
  }
  Assembly assembly = testing::make_boxes(boxes);
  assembly.num_rings = 1;
  assembly.sheets = {{.name = "ring", .num_rings = 1, .thrust_lines = Sheet::ThrustLines::by_azimuth}};
  assembly.chains = {{"iron", 0.5}};
  for (int i = 0; i < kBlocks; ++i) {
    const int next = (i + 1) % kBlocks;
    BuiltTie bar{i + 1, next + 1, boxes[i + 1].center, boxes[next + 1].center, 1e7};
    bar.length = (bar.point_b - bar.point_a).norm();
    bar.chain = 0;
    assembly.ties.push_back(bar);
  }
  return assembly;
}

/// The range of the hoop force where half of the load of every block acts at the angle `aside` to either side
/// of its middle.
ForceRange hoop_force(double aside) {
  const Assembly assembly = chained_blocks();
  Case scene = testing::make_case(0.0, 1e-8, 0.01);
  scene.analysis.type = AnalysisType::range;
  scene.analysis.tolerance = 1e-9;
  scene.analysis.range.quantities = {HoopForce{0}};
  for (int i = 1; i <= kBlocks; ++i) {
    const Vec3 middle = assembly.blocks[i].centroid, outward = Vec3(middle.x(), middle.y(), 0).normalized();
    const Vec3 along = Vec3::UnitZ().cross(outward);
    for (const double sign : {1.0, -1.0})
      scene.loads.forces.push_back({.block = i,
                                    .point = middle + sign * std::tan(aside) * 10.0 * along,
                                    .force = 0.5 * kLoad * outward,
                                    .time = {}});
  }
  const Summary summary = run_range(scene, assembly, {}).value();
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  return summary.ranges.at(0);
}

void expect_only(const ForceRange& range, double value) {
  const double size = kBlocks * kLoad / (2.0 * std::numbers::pi);  // of the loads alone
  ASSERT_TRUE(range.min.value && range.max.value) << range.quantity;
  EXPECT_NEAR(*range.min.value, value, 1e-6 * size) << "the gap of a range";
  EXPECT_NEAR(*range.max.value, value, 1e-6 * size) << "the gap of a range";
}

TEST(HoopRange, ChainsCarryNoneOfTheMasonrysForce) {
  expect_only(hoop_force(0.0), 0.0);
}

// At the angle a from the middle of its block a load Q pushes outwards with Q cos a. The block carries the
// rest of the Q with which the chain pulls its middle inwards: n Q (1 - cos a) / (2 pi).
TEST(HoopRange, LoadsActAtTheirPoints) {
  const double aside = 0.04;
  expect_only(hoop_force(aside), kBlocks * kLoad * (1.0 - std::cos(aside)) / (2.0 * std::numbers::pi));
}

}  // namespace
}  // namespace cupola::hoop_range_test
