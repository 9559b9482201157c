// Gaps and overlaps as drawn: closed by displacements, or taken as errors of the drawing.
#include <gtest/gtest.h>

#include "solver/analysis/analysis.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::initial_gaps_test {
namespace {

constexpr double kCompliance = 1e-8;  // m/N, per contact point

/// A slab on three fixed piers, of which the middle one is `higher` (m) than the others.
Assembly slab(double higher) {
  return testing::make_boxes({{.center = {-2, 0, -0.5}, .fixed = true},
                              {.center = {0, 0, -0.5 + higher}, .fixed = true},
                              {.center = {2, 0, -0.5}, .fixed = true},
                              {.center = {0, 0, 0.25}, .size = {5, 1, 0.5}}});
}

/// The message of statics whose middle pier, drawn 2 mm too low or not, has sunk by 3 mm.
std::string message_after_sinking(double drawn_lower) {
  Case scene = testing::make_case(0.7, kCompliance, 0.01);
  scene.analysis.type = AnalysisType::static_;
  scene.supports.moves = {{.region = {.blocks = {BlockRef{1}}}, .displacement = {0, 0, -3e-3}, .time = {}}};
  return run_static(scene, slab(-drawn_lower), {}).message;
}

/// m, of the slab upwards.
double rise(const Assembly& assembly, ContactDetection::InitialGaps gaps) {
  Case scene = testing::make_case(0.7, kCompliance, 0.01);
  scene.analysis.type = AnalysisType::static_;
  scene.contact.initial_gaps = gaps;
  AnalysisSinks sinks;
  Frame frame;
  sinks.frame = [&](const Frame& f) { frame = f; };
  const Summary summary = run_static(scene, assembly, sinks);
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  return frame.blocks.displacement[3].z();
}

// Each pier has four contact points. A middle pier that is 0.1 mm too low carries nothing, because the slab
// sinks by 0.03 mm only; one that is as much too high lifts the slab off the others. Where that is an error
// of the drawing, all twelve points carry.
TEST(InitialGaps, CountAsDrawnOrAsErrorsOfTheDrawing) {
  using enum ContactDetection::InitialGaps;
  constexpr double kError = 1e-4;
  const Assembly low = slab(-kError), high = slab(kError);
  const double sinks = kCompliance * free_weight(low, testing::kG);
  const double tolerance = 1e-6 * sinks;  // of the solve
  EXPECT_NEAR(rise(low, keep), -sinks / 8.0, tolerance);
  EXPECT_NEAR(rise(high, keep), kError - sinks / 4.0, tolerance);
  EXPECT_NEAR(rise(low, ignore), -sinks / 12.0, tolerance);
  EXPECT_NEAR(rise(high, ignore), -sinks / 12.0, tolerance);
}

// A block of 10 kN under a fixed lintel: its joints of 1 MPa bond where they touch, and pull across no air.
TEST(InitialGaps, ArePulledAcrossByNoTension) {
  Case scene = testing::make_case(0.5, 0.0, 0.01);
  scene.joints.compliance = {1e-9, 1e-9, Compliance::Per::area};
  scene.joints.strength = {1e6, 1e6};
  scene.contact.margin = 0.01;
  scene.analysis.type = AnalysisType::static_;
  for (const double gap : {0.0, 1e-3}) {
    const Assembly room =
        testing::make_boxes({{.center = {0, 0, -0.5}, .size = {2, 2, 1}, .fixed = true},
                             {.center = {0, 0, 0.5}},
                             {.center = {0, 0, 1.5 + gap}, .size = {2, 2, 1}, .fixed = true}});
    double lintel = 0.0;
    AnalysisSinks sinks;
    sinks.frame = [&](const Frame& frame) {
      lintel = 0.0;
      for (int i = 0; i < frame.contacts.size(); ++i)
        if (frame.contacts.block_b[i] == 2) lintel += frame.contacts.normal_force[i];
    };
    run_static(scene, room, sinks);
    const double weight = free_weight(room, testing::kG);
    EXPECT_NEAR(lintel, gap > 0.0 ? 0.0 : -0.5 * weight, 1e-6 * weight) << gap << ", less the tolerance";
  }
}

// Under a growing dead load a path starts from blocks that bear nothing where they were drawn. Its end is the
// equilibrium of statics, in which the higher pier bears before the others.
TEST(InitialGaps, OfAnUnloadedPathBearWithTheFirstLoad) {
  constexpr double kError = 5e-5;  // m, below 1e-4 of the slab of 1.36 m
  const Assembly high = slab(kError);
  Case scene = testing::make_case(0.7, kCompliance, 0.01);
  scene.analysis.type = AnalysisType::path;
  scene.analysis.path.steps = 2;
  scene.loads.dead_load_time = RampInTime{};
  AnalysisSinks sinks;
  std::vector<Frame> frames;
  sinks.frame = [&](const Frame& frame) { frames.push_back(frame); };
  const Summary summary = run_path(scene, high, sinks).value();
  ASSERT_EQ(summary.status, Status::stable) << summary.message;
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[0].blocks.displacement[3], Vec3::Zero());
  EXPECT_EQ(frames[0].contacts.normal_force, std::vector<double>(frames[0].contacts.size(), 0.0));
  const double sinks_by = kCompliance * free_weight(high, testing::kG);
  EXPECT_NEAR(frames[2].blocks.displacement[3].z(), kError / 3.0 - sinks_by / 12.0, 1e-6 * sinks_by);
}

// The note sends readers to the drawing, which has no gap where a support has moved away.
TEST(InitialGaps, AreNoMovementsOfSupports) {
  EXPECT_EQ(message_after_sinking(0.0).find("gaps of up to"), std::string::npos)
      << message_after_sinking(0.0);
  const std::string drawn = message_after_sinking(2e-3);
  EXPECT_NE(drawn.find("4 contact points with gaps of up to 2 mm"), std::string::npos) << drawn;
}

}  // namespace
}  // namespace cupola::initial_gaps_test
