// Cracks that close again and cracks that grow over cycles, and heat in a held arch, of the ends of ties and
// in motions.
#include <cmath>
#include <numbers>

#include "solver/dynamics/scene_options.hpp"
#include "tests/solver/accounted_simulation.hpp"
#include "tests/solver/analysis/path_run.hpp"

namespace cupola::cycles_test {
namespace {

using path_test::PathResult;
using path_test::run;

constexpr double kAlpha = 1e-5;  // 1/K
constexpr double kWarm = 50.0;   // K
constexpr double kStrain = kAlpha * kWarm;

BlockHeat warmth(TimeFunction time) {
  BlockHeat heat;
  heat.change = kWarm;
  heat.expansion = kAlpha;
  heat.time = std::move(time);
  return heat;
}

/// Two blocks of 1 m beside each other on one floor, which a force along the floor pushes apart, by `slope`
/// of their weight. Each stands on its ends alone.
Case blocks_apart(double slope, TimeFunction time) {
  Case scene = testing::make_case(0.5, 1e-12, 0.01);
  scene.loads.gravity.setZero();
  const double weight = 1e4;  // N
  for (const int side : {-1, 1})
    scene.loads.forces.push_back(
        {BlockRef{side < 0 ? 1 : 2}, Vec3(0.5 * side, 0, 0), weight * Vec3(side * slope, 0, -1), {}});
  scene.loads.heat = {warmth(std::move(time))};
  scene.analysis.type = AnalysisType::path;
  scene.analysis.friction_law = FrictionLaw::coulomb;
  scene.analysis.tolerance = 1e-7;
  scene.analysis.plane = true;
  scene.analysis.path.control = LoadPath::Control{BlockRef{2}, {}, Vec3::UnitX()};
  return scene;
}

Assembly two_blocks() {
  return testing::make_boxes({{.center = {0, 0, -0.5}, .size = {20, 20, 1}, .fixed = true},
                              {.center = {-0.5, 0, 0.1}, .size = {1, 0.3, 0.2}},
                              {.center = {0.5, 0, 0.1}, .size = {1, 0.3, 0.2}}});
}

// In winter the blocks shrink towards their middles, and a crack of the strain times their length opens
// between them; in summer it closes.
TEST(Cracks, CloseAgain) {
  Case scene = blocks_apart(0.0, TableInTime{.file = {}, .times = {0, 1, 2}, .values = {0, -1, 0}});
  scene.analysis.path.steps = 8, scene.analysis.path.end = 2.0;
  const PathResult path = run(scene, two_blocks());
  ASSERT_EQ(path.summary.status, Status::stable) << path.summary.message;
  ASSERT_EQ(path.rows.size(), 9u);
  // Less the elastic travel of the joints, some 1e-8 m.
  EXPECT_NEAR(path.rows[4][6], kStrain, 1e-4 * kStrain);
  EXPECT_NEAR(path.rows[8][6], 0.0, 1e-4 * kStrain);
}

// Pushed apart by less than their friction, each block creeps by the strain times its length in a cycle
// (Ratcheting.OfTwoPoints), so that the crack grows by twice that: 20 years after it was closed, 40 times.
TEST(Cracks, GrowOverCycles) {
  constexpr int kYears = 20;
  TableInTime years;
  for (int k = 0; k <= 2 * kYears; ++k) {
    years.times.push_back(1.0 + 0.5 * k);
    years.values.push_back(k % 2);
  }
  Case scene = blocks_apart(0.2, years);
  scene.analysis.path.steps = 4 + 4 * kYears, scene.analysis.path.end = 1.0 + kYears;
  const PathResult path = run(scene, two_blocks());
  ASSERT_EQ(path.summary.status, Status::stable) << path.summary.message;
  for (int year = 1; year <= kYears; ++year) {
    const auto& row = path.rows[4 + 4 * year];
    EXPECT_NEAR(row[0], 1.0 + year, 1e-9);
    EXPECT_NEAR(row[6], 2.0 * kStrain * year, 1e-3 * kStrain * year) << year;
  }
}

/// The change of the horizontal force with which an arch pushes against its left support, N, if the right one
/// must move by `d` (m, along x) to keep the joints of its own shape closed: three redundant forces, flexible
/// joints, rigid voussoirs.
double elastic_thrust(const testing::ArchSpec& arch, double normal, double tangential, double d) {
  const double beta = arch.beta_deg * std::numbers::pi / 180.0, area = arch.thickness * arch.width;
  Eigen::Matrix3d flexibility = Eigen::Matrix3d::Zero();
  for (int k = 0; k <= arch.voussoirs; ++k) {
    const double angle = beta - 2.0 * beta * k / arch.voussoirs, s = std::sin(angle), c = std::cos(angle);
    // Normal force, shear force and moment in the joint at (s, c), per force (x, z) and moment at the origin.
    Eigen::Matrix3d joint;
    joint << c, -s, 0,  //
        s, c, 0,        //
        -c, s, 1;
    const Eigen::Vector3d flexible(normal / area, tangential / area,
                                   12.0 * normal / (area * arch.thickness * arch.thickness));
    flexibility += joint.transpose() * flexible.asDiagonal() * joint;
  }
  return (flexibility.inverse() * Eigen::Vector3d(d, 0, 0)).x();
}

// A held arch under an even pressure, whose joints are all compressed, pushes more as it warms up.
TEST(Heat, AHeldArchPushesAsItsJointsGiveWay) {
  const testing::ArchSpec spec{.voussoirs = 12, .thickness = 0.2, .beta_deg = 60.0};
  const Assembly arch = testing::make_arch(spec);
  Case scene = testing::make_case(10.0, 0.0, 0.01);
  scene.joints.compliance = {1e-10, 2.4e-10, Compliance::Per::area};
  scene.loads.gravity.setZero();
  for (int block = 1; block <= spec.voussoirs; ++block) {
    Vec3 inwards = -arch.blocks[block].centroid;
    inwards.y() = 0.0;
    scene.loads.forces.push_back({BlockRef{block}, {}, 1e4 * inwards.normalized(), {}});
  }
  scene.analysis.type = AnalysisType::static_;
  scene.analysis.tolerance = 1e-11;
  const auto thrust = [&] {
    double force = 0.0, least = 1e300;
    AnalysisSinks sinks;
    sinks.frame = [&](const Frame& frame) {
      for (int i = 0; i < frame.contacts.size(); ++i) {
        if (frame.contacts.block_a[i] == 0) force -= frame.contacts.force[i].x();
        least = std::min(least, frame.contacts.normal_force[i]);
      }
    };
    const Summary summary = run_static(scene, arch, sinks);
    EXPECT_EQ(summary.status, Status::stable) << summary.message;
    EXPECT_GT(least, 0.0) << "all joints are compressed";
    return force;
  };
  const double cold = thrust();
  scene.loads.heat = {warmth({})};
  scene.loads.heat[0].change = 5.0;
  const double change = thrust() - cold;
  const double span = 2.0 * std::sin(spec.beta_deg * std::numbers::pi / 180.0);
  const double expected = elastic_thrust(spec, 1e-10, 2.4e-10, kAlpha * 5.0 * span);
  EXPECT_GT(expected, 0.01 * cold);
  EXPECT_NEAR(change, expected, 1e-6 * expected) << "of " << cold;
}

/// The greatest thrust of an arch over all admissible states, N.
double greatest_thrust(const Assembly& arch) {
  Case scene = testing::make_case(10.0, 1e-13, 0.01);
  scene.geometry.surface = WallSurface{};
  scene.analysis.type = AnalysisType::range;
  scene.analysis.tolerance = 1e-9;
  scene.analysis.range.quantities = {
      BlockReaction{BlockRef{0}, BlockReaction::Component::vertical, Vec3(1, 0, 0)}};
  const Summary range = run_range(scene, arch, AnalysisSinks{}).value();
  EXPECT_TRUE(range.ranges.at(0).min.value && range.ranges.at(0).max.value) << range.message;
  return std::max(std::abs(*range.ranges[0].min.value), std::abs(*range.ranges[0].max.value));
}

// A held arch that warms up opens hinges the other way round from one on spreading supports, and its thrust
// rises to the greatest of its range.
TEST(Heat, RaisesTheThrustOfAHeldArchToTheGreatestOfItsRange) {
  const Assembly arch = testing::make_arch({.voussoirs = 12, .thickness = 0.2});
  Case scene = testing::make_case(10.0, 1e-13, 0.01);
  scene.loads.heat = {warmth(RampInTime{})};
  scene.loads.heat[0].change = 1.0;  // of 1 m: 1e-5 m, which changes the geometry by as much
  scene.analysis.type = AnalysisType::path;
  scene.analysis.friction_law = FrictionLaw::coulomb;
  scene.analysis.tolerance = 1e-9;
  scene.analysis.path.steps = 4;
  scene.analysis.path.control = LoadPath::Control{BlockRef{0}, {}, Vec3::UnitX()};
  const PathResult path = run(scene, arch);
  ASSERT_EQ(path.summary.status, Status::stable) << path.summary.message;
  const double greatest = greatest_thrust(arch);
  EXPECT_LT(std::abs(path.rows.front()[2]), 0.9 * greatest);
  EXPECT_NEAR(std::abs(path.rows.back()[2]), greatest, 1e-4 * greatest);
}

// A block between two walls is heated within a second, while it moves: its force at rest is the strain of its
// length over the compliance of both joints.
TEST(Heat, InAMotionPushesByTheComplianceOfTheJoints) {
  const Assembly held = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true},
                                             {.center = {0, 0, 0.25}, .size = {1, 0.8, 0.5}},
                                             {.center = {0, 0, 1.0}, .size = {3, 3, 1}, .fixed = true}});
  Case scene = testing::make_case(0.5, 0.0, 0.01);
  scene.joints.compliance = {1e-9, 1e-9, Compliance::Per::area};
  scene.loads.gravity.setZero();
  scene.loads.heat = {warmth(RampInTime{})};
  scene.analysis.duration = 2.0;
  scene.output.frames_every = 2.0;
  double force = 0.0;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) {
    force = 0.0;
    for (int i = 0; i < frame.contacts.size(); ++i)
      if (frame.contacts.block_a[i] == 0) force += frame.contacts.normal_force[i];
  };
  run_dynamic(scene, held, sinks);
  const double expected = kStrain * 0.5 * 0.8 / (2 * 1e-9);
  EXPECT_NEAR(force, expected, 1e-6 * expected);
}

constexpr double kTie = 1e6;  // N/m

PairTie tie_between(int a, const Vec3& point_a, int b, const Vec3& point_b) {
  PairTie tie;
  tie.block_a = BlockRef{a};
  tie.point_a = point_a;
  tie.block_b = BlockRef{b};
  tie.point_b = point_b;
  tie.stiffness = kTie;
  return tie;
}

/// Forces of the ties of warm blocks, N: in statics, or at the end of a path of two steps.
std::vector<double> forces_of_ties(Case scene, const Assembly& assembly, bool along_path) {
  scene.joints.compliance = {1e-12, 1e-12, Compliance::Per::area};
  scene.analysis.friction_law = FrictionLaw::coulomb;
  scene.analysis.tolerance = 1e-9;
  std::vector<double> forces;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { forces = frame.ties.force; };
  if (!along_path) {
    scene.analysis.type = AnalysisType::static_;
    run_static(scene, assembly, sinks);
    return forces;
  }
  scene.analysis.type = AnalysisType::path;
  scene.analysis.path.steps = 2;
  scene.analysis.path.control = LoadPath::Control{BlockRef{1}, {}, Vec3::UnitX()};
  scene.loads.heat[0].time = RampInTime{};
  const PathResult path = run(scene, assembly);
  return path.frames.empty() ? forces : path.frames.back().ties.force;
}

// Ends of ties move with the points of their blocks: the tie takes the strain times the length between them,
// whatever the size of the blocks.
TEST(Heat, StretchesATieByTheStrainOfTheMasonryBetweenItsEnds) {
  const double tolerance = 1e-3;  // of a tie at a slope: its end turns by the strain
  const Assembly pair = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {9, 9, 1}, .fixed = true},
                                             {.center = {-1, 0, 0.5}, .size = {2, 1, 1}},
                                             {.center = {1, 0, 0.5}, .size = {2, 1, 1}}});
  Case clamped = testing::make_case(0.5, 0.0, 0.01);
  clamped.joints.base = JointLawChange{};
  clamped.joints.base->friction = 0.0;
  clamped.loads.heat = {warmth({})};
  clamped.ties.pairs = {tie_between(1, {-0.1, 0, 0.5}, 2, {0.1, 0, 0.5})};
  const Assembly beam = testing::make_boxes({{.center = {-5, 0, -0.5}, .size = {2, 1, 1}, .fixed = true},
                                             {.center = {0, 0, 0.2}, .size = {12, 1, 0.4}},
                                             {.center = {5, 0, -0.5}, .size = {2, 1, 1}, .fixed = true}});
  const Vec3 far(-5, 0.4, -0.2), near(5.9, 0.4, -0.2), end(5, 0.4, 0.2);
  Case with_ground = testing::make_case(0.5, 0.0, 0.01);
  with_ground.loads.heat = {warmth({})};
  with_ground.loads.heat[0].ground = true;
  with_ground.ties.pairs = {tie_between(0, far, 1, end), tie_between(2, near, 1, end)};
  for (const bool along_path : {false, true}) {
    const std::vector<double> clamp = forces_of_ties(clamped, pair, along_path);
    ASSERT_EQ(clamp.size(), 1u);
    EXPECT_NEAR(clamp[0], kTie * kStrain * 0.2, tolerance * kTie * kStrain * 0.2);
    const std::vector<double> forces = forces_of_ties(with_ground, beam, along_path);
    ASSERT_EQ(forces.size(), 2u);
    const double length[] = {(end - far).norm(), (end - near).norm()};
    for (const int k : {0, 1})
      EXPECT_NEAR(forces[k], kTie * kStrain * length[k], tolerance * kTie * kStrain * length[k]) << k;
  }
}

// A cube of 1 m rises at its top by all of its strain, against the ground, which stays. It compresses its bed
// by 1e-5 of that.
TEST(Heat, PressesAHeldPointByTheStrainBelowIt) {
  const Assembly cube = testing::box_on_floor({1, 1, 1});
  Case scene = testing::make_case(0.5, 0.0, 0.01);
  scene.loads.heat = {warmth({})};
  scene.supports.restraints = {{BlockRef{1}, Vec3(0, 0, 1), Vec3::UnitZ(), kTie}};
  for (const bool along_path : {false, true}) {
    const std::vector<double> forces = forces_of_ties(scene, cube, along_path);
    ASSERT_EQ(forces.size(), 2u) << "a tie and a strut";
    EXPECT_NEAR(forces[0], kTie * kStrain, 1e-4 * kTie * kStrain);
    EXPECT_NEAR(forces[1], 0.0, 1e-6 * kTie * kStrain);
  }
}

// The top of a hanging cube rises by the strain of half its height, and its centroid comes to rest as much
// lower. The account of energy closes in every step.
TEST(Heat, InAMotionLowersAHangingCube) {
  const Assembly hanging = testing::make_boxes(
      {{.center = {0, 0, 3}, .size = {4, 4, 1}, .fixed = true}, {.center = {0, 0, 1}, .size = {1, 1, 1}}});
  Case scene = testing::make_case(0.5, 1e-8, 0.01);
  scene.loads.heat = {warmth(RampInTime{})};
  scene.ties.pairs = {tie_between(0, {0, 0, 2.5}, 1, {0, 0, 1.5})};
  testing::AccountedSimulation simulation(scene, hanging);
  for (int step = 0; step < 500; ++step) simulation.advance();
  const double expected = 1.0 - 1000.0 * testing::kG / kTie - 0.5 * kStrain;
  EXPECT_NEAR(simulation.state().poses[1].p_WB.z(), expected, 1e-4 * kStrain);
}

}  // namespace
}  // namespace cupola::cycles_test
