#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "assembly/case/bundled.hpp"
#include "assembly/case/case_reader.hpp"
#include "generators/generate.hpp"
#include "generators/importer/import.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/generators/shared_data.hpp"

// The wall with a window of DigitalDynamicsLab/Masonry: 318 bricks and a lintel on two tension-only springs
// and two rods. Its base moves in the plane of the wall by a displacement record of ten seconds. Takes
// minutes, hence `slow`.

namespace cupola::base_motion_test {
namespace {

struct Shaking {
  Summary summary;
  std::vector<Frame> frames;
  std::vector<std::vector<double>> history;  // rows of history.csv without the header
};

// Columns of history.csv.
constexpr size_t kTime = 0, kFrictionWork = 10, kReaction = 16, kMomentum = 19, kStep = 24, kTieForce = 26;

Shaking shake(const Case& scene, const Assembly& assembly) {
  Shaking result;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { result.frames.push_back(frame); };
  sinks.history = [&, header = true](const std::string& row) mutable {
    if (!std::exchange(header, false)) {
      std::istringstream cells(row);
      std::vector<double>& numbers = result.history.emplace_back();
      for (std::string cell; std::getline(cells, cell, ',');) numbers.push_back(std::stod(cell));
    }
  };
  result.summary = run_dynamic(scene, assembly, sinks).value();
  EXPECT_LE(result.summary.energy_error.value(), 1e-6);
  return result;
}

/// Second column of the record: displacement, one row per 5 ms.
std::vector<double> ground_displacements(const std::string& path) {
  std::vector<double> values;
  std::ifstream in(path);
  double time = 0.0, value = 0.0;
  for (std::string line; std::getline(in, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    if (std::istringstream(line) >> time >> value) values.push_back(value);
  }
  return values;
}

TEST(BaseMotionSlow, ImportedWallFollowsItsRecord) {
  if (shared_data().empty()) GTEST_SKIP() << "no shared data";
  const std::string folder = shared_data() + "/masonry/";
  ImportedBlocks source;
  source.path = folder + "wall_brickfile.txt";
  source.springs = folder + "wall_springfile.txt";
  source.rods = folder + "wall_rigidrodfile.txt";
  source.up = ImportedBlocks::UpAxis::y;
  const Assembly assembly = import_blocks(source, 1800.0);
  const double h = 0.005, duration = 10.0;
  Case scene;
  scene.joints.friction = 0.6;
  scene.joints.compliance = {1e-9, 1e-9, Compliance::Per::point};
  scene.supports.base_motion =
      BaseMotion{folder + "wall_motionfile.txt", BaseMotion::Quantity::displacement, Vec3::UnitX()};
  scene.analysis.type = AnalysisType::dynamic;
  scene.analysis.tolerance = 1e-4;
  scene.analysis.time_step = h;
  scene.analysis.duration = duration;
  scene.output.frames_every = 0.5;
  const Shaking wall = shake(scene, assembly);

  // Every step converged.
  EXPECT_NE(wall.summary.status, Status::unconverged) << wall.summary.message;
  ASSERT_EQ(wall.history.size(), 2000u);
  EXPECT_NEAR(wall.history.back()[kTime], duration, 1e-9);

  // The fixed blocks follow the record.
  const std::vector<double> ground = ground_displacements(folder + "wall_motionfile.txt");
  ASSERT_EQ(wall.frames.size(), 20u);
  for (const Frame& frame : wall.frames) {
    const auto row = static_cast<size_t>(std::llround(frame.time / h));
    const double expected = row < ground.size() ? ground[row] : ground.back();
    for (size_t block = 0; block < assembly.blocks.size(); ++block) {
      if (!assembly.blocks[block].fixed) continue;
      EXPECT_NEAR(
          (frame.blocks.position[block] - assembly.blocks[block].centroid - expected * Vec3::UnitX()).norm(),
          0.0, 1e-9)
          << frame.time << " s";
    }
  }

  // The impulse of the supports equals the momentum gained by the bricks, up to the tolerance of each step.
  Vec3 gained = -Vec3(0, 0, duration * wall.summary.weight_N);
  double friction_work = 0.0, tie_force = 0.0;
  for (const std::vector<double>& row : wall.history) {
    for (size_t k = 0; k < 3; ++k) gained[static_cast<Eigen::Index>(k)] += row[kStep] * row[kReaction + k];
    EXPECT_GE(row[kFrictionWork], friction_work - 1e-9) << row[kTime] << " s";
    friction_work = row[kFrictionWork];
    tie_force = std::max(tie_force, row[kTieForce]);
  }
  const std::vector<double>& last = wall.history.back();
  const Vec3 momentum(last[kMomentum], last[kMomentum + 1], last[kMomentum + 2]);
  EXPECT_LT((gained - momentum).norm(), scene.analysis.tolerance * wall.summary.weight_N * duration);
  EXPECT_GT(friction_work, 0.0);
  EXPECT_GT(tie_force, 0.0) << "the springs carry the lintel";
}

// A pulse of twice the acceleration that the arch bears for ever is too short to bring it down; one of three
// times that acceleration is not.
TEST(BaseMotion, ShippedArchSurvivesAPulseAndFallsUnderAStrongerOne) {
  const auto status = [](const std::vector<std::string>& settings) {
    const Case scene = read_case(bundled_folder() + "/arch_shaken.yaml", settings);
    return run_dynamic(scene, generate(scene), {}).value().status;
  };
  EXPECT_EQ(status({}), Status::stable);
  EXPECT_EQ(status({"supports.base_motion.direction=[15.7,0,0]"}), Status::collapsed);
}

}  // namespace
}  // namespace cupola::base_motion_test
