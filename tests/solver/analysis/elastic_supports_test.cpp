// Supports on soil (joints with a compliance per area) and supports that settle, in every analysis, against
// closed forms. Statics of a footing with its whole base pressed: restraints_test.cpp.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "solver/analysis/analysis.hpp"
#include "tests/solver/analysis/path_run.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::elastic_supports_test {
namespace {

constexpr double kB = 2.0, kL = 3.0, kZ = 1.0;  // m, of the footing along x, y, z

/// The footing on soil of compliance `c` (m3/N), stiff along it, under a horizontal force at its top.
Case on_soil(AnalysisType type, double c, double force, TimeFunction time = {}) {
  Case scene = testing::make_case(10.0, 0.0, 0.01);
  scene.joints.compliance = {1e-13, 1e-13, Compliance::Per::area};
  scene.joints.base = JointLawChange{};
  scene.joints.base->normal = c;
  scene.contact.subdivide = 16;
  scene.geometry.surface = WallSurface{};
  scene.analysis.type = type;
  scene.analysis.tolerance = 1e-9;
  BlockForce load;
  load.block = BlockRef{1};
  load.point = Vec3(0, 0, kZ);
  load.force = {force, 0, 0};
  load.time = std::move(time);
  if (force != 0.0) scene.loads.forces = {load};
  return scene;
}

// Two fifths of the base lift off: of a force at the height a, the resultant lies e = H a / W from the
// middle, the pressure is linear over 3 (b / 2 - e) and the footing turns by 2 c W / (l x^2). Its centroid
// moves by the turn times its height. Points lie 16 to a side, and the pressed length ends between them: a
// third of their distance squared over its own.
TEST(ElasticSupports, TurnAFootingThatLiftsOffAlongAPath) {
  constexpr double kC = 1e-10;
  const Assembly box = testing::box_on_floor({kB, kL, kZ});
  const double weight = free_weight(box, testing::kG), e = 0.3 * kB;
  Case scene = on_soil(AnalysisType::path, kC, e * weight / kZ, RampInTime{});
  scene.analysis.path.steps = 4;
  scene.analysis.path.control = LoadPath::Control{BlockRef{1}, {}, Vec3::UnitX()};
  const path_test::PathResult path = path_test::run(scene, box);
  ASSERT_EQ(path.rows.size(), 5u) << path.summary.message;
  const double pressed = 3.0 * (0.5 * kB - e);
  const double turn = 2.0 * kC * weight / (kL * pressed * pressed);
  EXPECT_NEAR(path.rows.back()[1], 0.5 * kZ * turn, 0.02 * turn);
  const double whole = kC * 0.25 * e * weight / (kL * kB * kB * kB / 12.0);  // at a quarter of the force
  EXPECT_NEAR(path.rows[1][1], 0.5 * kZ * whole, 1e-3 * whole) << "the whole base is pressed";
}

// A tower on soft soil balances its push as built, e = 0.3 b; leaning by a third it stands beside its base.
TEST(ElasticSupports, SayWhereATowerFallsThatStandsAsBuilt) {
  const Assembly tower = testing::box_on_floor({kB, kL, 10.0 * kZ});
  const double push = 0.3 * kB * free_weight(tower, testing::kG) / kZ;
  const double pressed = 0.6 * kB;
  const double compliance = 0.33 * kL * pressed * pressed / (2.0 * free_weight(tower, testing::kG));
  Case scene = on_soil(AnalysisType::static_, compliance, push, {});
  EXPECT_EQ(run_static(scene, tower, {}).status, Status::stable);
  scene.analysis.type = AnalysisType::path;
  scene.analysis.path.steps = 1;
  scene.analysis.path.control = LoadPath::Control{BlockRef{1}, {}, Vec3::UnitX()};
  const Summary path = path_test::run(scene, tower).summary;
  EXPECT_EQ(path.status, Status::moving);
  EXPECT_NE(path.message.find("moving at 0 s: in the geometry at the end of the step: no equilibrium"),
            std::string::npos)
      << path.message;
}

// Rigid bodies overturn at H = W b / (2 a), whatever the soil: a limit counts admissible forces only.
TEST(ElasticSupports, DoNotChangeALimit) {
  const Assembly box = testing::box_on_floor({kB, kL, kZ});
  const double weight = free_weight(box, testing::kG);
  for (const double c : {1e-12, 2e-8}) {
    Case scene = on_soil(AnalysisType::limit, c, weight);
    scene.analysis.limit.parameter = LimitSearch::Parameter::load;
    scene.analysis.limit.low = 0.0;
    scene.analysis.limit.high = 2.0;
    const Summary summary = run_limit(scene, box, {}).value();
    ASSERT_TRUE(summary.critical) << summary.message;
    const double exact = 0.5 * kB / kZ;
    EXPECT_NEAR(summary.critical->value, exact, 2e-5 * exact) << c << ", the width of the bracket";
  }
}

/// A beam on three piers, of which the middle one has sunk by `settlement`; blocks: piers, beam.
Assembly beam_on_piers() {
  return testing::make_boxes({{.center = {-1, 0, -0.2}, .size = {0.4, 0.4, 0.4}, .fixed = true},
                              {.center = {0, 0, -0.2}, .size = {0.4, 0.4, 0.4}, .fixed = true},
                              {.center = {1, 0, -0.2}, .size = {0.4, 0.4, 0.4}, .fixed = true},
                              {.center = {0, 0, 0.2}, .size = {2.4, 0.4, 0.4}}});
}

ForceRange middle_reaction(double c, double settlement, double* weight) {
  const Assembly beam = beam_on_piers();
  *weight = free_weight(beam, testing::kG);
  Case scene = on_soil(AnalysisType::range, c, 0.0);
  scene.contact.subdivide = 1;
  scene.analysis.range.quantities = {BlockReaction{BlockRef{1}, BlockReaction::Component::vertical, {}}};
  if (settlement > 0.0)
    scene.supports.moves = {
        {.region = {.blocks = {BlockRef{1}}}, .displacement = {0, 0, -settlement}, .time = {}}};
  const Summary summary = run_range(scene, beam, {}).value();
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  return summary.ranges.at(0);
}

// The middle pier may carry anything from nothing to the whole beam. Three equal springs carry a third each;
// where the middle one has sunk by s, the beam sinks by c (W + s A / c) / 3 A, and the middle carries
// (W - 2 s A / c) / 3 on the area A of a pier.
TEST(ElasticSupports, AndSettlementsChooseAStateAndKeepTheRange) {
  constexpr double kArea = 0.16, kSame = 1e-6;  // m2; of the weight, the gap of a range
  for (const double c : {1e-9, 1e-8})
    for (const double share : {0.0, 0.25}) {
      double weight = 0.0;
      const double settlement = share * c * free_weight(beam_on_piers(), testing::kG) / kArea;
      const ForceRange range = middle_reaction(c, settlement, &weight);
      EXPECT_NEAR(range.min.value.value(), 0.0, kSame * weight);
      EXPECT_NEAR(range.max.value.value(), weight, kSame * weight);
      EXPECT_NEAR(range.chosen.value(), (1.0 - 2.0 * share) / 3.0 * weight, kSame * weight) << c << share;
    }
}

// A push at its head overturns the beam about the outer edge of a pier, F h = W l, settled or not.
TEST(Settlements, DoNotChangeALimit) {
  const Assembly beam = beam_on_piers();
  for (const double settlement : {0.0, 1e-5}) {
    Case scene = on_soil(AnalysisType::limit, 1e-9, 0.0);
    BlockForce load;
    load.block = BlockRef{3};
    load.point = Vec3(0, 0, 0.4);
    load.force = {free_weight(beam, testing::kG), 0, 0};
    scene.loads.forces = {load};
    scene.analysis.limit.parameter = LimitSearch::Parameter::load;
    scene.analysis.limit.low = 0.0;
    scene.analysis.limit.high = 6.0;
    if (settlement > 0.0)
      scene.supports.moves = {
          {.region = {.blocks = {BlockRef{1}}}, .displacement = {0, 0, -settlement}, .time = {}}};
    const Summary summary = run_limit(scene, beam, {}).value();
    ASSERT_TRUE(summary.critical) << summary.message;
    EXPECT_NEAR(summary.critical->value, 1.2 / 0.4, 6e-5) << "the width of the bracket";
  }
}

// Released without stress, a block on soil swings about its settlement c W / A, between nothing and twice
// that, with the period 2 pi sqrt(c m / A). Implicit steps damp by pi omega h / 2 in half a period, and
// lengthen it by (omega h)^2.
TEST(ElasticSupports, SwingWithTheirPeriodInAMotion) {
  constexpr double kC = 1e-6;
  const Assembly box = testing::box_on_floor({kB, kL, kZ});
  const double mass = box.blocks[1].mass, area = kB * kL, settlement = kC * mass * testing::kG / area;
  const double half_period = std::numbers::pi * std::sqrt(kC * mass / area);
  Case scene = on_soil(AnalysisType::dynamic, kC, 0.0);
  scene.contact.subdivide = 1;
  scene.analysis.time_step = half_period / 400;
  Simulation simulation = testing::simulate(scene, box);
  double before = 0.0, lowest = 0.0, time = 0.0;
  while (simulation.state().time < 2.0 * half_period) {
    before = simulation.state().v[2];
    simulation.advance();
    const double z = simulation.state().poses[1].p_WB.z() - 0.5 * kZ, v = simulation.state().v[2];
    lowest = std::min(lowest, z);
    if (v >= 0.0) {  // at rest between the last two steps
      time = simulation.state().time - scene.analysis.time_step * v / (v - before);
      break;
    }
  }
  EXPECT_NEAR(time, half_period, 3e-3 * half_period);
  EXPECT_NEAR(lowest, -2.0 * settlement, 0.02 * settlement);
}

}  // namespace
}  // namespace cupola::elastic_supports_test
