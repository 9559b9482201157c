// Critical values by conic programmes, against closed forms and against bisection. Published and independent
// values are rows of the verification manual.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "assembly/case/limit_parameter.hpp"
#include "solver/analysis/admissible/pull_search.hpp"
#include "solver/analysis/admissible/pull_solve.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/statics/analysis_options.hpp"
#include "tests/solver/analysis/limit_scenes.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::direct_limit_test {
namespace {

using Parameter = LimitSearch::Parameter;
using testing::limit_case;

double critical(const Case& scene, const Assembly& assembly) {
  const Summary summary = run_limit(scene, assembly, {}).value();
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  return summary.critical ? summary.critical->value : std::nan("");
}

// The whole tower tips about the edge of its lowest bed: tan(tilt) = width / height. The tolerance is a tenth
// of the default width of the bracket of a load, which the status stable says was reached.
TEST(DirectLimit, SlenderTowerTipsAtItsBase) {
  for (const int cubes : {1, 10, 200, 500}) {
    const double exact = std::atan(1.0 / cubes) * 180.0 / std::numbers::pi;
    EXPECT_NEAR(critical(limit_case(Parameter::tilt, 0.0, 60.0, 2.0),
                         testing::stack_of_cubes(1.0, std::vector(cubes, 1000.0))),
                exact, 1e-6 * exact)
        << cubes;
  }
}

TEST(DirectLimit, BlockSlidesAtItsFriction) {
  const Assembly box = testing::box_on_floor({1.0, 0.5, 0.2});
  EXPECT_NEAR(critical(limit_case(Parameter::acceleration, 0.0, 2.0, 0.3), box), 0.3, 1e-6 * 0.3);
  EXPECT_NEAR(critical(limit_case(Parameter::tilt, 0.0, 60.0, 0.3), box),
              std::atan(0.3) * 180.0 / std::numbers::pi, 2e-5);
  Case scene = limit_case(Parameter::friction, 0.01, 1.0, 0.3);
  scene.analysis.limit.relative_width = 1e-5;
  scene.loads.gravity = testing::tilted_gravity(0.25);
  EXPECT_NEAR(critical(scene, box), 0.25, 1e-5 * 0.25);
}

// The weight is that of gravity, without the acceleration that the search adds to it.
TEST(DirectLimit, TheWeightIsVertical) {
  const Assembly box = testing::box_on_floor({1.0, 0.5, 0.2});
  const double weight = free_weight(box, testing::kG);
  for (const Parameter parameter : {Parameter::acceleration, Parameter::tilt}) {
    Case scene = limit_case(parameter, 0.0, parameter == Parameter::tilt ? 60.0 : 2.0, 0.3);
    EXPECT_NEAR(run_limit(scene, box, {})->weight_N, weight, 1e-12 * weight);
  }
}

// A load on top of a column has no limit: the state shown is that of the case, not that of an end of the
// bracket.
TEST(DirectLimit, WithoutALimitTheLoadsAreThoseOfTheCase) {
  const Assembly box = testing::box_on_floor({1.0, 0.5, 0.2});
  const double weight = free_weight(box, testing::kG);
  Case scene = limit_case(Parameter::load, 0.0, 10.0, 0.3);
  BlockForce load;
  load.block = BlockRef{1};
  load.force = Vec3(0, 0, -weight);
  scene.loads.forces = {load};
  const Summary summary = run_limit(scene, box, {}).value();
  EXPECT_FALSE(summary.critical) << summary.message;
  EXPECT_NEAR(summary.support_reaction_N.z(), 2.0 * weight, 1e-6 * weight);
}

// A horizontal force at mid-height of a flat block: P = mu W.
TEST(DirectLimit, FactorOnAForce) {
  const Assembly box = testing::box_on_floor({1.0, 0.5, 0.2});
  Case scene = limit_case(Parameter::load, 0.0, 10.0, 0.3);
  BlockForce push;
  push.block.number = 1;
  push.force = {100.0, 0, 0};
  scene.loads.forces = {push};
  const double weight = 1000.0 * 0.1 * testing::kG;
  EXPECT_NEAR(critical(scene, box), 0.3 * weight / 100.0, 1e-6 * 0.3 * weight / 100.0);
}

// Compliance does not enter a limit. The bracket of bisection is that of its static solves.
TEST(DirectLimit, AgreesWithBisection) {
  const Assembly arch = testing::make_arch({.voussoirs = 12, .thickness = 0.16});
  for (const auto& [parameter, low, high] :
       {std::tuple{Parameter::friction, 0.1, 0.8}, std::tuple{Parameter::acceleration, 0.0, 0.5},
        std::tuple{Parameter::tilt, 0.0, 20.0}}) {
    Case scene = limit_case(parameter, low, high, 0.7);
    const double direct = critical(scene, arch);
    scene.analysis.limit.method = LimitSearch::Method::bisection;
    EXPECT_NEAR(direct, critical(scene, arch), 1e-3 * direct) << to_string(parameter);
  }
}

// A limit gives all joints one friction. It says nothing of a case whose beds have less than the others.
TEST(DirectLimit, IsNoVerdictOnJointsThatDifferInFriction) {
  const Assembly arch = testing::make_arch({.voussoirs = 12, .thickness = 0.25});
  Case scene = limit_case(Parameter::friction, 0.5, 1.0, 0.7);
  EXPECT_EQ(own_value(scene), 0.7);
  EXPECT_EQ(run_limit(scene, arch, {})->status, Status::stable);
  scene.joints.bed.emplace().friction = 0.01;
  EXPECT_EQ(own_value(scene), std::nullopt);
  EXPECT_EQ(run_limit(scene, arch, {})->status, Status::unconverged);
}

// A pier under an arch that bears twice its load need not bear it once: values outside the bracket are not
// tried.
TEST(DirectLimit, SaysNothingOfLoadsOutsideItsBracket) {
  EXPECT_EQ(own_value(limit_case(Parameter::load, 0.0, 10.0, 0.7)), 1.0);
  EXPECT_EQ(own_value(limit_case(Parameter::load, 2.0, 10.0, 0.7)), std::nullopt);
  EXPECT_EQ(own_value(limit_case(Parameter::acceleration, 0.1, 1.0, 0.7)), std::nullopt);
}

// A bracket at both of whose ends the arch stands: two programmes were solved.
TEST(DirectLimit, CountsItsTrialsWithoutALimit) {
  const Case scene = limit_case(Parameter::acceleration, 0.0, 0.01, 0.7);
  const Summary summary =
      run_limit(scene, testing::make_arch({.voussoirs = 12, .thickness = 0.25}), {}).value();
  EXPECT_EQ(summary.status, Status::stable);
  EXPECT_EQ(summary.steps, 2);
  EXPECT_GT(summary.iterations, 2);
}

/// Joints with strength, as areas of contact points.
Case strong_case(Parameter parameter, double low, double high, double friction,
                 const JointStrength& strength) {
  Case scene = limit_case(parameter, low, high, friction);
  scene.joints.compliance.per = Compliance::Per::area;
  scene.joints.strength = strength;
  return scene;
}

// A block of 1 x 0.5 x 0.2 m slides at the acceleration mu + c A / W, and on the slope a at mu = tan a - c A
// / (W cos a). Its compressive strength may be missing, far away or near, but is not reached.
TEST(DirectLimit, CohesionAddsToFriction) {
  const Assembly box = testing::box_on_floor({1.0, 0.5, 0.2});
  const double weight = 1000.0 * 0.1 * testing::kG, cohesion = 0.25 * weight / 0.5;
  for (const double compression : {std::numeric_limits<double>::infinity(), 1e9, 4.0 * weight / 0.5}) {
    const JointStrength strength{.tension = 0.0, .cohesion = cohesion, .compression = compression};
    EXPECT_NEAR(critical(strong_case(Parameter::acceleration, 0.0, 2.0, 0.3, strength), box), 0.55,
                1e-6 * 0.55);
    Case scene = strong_case(Parameter::friction, 0.01, 1.0, 0.3, strength);
    scene.analysis.limit.relative_width = 1e-5;
    scene.loads.gravity = testing::tilted_gravity(0.4);
    const double exact = 0.4 - 0.25 * std::hypot(1.0, 0.4);
    EXPECT_NEAR(critical(scene, box), exact, 1e-5 * exact) << compression;
  }
}

TEST(DirectLimit, AgreesWithBisectionForJointsWithStrength) {
  const Assembly arch = testing::make_arch({.voussoirs = 12, .thickness = 0.16});
  const JointStrength strength{.tension = 500.0, .cohesion = 1000.0, .compression = 1e5};
  for (const auto& [parameter, low, high] :
       {std::tuple{Parameter::friction, 0.05, 0.8}, std::tuple{Parameter::acceleration, 0.0, 1.0},
        std::tuple{Parameter::tilt, 0.0, 40.0}}) {
    Case scene = strong_case(parameter, low, high, 0.7, strength);
    const double direct = critical(scene, arch);
    scene.analysis.limit.method = LimitSearch::Method::bisection;
    EXPECT_NEAR(direct, critical(scene, arch), 1e-3 * direct) << to_string(parameter);
  }
}

TEST(DirectLimit, RefusesCohesionWithoutFriction) {
  const Case scene = strong_case(Parameter::acceleration, 0.0, 2.0, 0.0, {.cohesion = 1000.0});
  EXPECT_THROW(run_limit(scene, testing::box_on_floor({1.0, 0.5, 0.2}), {}), InputError);
}

// The resultant at the base of a tilted cube lies tan(a) / 2 of its side from the middle, whose half is the
// extent.
TEST(DirectLimit, LeastExtentOfTheJoints) {
  Case scene = limit_case(Parameter::joint_extent, 0.01, 1.0, 0.7);
  scene.analysis.limit.relative_width = 1e-5;
  scene.loads.gravity = testing::tilted_gravity(0.4);
  EXPECT_NEAR(critical(scene, testing::box_on_floor({1, 1, 1})), 0.4, 1e-5 * 0.4);
  EXPECT_LE(run_limit(scene, testing::make_arch({.voussoirs = 12, .thickness = 0.16}), {}).value().steps, 9)
      << "Newton's method; the secant method takes 14";
}

// What Newton's method follows is the derivative of the pull: against differences over 1e-4 of the value,
// whose error is of the order of their square and of the 1e-9 of a solve over the step.
TEST(DirectLimit, TheMechanismGivesTheDerivativeOfThePull) {
  const Assembly arch = testing::make_arch({.voussoirs = 12, .thickness = 0.16});
  for (const auto& [parameter, x] :
       {std::pair{Parameter::joint_extent, 0.5}, std::pair{Parameter::friction, 0.3}}) {
    const Case scene = limit_case(parameter, 0.01, 1.0, 0.7);
    const auto at = [&, p = parameter](double value) {
      return rigid_scene(case_at(scene, value),
                         std::shared_ptr<const Assembly>(&arch, [](const Assembly*) {}),
                         p == Parameter::joint_extent ? value : 1.0);
    };
    const auto pull = [&](double value) { return solve_pull(value, at(value), 0.0); };
    const JointsDerivative joints(0.2, at(0.2).problem.contacts, 0.8, at(0.8).problem.contacts);
    const double step = 1e-4 * x;
    const double difference = (pull(x + step).pull - pull(x - step).pull) / (2.0 * step);
    EXPECT_NEAR(joints.slope(pull(x)), difference, 1e-3 * std::abs(difference)) << to_string(parameter);
  }
}

// The bracket is as wide as requested and no wider; a wider one takes fewer solves.
TEST(DirectLimit, BracketsHaveTheWidthRequested) {
  const Assembly arch = testing::make_arch({.voussoirs = 12, .thickness = 0.16});
  int solves = 1000;
  for (const double width : {1e-6, 1e-2}) {
    Case scene = limit_case(Parameter::friction, 0.1, 0.8, 0.7);
    scene.analysis.limit.relative_width = width;
    const Summary summary = run_limit(scene, arch, {}).value();
    EXPECT_EQ(summary.status, Status::stable) << summary.message;
    EXPECT_EQ(summary.accuracy.asked, width);
    EXPECT_LE(summary.accuracy.reached, width);
    EXPECT_GE(summary.accuracy.reached, 0.1 * width);
    EXPECT_LT(summary.steps, solves);
    solves = summary.steps;
  }
}

// Pulls of 1 - x, which decide outside 1 +- `doubt` only. A search closes in on that from both sides, to half
// its width.
TEST(PullSearch, ClosesInOnValuesThatDoNotDecide) {
  const auto at = [](double x) {
    PullSolve solve;
    solve.value = x;
    solve.pull = 1.0 - x;
    return solve;
  };
  for (const double doubt : {0.0, 1e-3}) {
    for (const auto& [low, high] : {std::pair{0.5, 1.7}, {0.99, 100.0}}) {
      constexpr double kEnough = 1e-5;
      PullSearch search(at(low), at(high));
      int trials = 0;
      for (; !search.is_closed(kEnough) && trials < 60; ++trials) {
        const double x = search.next(kEnough);
        ASSERT_GT(x, search.moving.value);
        ASSERT_LT(x, search.admissible.value);
        if (std::abs(x - 1.0) >= doubt)
          search.include(at(x));
        else
          search.leave_out(x);
      }
      EXPECT_LT(trials, 30);
      EXPECT_LE(search.moving.value, 1.0 - doubt);
      EXPECT_GE(search.admissible.value, 1.0 + doubt);
      EXPECT_LE(search.width(), std::max(kEnough, 4.0 * doubt));
    }
  }
}

// With less friction no force is admissible that is not with more.
TEST(DirectLimit, WhatStandsOrMovesThroughoutTheBracketHasNoCriticalFriction) {
  const Assembly arch = testing::make_arch({.voussoirs = 12, .thickness = 0.16});
  const auto limit = [&](double low, double high, double friction) {
    Case scene = limit_case(Parameter::friction, low, high, friction);
    return run_limit(scene, arch, {}).value();
  };
  const Summary stands = limit(0.7, 0.9, 0.7), weaker = limit(0.7, 0.9, 0.1);
  const Summary beyond = limit(0.05, 0.1, 0.7), within = limit(0.05, 0.1, 0.1);
  EXPECT_EQ(stands.status, Status::stable);
  EXPECT_EQ(weaker.status, Status::unconverged) << "the case has a friction of 0.1";
  for (const Summary& stands_at_all : {stands, weaker})
    EXPECT_NE(
        stands_at_all.message.find("no limit above 0.7: the structure stands at every value from 0.7 to 0.9"),
        std::string::npos)
        << stands_at_all.message;
  for (const Summary& moves : {beyond, within})
    EXPECT_NE(moves.message.find("moves at every value from 0.05 to 0.1"), std::string::npos)
        << moves.message;
  EXPECT_EQ(beyond.status, Status::unconverged) << "the case has a friction of 0.7";
  EXPECT_EQ(within.status, Status::moving);
}

// The numbers without a critical value are those of the case, not of an end of the bracket.
TEST(DirectLimit, WithoutACriticalValueTheStateIsThatOfTheCase) {
  const Assembly arch = testing::make_arch({.voussoirs = 12, .thickness = 0.4});
  std::vector<Frame> frames;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { frames.push_back(frame); };
  const Summary s = run_limit(limit_case(Parameter::thickness, 0.5, 2.0, 0.7), arch, sinks).value();
  EXPECT_NE(s.message.find("stands at both ends"), std::string::npos) << s.message;
  EXPECT_NEAR(s.weight_N / free_weight(arch, testing::kG), 1.0, 1e-12);
  EXPECT_NEAR(s.support_reaction_N.z() / s.weight_N, 1.0, 1e-8);
  ASSERT_EQ(frames.size(), 1u);
}

// A slab that its weight presses down and as much again pushes along x slides at a friction of 0.5. No force
// along y changes that; one against x holds it from 0.5 to 1.5 times its weight: what more it bears is sought.
TEST(DirectLimit, WhatNoLoadHoldsMovesAtEveryValue) {
  const Assembly box = testing::box_on_floor({1, 1, 0.2});
  Case scene = limit_case(Parameter::load, 0.0, 1000.0, 0.5);
  const double weight = free_weight(box, 9.81);
  scene.loads.gravity = Vec3(9.81, 0.0, -9.81);
  scene.loads.forces = {{.block = BlockRef{1}, .point = {}, .force = Vec3(0.0, 1.0, 0.0), .time = {}}};
  const Summary none = run_limit(scene, box, {}).value();
  EXPECT_EQ(none.status, Status::moving);
  EXPECT_NE(none.message.find("because no multiple"), std::string::npos) << none.message;
  scene.loads.forces[0].force = Vec3(-weight, 0.0, 0.0);
  const Summary some = run_limit(scene, box, {}).value();
  EXPECT_EQ(some.status, Status::stable);
  ASSERT_TRUE(some.critical) << some.message;
  EXPECT_NEAR(some.critical->stable, 1.5, 1e-8) << "of the solve";
  EXPECT_GT(some.critical->moving, some.critical->stable);
  EXPECT_NE(some.message.find("; it moves again below 0.5;"), std::string::npos) << some.message;
  scene.analysis.limit.method = LimitSearch::Method::bisection;
  const Summary bisected = run_limit(scene, box, {}).value();
  ASSERT_TRUE(bisected.critical) << bisected.message;
  EXPECT_NEAR(bisected.critical->stable, 1.5, 1e-3 * 1.5) << "width of the bracket";
  EXPECT_NE(bisected.message.find("; it moves again at 0;"), std::string::npos) << bisected.message;
  scene.analysis.limit.method = LimitSearch::Method::direct;
  scene.loads.forces[0].force *= 1e-2;
  const Summary between = run_limit(scene, box, {}).value();
  EXPECT_NE(between.message.find("; it stands from 50 up to 150;"), std::string::npos) << between.message;
  scene.loads.forces[0].force *= 1e2;
  scene.analysis.limit.high = 1.2;
  const Summary least = run_limit(scene, box, {}).value();
  ASSERT_TRUE(least.critical) << least.message;
  EXPECT_NEAR(least.critical->stable, 0.5, 1e-8) << "of the solve";
  EXPECT_NE(least.message.find("; it moves again beyond 1.5;"), std::string::npos) << least.message;
  scene.analysis.limit.high = 1000.0;
  scene.analysis.limit.low = 2.0;
  const Summary beyond = run_limit(scene, box, {}).value();
  EXPECT_EQ(beyond.status, Status::unconverged) << "the case has 1";
  EXPECT_NE(beyond.message.find("moves at every value from 2 to 1000; it stands only below, up to 1.5"),
            std::string::npos)
      << beyond.message;
}

// On level beds rounding of the geometry decides about frictions of 1e-10, and in walls, whose head joints
// bear nothing, about those of 1e-8.
TEST(DirectLimit, LevelBedsNeedNoFriction) {
  for (const Assembly& level : {testing::stack_of_cubes(1.0, {1000.0, 1000.0}),
                                testing::running_bond_wall({0.5, 0.25, 0.25}, 4, 6)}) {
    const Summary summary = run_limit(limit_case(Parameter::friction, 0.0, 0.8, 0.7), level, {}).value();
    EXPECT_EQ(summary.status, Status::stable) << summary.message;
    EXPECT_FALSE(summary.critical);
    EXPECT_NE(summary.message.find("stands with a friction of 1e-05, as good as none"), std::string::npos)
        << summary.message;
  }
}

// A force pressing a block down may grow without limit.
TEST(DirectLimit, SaysWhereThereIsNoLimit) {
  Case scene = limit_case(Parameter::load, 0.0, 10.0, 0.3);
  BlockForce press;
  press.block.number = 1;
  press.force = {10.0, 0, -100.0};
  scene.loads.forces = {press};
  std::vector<Frame> frames;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { frames.push_back(frame); };
  const Summary summary = run_limit(scene, testing::box_on_floor({1.0, 0.5, 0.2}), sinks).value();
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  EXPECT_FALSE(summary.critical);
  EXPECT_NE(summary.message.find("no limit: the structure stands at 0 and at every higher value"),
            std::string::npos)
      << summary.message;
  EXPECT_EQ(frames.size(), 1u);
}

// The least peak stress of two blocks on each other is that of the larger weight over the smaller area.
TEST(DirectLimit, LeastPeakStressOfAPier) {
  const Assembly pier = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {10, 10, 1}, .fixed = true},
                                             {.center = {0, 0, 0.5}, .size = {2, 1, 1}},
                                             {.center = {0, 0, 1.5}, .size = {0.5, 0.5, 1}}});
  Case scene = limit_case(Parameter::peak_stress, 0.0, 1.0, 0.3);
  EXPECT_THROW(run_limit(scene, pier, {}), InputError) << "points without area";
  scene.joints.compliance.per = Compliance::Per::area;
  const double weight = 1000.0 * testing::kG, base = 2.25 * weight / 2.0, top = 0.25 * weight / 0.25;
  EXPECT_NEAR(critical(scene, pier), std::max(base, top), 1e-6 * base);
  std::vector<Frame> frames;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { frames.push_back(frame); };
  const Summary summary = run_limit(scene, pier, sinks).value();
  EXPECT_LE(summary.equilibrium_residual.value(), 1e-8);
  ASSERT_EQ(frames.size(), 1u) << "no mechanism";
  scene.loads.gravity = testing::tilted_gravity(0.5);
  EXPECT_EQ(run_limit(scene, pier, {}).value().status, Status::moving);
}

TEST(DirectLimit, IsChosenWhereItApplies) {
  Analysis analysis = limit_case(Parameter::tilt, 0, 1, 0.3).analysis;
  EXPECT_TRUE(uses_direct_limit(analysis));
  analysis.limit.parameter = Parameter::spread;
  EXPECT_FALSE(uses_direct_limit(analysis));
  analysis.limit.parameter = Parameter::friction;
  EXPECT_TRUE(uses_direct_limit(analysis));
  analysis.friction_law = FrictionLaw::coulomb;
  EXPECT_FALSE(uses_direct_limit(analysis));
}

// Sliding of a block opens its contacts: the motion beyond the limit is proven for forces of any size.
TEST(DirectLimit, ProvesTheMotionBeyondTheLimit) {
  Case scene = limit_case(Parameter::acceleration, 0.0, 1.0, 0.4);
  const Summary of_load = run_limit(scene, testing::box_on_floor({1, 1, 0.2}), {}).value();
  EXPECT_NE(of_load.message.find("a mechanism at 0.4"), std::string::npos) << of_load.message;
  EXPECT_EQ(of_load.message.find("1000 times"), std::string::npos) << of_load.message;
  scene = limit_case(Parameter::friction, 0.1, 0.8, 0.7);
  const Summary of_joints =
      run_limit(scene, testing::make_arch({.voussoirs = 12, .thickness = 0.16}), {}).value();
  EXPECT_NE(of_joints.message.find("a mechanism at"), std::string::npos) << of_joints.message;
  EXPECT_EQ(of_joints.message.find("1000 times"), std::string::npos) << of_joints.message;
}

// The state at the critical value balances the loads, and the mechanism moves against no joint.
TEST(DirectLimit, GivesAnAdmissibleStateAndAMechanism) {
  std::vector<Frame> frames;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { frames.push_back(frame); };
  const Summary summary = run_limit(limit_case(Parameter::acceleration, 0.0, 0.5, 0.7),
                                    testing::make_arch({.voussoirs = 12, .thickness = 0.16}), sinks)
                              .value();
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_LE(summary.equilibrium_residual.value(), 1e-8);
  for (int i = 0; i < frames[0].contacts.size(); ++i) EXPECT_GE(frames[0].contacts.normal_force[i], 0.0);
  EXPECT_NE(summary.message.find("groups of blocks move"), std::string::npos) << summary.message;
  EXPECT_TRUE(summary.message.ends_with("under Coulomb's law the critical value is the same or smaller"))
      << summary.message;
  EXPECT_EQ(frames[1].time, 1.0);
  EXPECT_TRUE(summary.message.starts_with("critical acceleration: ")) << summary.message;
}

}  // namespace
}  // namespace cupola::direct_limit_test
