#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solver/analysis/analysis.hpp"
#include "tests/csv_numbers.hpp"
#include "tests/solver/motion_scenes.hpp"

// Runs of path analyses, and the couplet, two blocks with one joint that breaks.

namespace cupola::path_test {

constexpr double kCompliance = 1e-11;             // m3/N
constexpr FractureEnergy kEnergy{20.0, 100.0};    // N/m
constexpr JointStrength kStrength{2.5e5, 3.5e5};  // Pa

struct PathResult {
  Summary summary;
  std::vector<Frame> frames;
  std::vector<std::vector<double>>
      rows;  // of path.csv: time, displacement, force, dissipated, damage, solves

  double largest_force() const {
    double largest = 0.0;
    for (const auto& row : rows) largest = std::max(largest, std::abs(row[2]));
    return largest;
  }
};

inline PathResult run(const Case& scene, const Assembly& assembly) {
  PathResult result;
  std::string table;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { result.frames.push_back(frame); };
  sinks.table = [&](const std::string& name, const std::string& text) {
    EXPECT_EQ(name, "path.csv");
    table = text;
  };
  result.summary = run_path(scene, assembly, sinks).value();
  result.rows = test::csv_numbers(table);
  return result;
}

/// Two blocks of 1 x 0.5 x 0.2 m, bonded so strongly to a floor and to a support above that only the bed
/// between them breaks. Blocks: floor, lower, upper, support.
inline Assembly couplet() {
  return testing::make_boxes({{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true},
                              {.center = {0, 0, 0.1}, .size = {1, 0.5, 0.2}, .ring = 0},
                              {.center = {0, 0, 0.3}, .size = {1, 0.5, 0.2}, .ring = 1},
                              {.center = {0, 0, 0.5}, .size = {1, 0.5, 0.2}, .fixed = true}});
}
constexpr double kArea = 0.5;                           // m2
constexpr double kWeight = 0.1 * 1000.0 * testing::kG;  // N, of a block; the residual is relative to it

inline Case couplet_case(int steps) {
  Case scene = testing::make_case(0.75, 0.0, 0.01);
  scene.joints.compliance = {kCompliance, kCompliance, Compliance::Per::area};
  scene.joints.strength = kStrength;
  scene.joints.failure = JointFailure::softening;
  scene.joints.fracture_energy = kEnergy;
  scene.joints.base.emplace();
  scene.joints.base->tension = scene.joints.base->cohesion = 1e9;
  scene.analysis.type = AnalysisType::path;
  scene.analysis.friction_law = FrictionLaw::coulomb;
  scene.analysis.tolerance = 1e-6;
  scene.analysis.path.steps = steps;
  scene.analysis.path.control = LoadPath::Control{BlockRef{3}, {}, Vec3::UnitX()};
  return scene;
}

}  // namespace cupola::path_test
