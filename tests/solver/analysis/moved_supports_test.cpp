// Statics of supports that have moved: joints and ties act as built, and the moves open and shear them.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "solver/analysis/analysis.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/analysis/statics/static_record.hpp"
#include "solver/analysis/statics/static_solve.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::moved_supports_test {
namespace {

using testing::kG;
using testing::make_case;

// A beam on three supports. The middle one has settled by 20 mm, three times the margin within which faces
// make a joint: the joint stays in the problem, open by the settlement and without force.
TEST(MovedSupports, KeepsTheJointThatASupportHasLeft) {
  const Assembly beam =
      testing::make_boxes({{.center = {-1, 0, -0.2}, .size = {0.4, 0.4, 0.4}, .fixed = true},
                           {.center = {0, 0, -0.2}, .size = {0.4, 0.4, 0.4}, .fixed = true},
                           {.center = {1, 0, -0.2}, .size = {0.4, 0.4, 0.4}, .fixed = true},
                           {.center = {0, 0, 0.2}, .size = {2.4, 0.4, 0.4}}});
  Case scene = make_case(0.5, 1e-10, 0.01);
  scene.analysis.type = AnalysisType::static_;
  scene.supports.moves = {{.region = {.blocks = {BlockRef{1}}}, .displacement = {0, 0, -0.02}, .time = {}}};
  Frame frame;
  AnalysisSinks sinks;
  sinks.frame = [&frame](const Frame& written) { frame = written; };
  ASSERT_EQ(run_static(scene, beam, sinks).status, Status::stable);
  double least = 1.0, largest = 0.0, force = 0.0;
  for (int i = 0; i < frame.contacts.size(); ++i) {
    if (frame.contacts.block_a[i] != 1) continue;
    least = std::min(least, frame.contacts.gap[i]);
    largest = std::max(largest, frame.contacts.gap[i]);
    force += frame.contacts.normal_force[i];
  }
  EXPECT_EQ(force, 0.0);
  EXPECT_NEAR(least, 0.02, 1e-6) << "the joints yield by less than W c = 1e-6 m";
  EXPECT_NEAR(largest, 0.02, 1e-6);
}

// The same beam in a motion, and in a limit of `spread` that also draws the right support from under it. Their
// contacts are found anew, without those of the middle joint: frames list them all the same. The joints yield
// by less than W c = 1e-6 m.
TEST(MovedSupports, FramesKeepJointsThatHaveOpenedWidely) {
  const Assembly beam =
      testing::make_boxes({{.center = {-1, 0, -0.2}, .size = {0.4, 0.4, 0.4}, .fixed = true},
                           {.center = {0, 0, -0.2}, .size = {0.4, 0.4, 0.4}, .fixed = true},
                           {.center = {1, 0, -0.2}, .size = {0.4, 0.4, 0.4}, .fixed = true},
                           {.center = {0, 0, 0.2}, .size = {2.4, 0.4, 0.4}}});
  Frame frame;
  const auto middle_gaps = [&frame] {
    std::vector<double> gaps;
    for (int i = 0; i < frame.contacts.size(); ++i) {
      if (frame.contacts.block_a[i] != 1) continue;
      gaps.push_back(frame.contacts.gap[i]);
      EXPECT_EQ(frame.contacts.normal_force[i], 0.0);
      EXPECT_TRUE(std::isnan(frame.contacts.slip[i])) << "marks those that have parted";
    }
    return gaps;
  };
  AnalysisSinks sinks;
  Case scene = make_case(0.5, 1e-10, 0.01);
  scene.analysis.friction_law = FrictionLaw::coulomb;
  scene.supports.moves = {
      {.region = {.blocks = {BlockRef{1}}}, .displacement = {0, 0, -0.02}, .time = RampInTime{}}};
  scene.analysis.duration = 1.2;
  sinks.frame = [&frame](const Frame& written) { frame = written; };
  ASSERT_TRUE(run_dynamic(scene, beam, sinks));
  const std::vector<double> moved = middle_gaps();
  ASSERT_EQ(moved.size(), 4u);
  for (const double gap : moved) EXPECT_NEAR(gap, 0.02, 1e-6);

  scene.analysis.type = AnalysisType::limit;
  scene.analysis.limit.parameter = LimitSearch::Parameter::spread;
  scene.analysis.limit.low = 0.0;
  scene.analysis.limit.high = 1.0;
  scene.supports.moves = {{.region = {.blocks = {BlockRef{1}}}, .displacement = {0, 0, -1}, .time = {}},
                          {.region = {.blocks = {BlockRef{2}}}, .displacement = {1, 0, 0}, .time = {}}};
  sinks.frame = [&frame](const Frame& written) {
    if (written.role == FrameRole::equilibrium) frame = written;
  };
  const std::optional<Summary> limit = run_limit(scene, beam, sinks);
  ASSERT_TRUE(limit && limit->critical) << limit->message;
  const std::vector<double> spread = middle_gaps();
  ASSERT_EQ(spread.size(), 4u);
  for (const double gap : spread) EXPECT_NEAR(gap, limit->critical->stable, 1e-6);
}

// A beam on two supports, of which one moves outwards by d, along its joint. Two joints of four points each
// are springs in series, T = d / (2 c / 4), until the joint slides at mu W / 2. The balance of statics is far
// below 1e-6 W.
TEST(MovedSupports, ASupportThatMovesAlongItsJointPullsByFriction) {
  const Assembly beam =
      testing::make_boxes({{.center = {-1, 0, -0.2}, .size = {0.4, 0.4, 0.4}, .fixed = true},
                           {.center = {1, 0, -0.2}, .size = {0.4, 0.4, 0.4}, .fixed = true},
                           {.center = {0, 0, 0.2}, .size = {2.4, 0.4, 0.4}}});
  const double c = 1e-9, mu = 0.5, W = beam.blocks[2].mass * kG;
  for (const double T : {0.2 * W, 5.0 * W}) {
    Case scene = make_case(mu, c, 0.01);
    scene.analysis.type = AnalysisType::static_;
    scene.supports.moves = {
        {.region = {.blocks = {BlockRef{1}}}, .displacement = {T * c / 2.0, 0, 0}, .time = {}}};
    Frame frame;
    AnalysisSinks sinks;
    sinks.frame = [&frame](const Frame& written) { frame = written; };
    ASSERT_EQ(run_static(scene, beam, sinks).status, Status::stable) << T / W;
    double pull = 0.0;
    for (int i = 0; i < frame.contacts.size(); ++i)
      if (frame.contacts.block_a[i] == 1) pull += frame.contacts.force[i].x();
    EXPECT_NEAR(pull, std::min(T, 0.5 * mu * W), 1e-6 * W) << T / W;
  }
}

// The only support of a column moves from under its middle, and down by far more than the margin within which
// faces make a joint, or turns about its edge: the column follows as one body, and its points carry what
// they carry without. The first order of a turn leaves 1e-3^2 / 2 of 1 m, against a closing of 1e-5 m.
TEST(MovedSupports, AMotionOfAllSupportsStrainsNothing) {
  const Assembly column = testing::make_boxes(
      {{.center = {0, 0, -0.5}, .fixed = true}, {.center = {0, 0, 0.5}}, {.center = {0, 0, 1.5}}});
  Case scene = make_case(0.7, 1e-8, 0.01);
  scene.analysis.type = AnalysisType::static_;
  scene.loads.forces.resize(1);
  scene.loads.forces[0].block.number = 2;
  scene.loads.forces[0].force = {500, 300, 0};
  const auto solve = [&] {
    Frame frame;
    AnalysisSinks sinks;
    sinks.frame = [&frame](const Frame& written) { frame = written; };
    const Summary summary = run_static(scene, column, sinks);
    EXPECT_EQ(summary.status, Status::stable) << summary.message;
    return frame;
  };
  const Frame still = solve();
  for (const double turned : {0.0, 1e-3}) {
    SupportMove move;
    if (turned == 0.0)
      move.displacement = {0.2, 0.6, -0.1};
    else
      move.rotation_deg = Vec3(0, turned * 180.0 / std::numbers::pi, 0), move.pivot = {-0.5, 0, 0};
    scene.supports.moves = {move};
    const Frame moved = solve();
    ASSERT_EQ(moved.contacts.size(), still.contacts.size());
    const double tolerance = (turned == 0.0 ? 1e-6 : 1e-3) * column.blocks[1].mass * kG;
    for (int i = 0; i < still.contacts.size(); ++i) {
      EXPECT_LT((moved.contacts.force[i] - still.contacts.force[i]).norm(), tolerance) << i << ", " << turned;
      EXPECT_EQ(moved.contacts.point[i], still.contacts.point[i]);
    }
  }
}

// A level tie to a support that sinks by 30 mm, across the tie: in the geometry as built that stretches and
// turns nothing. Its ends are written where its force acts. The cube yields by T c / 4 = 8e-6 m.
TEST(MovedSupports, ATieActsInTheGeometryAsBuilt) {
  const Assembly cubes = testing::make_boxes({{.center = {0, 0, -0.5}, .fixed = true},
                                              {.center = {1.2, 0, 0.5}, .fixed = true},
                                              {.center = {0, 0, 0.5}}});
  Case scene = make_case(0.7, 1e-8, 0.01);
  scene.analysis.type = AnalysisType::static_;
  PairTie tie;
  tie.block_a = 1;
  tie.block_b = 2;
  tie.point_a = Vec3(0.7, 0, 0.1);
  tie.point_b = Vec3(0.5, 0, 0.1);
  tie.stiffness = 1e5;
  tie.prestress = 3000.0;
  scene.ties.pairs = {tie};
  SupportMove sinks_by;
  sinks_by.region.blocks = {BlockRef{1}};
  sinks_by.displacement = {0, 0, -0.03};
  scene.supports.moves = {sinks_by};
  Frame frame;
  AnalysisSinks sinks;
  sinks.frame = [&frame](const Frame& written) { frame = written; };
  ASSERT_EQ(run_static(scene, cubes, sinks).status, Status::stable);
  EXPECT_NEAR(frame.ties.force[0], 3000.0, 5.0) << "stiffness times what the joint yields";
  EXPECT_LT((frame.ties.point_a[0] - *tie.point_a).norm(), 1e-12) << "rounding";
  EXPECT_LT((frame.ties.point_b[0] - *tie.point_b).norm(), 1e-12);
  double vertical = 0.0;
  for (int i = 0; i < frame.contacts.size(); ++i) vertical += frame.contacts.force[i].z();
  EXPECT_NEAR(vertical, cubes.blocks[2].mass * kG, 0.01) << "1e-6 of the weight";
}

}  // namespace
}  // namespace cupola::moved_supports_test
