// What moves or heats a structure: spreading supports, heat, cycles, and equilibria in the moved geometry.
#include <cmath>
#include <numbers>

#include "assembly/export/placed_assembly.hpp"
#include "tests/solver/analysis/path_run.hpp"

namespace cupola::path_test {
namespace {

constexpr double kAlpha = 1e-5;  // 1/K

BlockHeat heat_of(double change, TimeFunction time = {}) {
  BlockHeat heat;
  heat.change = change;
  heat.expansion = kAlpha;
  heat.time = std::move(time);
  return heat;
}

/// A path of an arch whose supports, the first block and the last one, each move outwards by `spread`.
Case spreading(const Assembly& arch, double spread, double compliance, int steps) {
  Case scene = testing::make_case(10.0, compliance, 0.01);
  scene.analysis.type = AnalysisType::path;
  scene.analysis.friction_law = FrictionLaw::coulomb;
  scene.analysis.tolerance = 1e-8;
  scene.analysis.plane = true;
  scene.analysis.path.steps = steps;
  scene.analysis.path.control = LoadPath::Control{BlockRef{0}, {}, Vec3::UnitX()};
  const int last = static_cast<int>(arch.blocks.size()) - 1;
  scene.supports.moves = {
      {.region = {.blocks = {BlockRef{0}}}, .displacement = {spread, 0, 0}, .time = RampInTime{}},
      {.region = {.blocks = {BlockRef{last}}}, .displacement = {-spread, 0, 0}, .time = RampInTime{}}};
  return scene;
}

double half_weight(const Assembly& arch) {
  return 0.5 * free_weight(arch, testing::kG);
}

// The thrust of an arch whose supports spread falls to the least of its range, before the geometry changes:
// 1e-5 m of 1 m.
TEST(Spreading, LowersTheThrustToTheLeastOfItsRange) {
  const Assembly arch = testing::make_arch({.voussoirs = 12, .thickness = 0.2});
  Case steps = spreading(arch, 1e-5, 1e-13, 4);
  steps.analysis.tolerance = 1e-9;
  const PathResult path = run(steps, arch);
  ASSERT_EQ(path.summary.status, Status::stable) << path.summary.message;
  Case scene = testing::make_case(10.0, 1e-13, 0.01);
  scene.geometry.surface = WallSurface{};
  scene.analysis.type = AnalysisType::range;
  scene.analysis.tolerance = 1e-9;
  scene.analysis.range.quantities = {
      BlockReaction{BlockRef{0}, BlockReaction::Component::vertical, Vec3(1, 0, 0)}};
  const Summary range = run_range(scene, arch, AnalysisSinks{}).value();
  ASSERT_TRUE(range.ranges.at(0).min.value && range.ranges.at(0).max.value) << range.message;
  const double least = std::min(std::abs(*range.ranges[0].min.value), std::abs(*range.ranges[0].max.value));
  const double first = std::abs(path.rows.front()[2]), last = std::abs(path.rows.back()[2]);
  EXPECT_GT(first, 1.1 * least);
  EXPECT_NEAR(last, least, 1e-4 * least);
}

// tests/reference/spreading_arch.py 5 0.15: hinges at crown and haunch, and the resultant in the moved
// geometry.
constexpr double kCollapse = 0.054625673;  // m, spread of each support
const std::vector<std::pair<double, double>> kThrust{
    {0.013656418, 0.377401248}, {0.027312836, 0.403405154}, {0.040969255, 0.433091063}};

/// Largest relative error of the thrust at three spreads.
double error_of_thrust(PathGeometry geometry, int steps) {
  const Assembly arch = testing::make_arch({.voussoirs = 10, .thickness = 0.15});
  Case scene = spreading(arch, 0.75 * kCollapse, 1e-11, steps);
  scene.analysis.path.geometry = geometry;
  const PathResult path = run(scene, arch);
  EXPECT_EQ(path.summary.status, Status::stable) << path.summary.message;
  double error = 0.0;
  for (const auto& [spread, thrust] : kThrust)
    for (const auto& row : path.rows)
      if (std::abs(row[0] - spread / (0.75 * kCollapse)) < 1e-6)
        error = std::max(error, std::abs(std::abs(row[2]) / half_weight(arch) / thrust - 1.0));
  EXPECT_GT(error, 0.0) << "the spreads are among the steps";
  return error;
}

// The error of equilibria in the geometry at the start of each step halves with the step. In that at the end
// far less is left of longer steps: turning by d in a step moves the edges of a hinge past each other by
// r d^2 / 2, which adds up over the steps. Steps that move blocks by more than a hundredth of the smallest end
// there without being asked.
TEST(Spreading, EquilibriaHoldInTheGeometryAtTheEnd) {
  const double coarse = error_of_thrust(PathGeometry::start, 96),
               fine = error_of_thrust(PathGeometry::start, 192);
  EXPECT_GT(coarse, 5e-4);
  EXPECT_NEAR(coarse / fine, 2.0, 0.3);
  const double end = error_of_thrust(PathGeometry::end, 12);
  EXPECT_LT(end, 0.1 * coarse);
  EXPECT_NEAR(error_of_thrust(PathGeometry::end, 6) / end, 2.0, 0.3) << "first order, too";
  EXPECT_EQ(error_of_thrust(PathGeometry::start, 12), end);
}

TEST(Spreading, CollapsesAtTheSpreadOfRigidVoussoirs) {
  const Assembly arch = testing::make_arch({.voussoirs = 10, .thickness = 0.15});
  const double asked = 1.05 * kCollapse;
  Case scene = spreading(arch, asked, 1e-11, 24);
  scene.analysis.path.geometry = PathGeometry::end;
  const PathResult path = run(scene, arch);
  EXPECT_NE(path.summary.status, Status::stable);
  // The shortest step of the path is 1/64 of a regular one.
  EXPECT_NEAR(path.rows.back()[0] * asked, kCollapse, asked / 24 / 64 + 1e-4 * kCollapse)
      << path.summary.message;
}

// Without the key, too: steps that move blocks by more than a hundredth of the smallest are settled in the
// geometry to which they lead. Each step is up to a fifth of the spread at which the arch falls; the first
// order in the step leaves 3 %.
TEST(Spreading, LongStepsEndAPathWhereShortOnesDo) {
  const Assembly arch = testing::make_arch({.voussoirs = 10, .thickness = 0.15});
  for (const FrictionLaw law : {FrictionLaw::associated, FrictionLaw::coulomb})
    for (const int steps : {6, 12}) {
      const double asked = 1.2 * kCollapse;
      Case scene = spreading(arch, asked, 1e-11, steps);
      scene.analysis.friction_law = law;
      const PathResult path = run(scene, arch);
      EXPECT_EQ(path.summary.status, motion(true)) << path.summary.message;
      EXPECT_NEAR(path.rows.back()[0] * asked, kCollapse, 0.03 * kCollapse) << steps;
    }
}

// A tower whose weight takes nine tenths of what its soft bed resists: leaning by theta it is pushed by
// H h + W theta h / 2 and held by k theta, so that each solve from where the last one ended adds nine tenths
// of what that one added. To the square of theta, 0.02.
TEST(SwayingTower, LeansUntilItsMomentsBalance) {
  constexpr double kSide = 0.5, kHeight = 4.0, kPush = 10.0;
  const Assembly tower =
      testing::make_boxes({{.center = {0, 0, -0.5}, .size = {2, 2, 1}, .fixed = true},
                           {.center = {0, 0, kHeight / 2}, .size = {kSide, kSide, kHeight}}});
  const double toppling = free_weight(tower, testing::kG) * kHeight / 2, stiffness = toppling / 0.9;
  const double compliance = kSide * kSide / stiffness;  // four points at kSide / 2
  Case scene = testing::make_case(0.7, compliance, 0.01);
  scene.analysis.type = AnalysisType::path;
  scene.analysis.path.steps = 2;
  scene.analysis.path.control = LoadPath::Control{BlockRef{1}, {}, Vec3::UnitX()};
  scene.loads.forces.push_back({BlockRef{1}, Vec3(0, 0, kHeight), Vec3(kPush, 0, 0), {}});
  const double lean = kPush * kHeight / (stiffness - toppling);
  for (const PathGeometry geometry : {PathGeometry::start, PathGeometry::end}) {
    scene.analysis.path.geometry = geometry;
    const PathResult path = run(scene, tower);
    ASSERT_EQ(path.summary.status, Status::stable) << path.summary.message;
    EXPECT_NEAR(path.rows.front()[1], lean * kHeight / 2, 0.05 * lean * kHeight / 2) << to_string(geometry);
  }
}

// What is left of that arch where its supports have moved: its blocks become an assembly of their own, whose
// open joints are wider than the margin. Three hinges leave one thrust, both ends of the range.
TEST(Spreading, LeavesOneThrust) {
  const Assembly arch = testing::make_arch({.voussoirs = 10, .thickness = 0.15});
  const auto [spread, thrust] = kThrust[1];
  Case scene = spreading(arch, spread, 1e-11, 12);
  scene.analysis.path.geometry = PathGeometry::end;
  const PathResult path = run(scene, arch);
  ASSERT_EQ(path.summary.status, Status::stable) << path.summary.message;
  const Assembly moved = placed_assembly({arch, poses_of(arch, path.frames.back().blocks), {}});
  Case range = testing::make_case(10.0, 1e-11, 0.01);
  range.geometry.surface = WallSurface{};
  range.contact.margin = 1e-5;
  range.analysis.type = AnalysisType::range;
  range.analysis.range.quantities = {
      BlockReaction{BlockRef{0}, BlockReaction::Component::vertical, Vec3(1, 0, 0)}};
  const auto range_of = [&range](const Assembly& assembly) {
    const Summary summary = run_range(range, assembly, AnalysisSinks{}).value();
    const RangeEnd &min = summary.ranges.at(0).min, &max = summary.ranges[0].max;
    EXPECT_TRUE(min.value && max.value) << summary.message;
    return std::pair(min.value.value_or(NAN) / half_weight(assembly),
                     max.value.value_or(NAN) / half_weight(assembly));
  };
  const auto [least, greatest] = range_of(moved);
  // A path of 12 steps is off by a hundredth of 5e-3, see above.
  EXPECT_NEAR(least, thrust, 1e-4 * thrust);
  EXPECT_NEAR(greatest, thrust, 1e-4 * thrust);
  const auto [least_as_built, greatest_as_built] = range_of(arch);
  EXPECT_GT(greatest_as_built - least_as_built, 0.2 * thrust);
}

// A stack of three boxes between a floor and a ceiling: the strain of its height closes four joints.
TEST(Heat, AHeldStackPushesByTheComplianceOfItsJoints) {
  std::vector<testing::BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true}};
  for (int k = 0; k < 3; ++k)
    boxes.push_back({.center = {0, 0, 0.25 + 0.5 * k}, .size = {1, 0.8, 0.5}, .ring = k});
  boxes.push_back({.center = {0, 0, 2.0}, .size = {3, 3, 1}, .fixed = true});
  Case scene = testing::make_case(0.0, 0.0, 0.01);
  scene.joints.compliance = {1e-9, 1e-9, Compliance::Per::area};
  scene.loads.gravity.setZero();
  scene.loads.heat = {heat_of(10.0, RampInTime{})};
  scene.analysis.tolerance = 1e-9;
  scene.analysis.type = AnalysisType::path;
  scene.analysis.path.steps = 3;
  scene.analysis.path.control = LoadPath::Control{BlockRef{4}, {}, Vec3::UnitZ()};
  const PathResult path = run(scene, testing::make_boxes(boxes));
  ASSERT_EQ(path.summary.status, Status::stable) << path.summary.message;
  const double force = kAlpha * 10.0 * 1.5 * 0.8 / (4 * 1e-9);
  EXPECT_NEAR(std::abs(path.rows.back()[2]), force, 1e-6 * force);
}

// A column whose temperature grows along x, on a smooth floor, bends away from the hot side, by alpha g z^2 /
// 2 at the height z, and no joint opens.
TEST(Heat, AFreeColumnBendsWithoutOpening) {
  const Assembly column = testing::stack_of_cubes(0.4, {1000, 1000, 1000, 1000});
  Case scene = testing::make_case(0.6, 1e-13, 0.01);
  scene.joints.base.emplace();
  scene.joints.base->friction = 0.0;
  BlockHeat heat;
  heat.gradient = Vec3(50.0, 0.0, 0.0);
  heat.expansion = kAlpha;
  scene.loads.heat = {heat};
  scene.analysis.type = AnalysisType::static_;
  std::vector<Frame> frames;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { frames.push_back(frame); };
  const Summary summary = run_static(scene, column, sinks);
  ASSERT_EQ(summary.status, Status::stable) << summary.message;
  const std::vector<Vec3>& d = frames.at(0).blocks.displacement;
  for (int k = 1; k < 4; ++k) {
    const double z = 0.4 * (k + 0.5), bend = -0.5 * kAlpha * 50.0 * (z * z - 0.2 * 0.2);
    EXPECT_NEAR(d[k + 1].x() - d[1].x(), bend, 1e-8) << k;
  }
  for (const double gap : frames[0].contacts.gap) EXPECT_LT(gap, 1e-9);
}

std::vector<Vec3> forces_of(const Case& scene, const Assembly& assembly, std::vector<Vec3>* displacements) {
  std::vector<Vec3> forces;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) {
    forces = frame.contacts.force;
    *displacements = frame.blocks.displacement;
  };
  const Summary summary = run_static(scene, assembly, sinks);
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  return forces;
}

// Everything heated equally, supports included, expands without force: 1e-10 of the largest.
TEST(Heat, OfEverythingChangesNoForce) {
  const Assembly arch = testing::make_arch({.voussoirs = 9, .thickness = 0.25});
  Case scene = testing::make_case(0.7, 1e-8, 0.01);
  scene.analysis.type = AnalysisType::static_;
  scene.analysis.tolerance = 1e-13;
  std::vector<Vec3> cold_place, hot_place;
  const std::vector<Vec3> cold = forces_of(scene, arch, &cold_place);
  scene.loads.heat = {heat_of(30.0)};
  scene.loads.heat[0].ground = true;
  const std::vector<Vec3> hot = forces_of(scene, arch, &hot_place);
  ASSERT_EQ(cold.size(), hot.size());
  double largest = 0.0, change = 0.0;
  for (size_t i = 0; i < cold.size(); ++i) {
    largest = std::max(largest, cold[i].norm());
    change = std::max(change, (hot[i] - cold[i]).norm());
  }
  EXPECT_LT(change, 1e-10 * largest);
  const int crown = 5;
  EXPECT_NEAR(hot_place[crown].z() - cold_place[crown].z(),
              kAlpha * 30.0 *
                  (arch.blocks[crown].centroid.z() -
                   0.5 * (arch.blocks.front().centroid.z() + arch.blocks.back().centroid.z())),
              1e-10);
}

// A block on an incline under cycles of heat. It sticks at a point, its neutral point, while the rest of its
// base slides; the neutral point of heating lies uphill of that of cooling, and the block creeps down by the
// strain times their distance.

/// m per cycle, of a base of 1 m whose pressure is even, on the slope tan(beta) with friction 0.5.
double drift(double tan_beta, Compliance compliance, int subdivide) {
  constexpr int kCycles = 3, kStepsPerCycle = 4;
  Case scene = testing::make_case(0.5, 0.0, 0.01);
  scene.joints.compliance = compliance;
  scene.contact.subdivide = subdivide;
  scene.loads.gravity.setZero();
  const double weight = 1e4;  // N, and its component down the slope act at the middle of the base
  scene.loads.forces.push_back({BlockRef{1}, Vec3::Zero(), weight * Vec3(tan_beta, 0, -1), {}});
  scene.loads.heat = {heat_of(50.0)};
  TableInTime cycles;
  for (int k = 0; k <= 2 * kCycles; ++k) {
    cycles.times.push_back(0.5 * k);
    cycles.values.push_back(k % 2);
  }
  scene.loads.heat[0].time = cycles;
  scene.analysis.type = AnalysisType::path;
  scene.analysis.friction_law = FrictionLaw::coulomb;
  scene.analysis.tolerance = 1e-7;
  scene.analysis.path.steps = kCycles * kStepsPerCycle;
  scene.analysis.path.end = kCycles;
  scene.analysis.plane = true;
  scene.analysis.path.control = LoadPath::Control{BlockRef{1}, {}, Vec3::UnitX()};
  const PathResult path = run(scene, testing::box_on_floor({1.0, 0.3, 0.2}));
  EXPECT_EQ(path.summary.status, Status::stable) << path.summary.message;
  return path.rows.back()[1] - path.rows[path.rows.size() - 1 - kStepsPerCycle][1];
}

constexpr double kStrain = kAlpha * 50.0;  // times 1 m

// Two ends carry all: the uphill one stays while the other slides, at every slope.
TEST(Ratcheting, OfTwoPointsIsTheExpansionAtEverySlope) {
  const Compliance point{1e-12, 1e-12, Compliance::Per::point, {}};
  for (const double tan_beta : {0.05, 0.25, 0.45})
    EXPECT_NEAR(drift(tan_beta, point, 1), kStrain, 1e-4 * kStrain) << tan_beta;
}

// Simpson's weights: the middle carries two thirds and holds the block up to tan(beta) = 2 mu / 3.
TEST(Ratcheting, OfOneQuadraticPatchBeginsAtTwoThirdsOfTheFriction) {
  const Compliance area{1e-12, 1e-12, Compliance::Per::area, {}};
  for (const double tan_beta : {0.05, 0.25, 0.32})
    EXPECT_NEAR(drift(tan_beta, area, 1), 0.0, 1e-4 * kStrain) << tan_beta;
  for (const double tan_beta : {0.35, 0.45})
    EXPECT_NEAR(drift(tan_beta, area, 1), kStrain, 1e-3 * kStrain) << tan_beta << ", less elastic travel";
}

/// The distance of the neutral points over the length: where the weights from the uphill end reach (1 - r) /
/// 2, with r = tan(beta) / mu.
double neutral_distance(double r, int n) {
  const double reach = 0.5 * (1.0 - r);
  double sum = 0.0;
  for (int i = 0; i <= 2 * n; ++i) {
    sum += i % 2 ? 2.0 / (3 * n) : (i == 0 || i == 2 * n ? 1.0 : 2.0) / (6 * n);
    if (sum >= reach) return 1.0 - 2.0 * (0.5 * i / n);
  }
  return 0.0;
}

// Subdivided patches come close to the drift of an even pressure, strain times tan(beta) / mu.
TEST(Ratcheting, ApproachesThatOfAnEvenPressure) {
  const Compliance area{1e-12, 1e-12, Compliance::Per::area, {}};
  const double r = 0.6;
  for (const int n : {2, 8}) {
    const double found = drift(r * 0.5, area, n);
    EXPECT_NEAR(found, kStrain * neutral_distance(r, n), 1e-3 * kStrain) << n;
    EXPECT_NEAR(found, kStrain * r, kStrain / n) << "within a piece";
  }
}

constexpr double kTilt = 0.02;  // rad

/// m along x, by which a block on a floor has moved after the floor has tilted in the second that begins at
/// `settles`, and after three years that begin at `heated`. A push of a hundredth of its weight acts against
/// the tilt.
double creep(double settles, double heated) {
  const Assembly assembly = testing::box_on_floor({1.0, 0.3, 0.2});
  Case scene = testing::make_case(0.5, 1e-12, 0.01);
  scene.loads.forces.push_back(
      {BlockRef{1}, Vec3::Zero(), Vec3(-0.01 * free_weight(assembly, testing::kG), 0, 0), {}});
  scene.supports.moves = {
      {.rotation_deg = {0, kTilt * 180.0 / std::numbers::pi, 0}, .time = RampInTime{.start = settles}}};
  scene.loads.heat = {heat_of(50.0)};
  TableInTime years;
  for (int k = 0; k <= 6; ++k) {
    years.times.push_back(heated + 0.5 * k);
    years.values.push_back(k % 2);
  }
  scene.loads.heat[0].time = years;
  scene.analysis.type = AnalysisType::path;
  scene.analysis.friction_law = FrictionLaw::coulomb;
  scene.analysis.tolerance = 1e-7;
  scene.analysis.plane = true;
  scene.analysis.path.steps = 16, scene.analysis.path.end = 4.0;
  scene.analysis.path.control = LoadPath::Control{BlockRef{1}, {}, Vec3::UnitX()};
  const PathResult path = run(scene, assembly);
  EXPECT_EQ(path.summary.status, Status::stable) << path.summary.message;
  return path.rows.back()[1];
}

// A history is times of its own for each cause, and their order counts: each year the block creeps by the
// strain times its length, down the tilted floor, and along the level floor with the push.
TEST(History, SettledThenHeatedIsNotHeatedThenSettled) {
  const double turned = 0.1 * std::sin(kTilt);  // half of the height
  const double years = 3.0 * kStrain * std::cos(kTilt);
  EXPECT_NEAR(creep(0.0, 1.0), turned + years, 1e-3 * years);
  EXPECT_NEAR(creep(3.0, 0.0), turned - years, 1e-3 * years);
}

TEST(Heat, StartsAtTheSineOfItsTime) {
  const TimeFunction wave = HarmonicInTime{.frequency = 0.25, .phase_deg = 0.0, .start = 2.0};
  EXPECT_EQ(factor_at(wave, 1.0), 0.0);
  EXPECT_NEAR(factor_at(wave, 3.0), 1.0, 1e-15);
}

}  // namespace
}  // namespace cupola::path_test
