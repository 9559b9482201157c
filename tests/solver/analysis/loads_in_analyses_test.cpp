// Every way to give a load, in every analysis: forces by name, place, course and member, weights and masses
// on top, and moments, against the balance of two blocks on each other.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "assembly/model/block_names.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/solver/analysis/path_run.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::loads_in_analyses_test {
namespace {

constexpr double kLoad = 500.0;  // N, or N m

/// Floor, and two flat blocks of 1 m on each other. The upper one belongs to a member, and has a top face.
Assembly two_blocks() {
  Assembly pile = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {4, 4, 1}, .fixed = true},
                                       {.center = {0, 0, 0.1}, .size = {1, 1, 0.2}, .ring = 0},
                                       {.center = {0, 0, 0.3}, .size = {1, 1, 0.2}, .ring = 1}});
  pile.num_rings = 2;
  pile.blocks[2].name = "upper";
  pile.members = {"slab"};
  pile.blocks[2].member = 0;
  pile.face_kinds[static_cast<size_t>(pile.parts[2].face_start) + 1] = FaceKind::top;
  return pile;
}

BlockForce downwards(BlockRef block) {
  BlockForce load;
  load.block = std::move(block);
  load.force = {0, 0, -kLoad};
  return load;
}

/// Each loads the pile by kLoad downwards.
std::vector<std::pair<std::string, Loads>> loads_of_all_kinds() {
  std::vector<std::pair<std::string, Loads>> all;
  const auto add = [&](const std::string& name, const std::function<void(Loads*)>& set) {
    Loads loads;
    loads.gravity = {0, 0, -testing::kG};
    set(&loads);
    all.emplace_back(name, loads);
  };
  add("block by name", [](Loads* l) { l->forces = {downwards(BlockRef(std::string("upper")))}; });
  add("block by place", [](Loads* l) {
    l->forces = {downwards(BlockForce::kAtPoint)};
    l->forces[0].point = Vec3(0, 0, 0.35);
  });
  add("course", [](Loads* l) {
    l->forces = {downwards(0)};
    l->forces[0].over = SharingBlocks{1, ""};
  });
  add("member", [](Loads* l) {
    l->forces = {downwards(0)};
    l->forces[0].over = SharingBlocks{-1, "slab"};
  });
  add("weight on top", [](Loads* l) { l->top_load = TopLoad{.weight = kLoad}; });
  add("mass on top", [](Loads* l) { l->lantern = TopLoad{.mass = kLoad / testing::kG}; });
  return all;
}

Case case_of(AnalysisType type, Loads loads, const Assembly& assembly) {
  Case scene = testing::make_case(0.5, 1e-9, 0.01);
  scene.analysis.type = type;
  scene.analysis.tolerance = 1e-9;
  scene.loads = std::move(loads);
  scene.analysis.duration = 1.0;
  scene.analysis.path.steps = 1;
  scene.analysis.path.control = LoadPath::Control{BlockRef{0}, {}, Vec3::UnitZ()};
  scene.geometry.surface = WallSurface{};
  resolve_block_names(assembly, &scene.loads, &scene.ties, &scene.supports);
  return scene;
}

/// N, force of the floor on the lower block, in the last frame of an analysis.
Vec3 reaction_in(const Case& scene, const Assembly& assembly) {
  Frame last;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { last = frame; };
  const Summary summary = run_analysis(scene, assembly, sinks).value();
  EXPECT_TRUE(stands(summary.status)) << summary.message;
  Vec3 force = Vec3::Zero();
  for (int i = 0; i < last.contacts.size(); ++i)
    if (last.contacts.block_a[i] == 0) force += last.contacts.force[i];
  return force;
}

// The balance of statics, paths and motions is far below 1e-6 of the weight.
TEST(LoadsInAnalyses, LoadTheGroundInStaticsPathsAndMotions) {
  const Assembly pile = two_blocks();
  const double weight = free_weight(pile, testing::kG);
  for (const auto& [name, loads] : loads_of_all_kinds())
    for (const AnalysisType type : {AnalysisType::static_, AnalysisType::path, AnalysisType::dynamic})
      EXPECT_NEAR(reaction_in(case_of(type, loads, pile), pile).z(), weight + kLoad, 1e-6 * weight)
          << name << " in " << to_string(type);
}

TEST(LoadsInAnalyses, CloseTheRangeOfTheBedAtTheirSum) {
  const Assembly pile = two_blocks();
  const double weight = free_weight(pile, testing::kG);
  for (const auto& [name, loads] : loads_of_all_kinds()) {
    Case scene = case_of(AnalysisType::range, loads, pile);
    scene.analysis.range.quantities = {JointForce{0, 1, JointForce::Component::normal, Vec3::UnitX()}};
    const Summary summary = run_range(scene, pile, {}).value();
    ASSERT_TRUE(summary.ranges.at(0).min.value && summary.ranges[0].max.value) << name;
    EXPECT_NEAR(*summary.ranges[0].min.value, weight + kLoad, 1e-6 * weight) << name;
    EXPECT_NEAR(*summary.ranges[0].max.value, weight + kLoad, 1e-6 * weight) << name;
  }
}

// A horizontal force on the lower block slides it where the friction is below the force over what presses.
TEST(LoadsInAnalyses, HoldABlockByFrictionInALimit) {
  const Assembly pile = two_blocks();
  const double weight = free_weight(pile, testing::kG), push = 0.3 * weight;
  for (auto [name, loads] : loads_of_all_kinds()) {
    BlockForce across;
    across.block = BlockRef{1};
    across.force = {push, 0, 0};
    loads.forces.push_back(across);
    Case scene = case_of(AnalysisType::limit, loads, pile);
    scene.analysis.limit.parameter = LimitSearch::Parameter::friction;
    scene.analysis.limit.low = 0.01;
    scene.analysis.limit.high = 1.0;
    const Summary summary = run_limit(scene, pile, {}).value();
    ASSERT_TRUE(summary.critical) << name << ": " << summary.message;
    const double exact = push / (weight + kLoad);
    EXPECT_NEAR(summary.critical->value, exact, 2e-5 * exact) << name << ", the width of the bracket";
  }
}

/// The pile under a moment about y, as a share of that which overturns it, W b / 2.
Case turned_pile(AnalysisType type, const Assembly& pile, double share, TimeFunction time = {}) {
  Loads loads;
  loads.gravity = {0, 0, -testing::kG};
  BlockForce moment;
  moment.block = BlockRef{1};
  moment.moment = Vec3(0, share * 0.5 * free_weight(pile, testing::kG), 0);
  moment.time = std::move(time);
  loads.forces = {moment};
  return case_of(type, loads, pile);
}

// The resultant of the bed moves by M / W towards x.
TEST(LoadsInAnalyses, AMomentShiftsTheReactionInStaticsAndRanges) {
  const Assembly pile = two_blocks();
  const double weight = free_weight(pile, testing::kG);
  Frame frame;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& f) { frame = f; };
  run_static(turned_pile(AnalysisType::static_, pile, 0.4), pile, sinks);
  double moment = 0.0;
  for (int i = 0; i < frame.contacts.size(); ++i)
    if (frame.contacts.block_a[i] == 0) moment += frame.contacts.point[i].x() * frame.contacts.force[i].z();
  EXPECT_NEAR(moment, 0.2 * weight, 1e-6 * weight);

  Case scene = turned_pile(AnalysisType::range, pile, 0.4);
  scene.analysis.range.quantities = {JointForce{0, 1, JointForce::Component::eccentricity, Vec3::UnitX()}};
  const ForceRange range = run_range(scene, pile, {}).value().ranges.at(0);
  EXPECT_NEAR(range.min.value.value(), 0.2, 1e-6);
  EXPECT_NEAR(range.max.value.value(), 0.2, 1e-6);
}

// A moment that grows to 1.9 times that which overturns the pile: equilibria exist up to 1 / 1.9 of the path,
// found to 1/64 of a step of a tenth.
TEST(LoadsInAnalyses, AMomentOverturnsThePileAlongAPath) {
  const Assembly pile = two_blocks();
  Case scene = turned_pile(AnalysisType::path, pile, 1.9, RampInTime{});
  scene.analysis.path.steps = 10;
  const path_test::PathResult path = path_test::run(scene, pile);
  ASSERT_FALSE(path.rows.empty()) << path.summary.message;
  EXPECT_NEAR(path.rows.back()[0], 1.0 / 1.9, 0.1 / 64) << path.summary.message;
}

// A block on the floor under 1.5 times the overturning moment: it turns about its edge with (M - W b / 2) /
// I, where I is that about the edge. In the first steps the angle does not change the arm.
TEST(LoadsInAnalyses, AMomentTurnsABlockAboutItsEdgeInAMotion) {
  const double b = 1.0, z = 0.5, h = 1e-3;
  const Assembly box = testing::box_on_floor({b, 1.0, z});
  const double mass = box.blocks[1].mass, arm = 0.5 * mass * testing::kG * b;
  Case scene = testing::make_case(10.0, 1e-12, h);
  BlockForce load;
  load.block = BlockRef{1};
  load.moment = Vec3(0, 1.5 * arm, 0);
  scene.loads.forces = {load};
  Simulation simulation = testing::simulate(scene, box);
  for (int step = 0; step < 10; ++step) simulation.advance();
  const double about_edge = mass * (b * b + z * z) / 3.0, turn = 0.5 * arm / about_edge * 10 * h;
  EXPECT_NEAR(simulation.state().v[4], turn, 2e-3 * turn)
      << "it has turned by 4e-4 rad, of an arm of half of b";
}

// The pile and a fill of its weight W on it, both of which weigh half at the time 0. It slides under
// mu (W / 2 + W / 2) = a (W + W): the acceleration is that of the whole.
TEST(LoadsInAnalyses, AccelerateAFillByItsWholeWeight) {
  const Assembly pile = two_blocks();
  Loads loads;
  loads.gravity = {0, 0, -testing::kG};
  loads.dead_load_time = RampInTime{0.5, 1.0, 1.0, 1.0};
  FaceLoad fill;
  fill.faces = FaceKind::top;
  fill.fill.emplace();
  fill.fill->level = 1.4;  // m above the floor, 1 m above the pile of 1 m2
  fill.fill->unit_weight = free_weight(pile, testing::kG);
  loads.faces = {fill};
  Case scene = case_of(AnalysisType::limit, loads, pile);
  scene.analysis.limit.parameter = LimitSearch::Parameter::acceleration;
  scene.analysis.limit.low = 0.0;
  scene.analysis.limit.high = 1.0;
  const Summary limit = run_limit(scene, pile, {}).value();
  ASSERT_TRUE(limit.critical) << limit.message;
  EXPECT_NEAR(limit.critical->value, 0.25, 2e-5 * 0.25) << "the width of the bracket";
  scene.analysis.type = AnalysisType::static_;
  scene.analysis.robustness = 4;
  const Summary statics = run_static(scene, pile, {});
  ASSERT_TRUE(statics.robustness) << statics.message;
  EXPECT_NEAR(statics.robustness->acceleration_g, 0.25, 1e-4 * 0.25) << "kClose";
}

}  // namespace
}  // namespace cupola::loads_in_analyses_test
