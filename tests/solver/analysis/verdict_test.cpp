// What a verdict proves: `stable` and `moving` of a static analysis against limits in closed form, under both
// laws.

#include <cmath>

#include <gtest/gtest.h>

#include "solver/analysis/analysis.hpp"
#include "solver/analysis/statics/static_solve.hpp"
#include "solver/conic/exact_equilibrium.hpp"
#include "solver/conic/motion_proof.hpp"
#include "tests/solver/keystone.hpp"

namespace cupola::verdict_test {
namespace {

constexpr FrictionLaw kLaws[] = {FrictionLaw::associated, FrictionLaw::coulomb};
constexpr double kPresets[] = {1e-2, 1e-5, 1e-9};  // tolerances of draft and standard, and a fine one

struct Scene {
  Case input;
  Assembly assembly;
  Model model;
  State rest;
  ContactSet contacts;
  ContactMemories memories;

  Scene(const Case& given, Assembly blocks)
      : input(given),
        assembly(std::move(blocks)),
        model(make_model(input, assembly)),
        rest(state_at_rest(model)),
        contacts(ContactDetector(assembly, detection_options(input)).update(rest.poses)),
        memories(match_memories({}, contacts.points)) {}
  Scene(const Scene&) = delete;

  StaticSolution solve(double tolerance, FrictionLaw law) const {
    StaticOptions options;
    options.tolerance = tolerance;
    options.solve.law = law;
    return solve_static(model, rest, contacts, memories, options);
  }
};

// A ratio of forces to loads is no proof: near the critical friction the forces of the equilibrium grow
// without bound. Under Coulomb's law compliant joints that open as the keystone sinks carry nothing, so that
// it falls at any friction. That has no proof.
TEST(Verdict, KeystoneIsProvenToMoveBelowItsCriticalFrictionOnly) {
  for (const double slope : {0.1, 0.3, 0.5})
    for (const double distance : {-1e-2, -1e-3, -1e-4, 1e-4, 1e-3, 2e-3, 1e-2})
      for (const FrictionLaw law : kLaws) {
        const Scene scene(testing::make_case(slope * (1.0 + distance), 1e-9, 0.01), testing::keystone(slope));
        const StaticSolution solution = scene.solve(1e-9, law);
        const bool moves = solution.outcome == StaticOutcome::moving;
        EXPECT_EQ(moves && solution.proven, distance < 0.0)
            << slope << ", " << distance << ", " << to_string(law) << ": " << solution.message;
        if (law == FrictionLaw::associated) {
          EXPECT_EQ(moves, distance < 0.0) << slope << ", " << distance << ": " << solution.message;
        }
      }
}

// The tower tips about its base at tan(tilt) = 1 / cubes.
void expect_no_tower_above_its_limit(int cubes) {
  for (const FrictionLaw law : kLaws)
    for (const double tolerance : kPresets) {
      Case input = testing::make_case(0.7, 1e-9, 0.01);
      input.loads.gravity = testing::tilted_gravity(1.0005 / cubes);
      const Scene scene(input, testing::stack_of_cubes(1.0, std::vector(cubes, 1000.0)));
      const StaticSolution solution = scene.solve(tolerance, law);
      EXPECT_FALSE(solution.outcome == StaticOutcome::equilibrium && solution.proven)
          << cubes << ", " << tolerance << ", " << to_string(law) << ": " << solution.message;
    }
}
TEST(Verdict, NoTowerStandsAboveItsLimitAtAnyAccuracy) {
  for (const int cubes : {50, 200}) expect_no_tower_above_its_limit(cubes);
}
TEST(VerdictSlow, NoTowerOf500StandsAboveItsLimitAtAnyAccuracy) {
  expect_no_tower_above_its_limit(500);
}

// Half of the limit tilt: no bed opens near its edge, and no joint slides. Elastic sway is far larger than
// the first settlement.
TEST(Verdict, SlenderTowerStandsAtHalfOfItsLimit) {
  for (const double compliance : {1e-9, 1e-8})
    for (const FrictionLaw law : kLaws) {
      constexpr int cubes = 500;
      Case input = testing::make_case(0.7, compliance, 0.01);
      input.loads.gravity = testing::tilted_gravity(0.5 / cubes);
      const Scene scene(input, testing::stack_of_cubes(1.0, std::vector(cubes, 2000.0)));
      const StaticSolution solution = scene.solve(1e-5, law);
      EXPECT_EQ(solution.outcome, StaticOutcome::equilibrium)
          << compliance << ", " << to_string(law) << ": " << solution.message;
      EXPECT_TRUE(solution.proven) << compliance << ", " << to_string(law) << ": " << solution.message;
    }
}

// Under Coulomb's law its path passes through displacements of 200 times the first settlement.
TEST(Verdict, SlenderTowerIsJudgedNextToItsLimit) {
  constexpr int cubes = 500;
  for (const double factor : {0.999, 1.001})
    for (const FrictionLaw law : kLaws) {
      Case input = testing::make_case(0.7, 1e-9, 0.01);
      input.loads.gravity = testing::tilted_gravity(factor / cubes);
      const Scene scene(input, testing::stack_of_cubes(1.0, std::vector(cubes, 2000.0)));
      const StaticSolution solution = scene.solve(1e-5, law);
      EXPECT_EQ(solution.outcome, factor < 1.0 ? StaticOutcome::equilibrium : StaticOutcome::moving)
          << factor << ", " << to_string(law) << ": " << solution.message;
      EXPECT_TRUE(solution.proven) << factor << ", " << to_string(law) << ": " << solution.message;
    }
}

// 9 mm are less than 1 % of the block, the default of `contact.margin`: the cube rests on its support in
// every analysis.
TEST(Verdict, CubeAboveItsSupportStandsInEveryAnalysis) {
  const Assembly assembly = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true},
                                                 {.center = {0, 0, 0.509}, .size = {1, 1, 1}}});
  Case input = testing::make_case(0.5, 1e-9, 0.01);
  input.analysis.tolerance = 1e-9;
  input.analysis.type = AnalysisType::static_;
  const Summary statics = run_static(input, assembly, {});
  EXPECT_EQ(statics.status, Status::stable) << statics.message;
  EXPECT_NE(statics.message.find("4 contact points with gaps of up to 9 mm"), std::string::npos)
      << statics.message;
  input.analysis.type = AnalysisType::limit;
  input.analysis.limit.parameter = LimitSearch::Parameter::acceleration;
  for (const auto method : {LimitSearch::Method::direct, LimitSearch::Method::bisection}) {
    input.analysis.limit.method = method;
    const Summary limit = run_limit(input, assembly, {}).value();
    ASSERT_TRUE(limit.critical) << limit.message;
    EXPECT_NEAR(limit.critical->value, 0.5, 1e-3 * 0.5) << limit.message;
    EXPECT_NE(limit.message.find("4 contact points with gaps of up to 9 mm"), std::string::npos)
        << limit.message;
  }
}

// The tower of 200 cubes stood at 1.0008 of its limit in a bracket of 1e-3.
TEST(Verdict, BracketOfBisectionContainsTheLimit) {
  Case input = testing::make_case(0.7, 1e-9, 0.01);
  input.analysis.type = AnalysisType::limit;
  input.analysis.limit.parameter = LimitSearch::Parameter::tilt;
  input.analysis.limit.method = LimitSearch::Method::bisection;
  for (const int cubes : {200, 500}) {
    const double exact = std::atan(1.0 / cubes) * 180.0 / std::numbers::pi;
    input.analysis.limit.low = 0.7 * exact;
    input.analysis.limit.high = 1.4 * exact;
    for (const FrictionLaw law : kLaws) {
      input.analysis.friction_law = law;
      const Summary limit =
          run_limit(input, testing::stack_of_cubes(1.0, std::vector(cubes, 1000.0)), {}).value();
      ASSERT_TRUE(limit.critical) << limit.message;
      EXPECT_LE(limit.critical->stable, exact) << limit.message;
      EXPECT_GE(limit.critical->moving, exact) << limit.message;
    }
  }
}

// A keystone stands from the slope of its walls on. Near it an equilibrium needs large forces, which is no
// proof that none exists.
TEST(Verdict, BisectionOfAKeystoneTakesNoLargeForcesForAMotion) {
  for (const double slope : {0.1, 0.5}) {
    Case input = testing::make_case(0.5, 1e-9, 0.01);
    input.analysis.type = AnalysisType::limit;
    input.analysis.limit.parameter = LimitSearch::Parameter::friction;
    input.analysis.limit.method = LimitSearch::Method::bisection;
    input.analysis.limit.low = 0.0;
    input.analysis.limit.high = 3.0;
    input.analysis.limit.relative_width = 1e-4;
    const Summary limit = run_limit(input, testing::keystone(slope), {}).value();
    ASSERT_TRUE(limit.critical) << limit.message;
    EXPECT_GE(limit.critical->stable, slope) << limit.message;
    EXPECT_LE(limit.critical->moving, slope) << limit.message;
  }
}

// A solve of few iterations shows nothing: the frame is that of an unfinished solve, which the postprocessor
// reports.
TEST(Verdict, LimitThatShowsNothingHasAFrame) {
  Case input = testing::make_case(0.5, 1e-9, 0.01);
  input.analysis.type = AnalysisType::limit;
  input.analysis.limit.parameter = LimitSearch::Parameter::acceleration;
  input.analysis.limit.method = LimitSearch::Method::bisection;
  input.analysis.limit.low = 0.25;
  input.analysis.limit.high = 0.3;
  input.analysis.max_iterations = 1;
  int frames = 0;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { frames += frame.role == FrameRole::unconverged; };
  const Summary summary =
      run_limit(input, testing::stack_of_cubes(1.0, std::vector(5, 1000.0)), sinks).value();
  EXPECT_EQ(summary.status, Status::unconverged) << summary.message;
  EXPECT_EQ(frames, 1) << summary.message;
}

// A cube of friction 0.5 tilts by 26.57 degrees. The ends of the bracket are said in its unit, and a frame
// shows what they showed.
TEST(Verdict, EndsOfALimitWithoutBracketAreShown) {
  const Assembly box = testing::box_on_floor({1, 1, 0.2});
  Case input = testing::make_case(0.5, 1e-9, 0.01);
  input.analysis.type = AnalysisType::limit;
  input.analysis.limit.parameter = LimitSearch::Parameter::tilt;
  const auto expect = [&](double low, double high, const std::string& message) {
    input.analysis.limit.low = low;
    input.analysis.limit.high = high;
    int frames = 0;
    AnalysisSinks sinks;
    sinks.frame = [&](const Frame&) { ++frames; };
    const Summary summary = run_limit(input, box, sinks).value();
    EXPECT_FALSE(summary.critical);
    EXPECT_NE(summary.message.find(message), std::string::npos) << summary.message;
    EXPECT_GT(frames, 0) << summary.message;
  };
  expect(0.0, 20.0, "no limit from 0 to 20: the structure stands at both ends of the bracket");
  expect(30.0, 60.0, "moves at every value from 30 to 60; it stands only below, up to 26.5651");
  input.analysis.limit.parameter = LimitSearch::Parameter::load;
  expect(0.0, 20.0, "no load depends on the parameter; give a load other than weight and fill");
  input.analysis.limit.parameter = LimitSearch::Parameter::friction;
  expect(0.1, 0.9, "no limit above 0.1: the structure stands at every value from 0.1 to 0.9");
}

// A cube on four points carries its weight with forces of a quarter each: exact ones exist next to forces
// that are wrong by 1 %, not next to forces that tip it.
TEST(ExactEquilibrium, ExistsNextToForcesThatNearlyBalance) {
  const Scene scene(testing::make_case(0.5, 1e-9, 0.01), testing::box_on_floor({1, 1, 1}));
  const StepOptions step{.h = 1.0, .time_advance = 0.0};
  const ContactProblem p =
      build_step_problem(scene.model, scene.rest, scene.contacts, scene.memories, step).problem;
  const VecX load = applied_forces(scene.model, scene.rest, 0.0);
  ASSERT_EQ(p.num_contacts(), 4);
  VecX gamma = VecX::Zero(12);
  for (int i = 0; i < 4; ++i) gamma[3 * i] = -0.25 * load[2];
  EXPECT_TRUE(proves_equilibrium(p, load, gamma));
  gamma[0] *= 1.01;
  EXPECT_TRUE(proves_equilibrium(p, load, gamma));
  gamma = VecX::Zero(12);
  gamma[0] = -load[2];  // all on one corner
  EXPECT_FALSE(proves_equilibrium(p, load, gamma));
  VecX pushed = load;
  pushed[0] = -0.6 * load[2];  // above the friction of 0.5: no forces exist
  for (int i = 0; i < 4; ++i) gamma.segment<3>(3 * i) = Vec3(-0.25 * load[2], 0.0, 0.0);
  EXPECT_FALSE(proves_equilibrium(p, pushed, gamma));
}

// Cohesion without tension carries shear where nothing presses the joint: exactly at a normal force of zero,
// which is a limit. A cube is pressed at two opposite corners only, to a tenth of the cohesion; with friction
// they add 2.5 % to the shear that cohesion carries.
TEST(ExactEquilibrium, ExistsWhereCohesionCarriesShearWithoutPressure) {
  const Scene scene(testing::make_case(0.5, 1e-9, 0.01), testing::box_on_floor({1, 1, 1}));
  const StepOptions step{.h = 1.0, .time_advance = 0.0};
  ContactProblem p =
      build_step_problem(scene.model, scene.rest, scene.contacts, scene.memories, step).problem;
  constexpr double kCohesion = 100.0;  // N
  p.strength.assign(p.block_a.size(), {.tension = 0.0, .cohesion = kCohesion});
  const auto corner = [&](int i) { return scene.contacts.points[static_cast<size_t>(i)].point_a; };
  for (const double share : {0.9, 1.1}) {
    VecX gamma = VecX::Zero(12);
    for (int i = 0; i < 4; ++i) {
      const double distance = (corner(i) - corner(0)).norm();
      if (distance < 0.1 || distance > 1.2) gamma[3 * i] = 0.1 * kCohesion;
      gamma[3 * i + 1] = share * kCohesion;
    }
    const VecX load = -generalized_impulse(p, gamma);
    EXPECT_EQ(proves_equilibrium(p, load, gamma), share < 1.0) << share;
  }
}

// A corner whose mortar has opened and bears no push, only pull (joint_damage.hpp), carries nothing.
TEST(ExactEquilibrium, ExistsBesideAnOpenCornerThatBearsNoPush) {
  const Scene scene(testing::make_case(0.5, 1e-9, 0.01), testing::box_on_floor({1, 1, 1}));
  const StepOptions step{.h = 1.0, .time_advance = 0.0};
  ContactProblem p =
      build_step_problem(scene.model, scene.rest, scene.contacts, scene.memories, step).problem;
  const VecX load = applied_forces(scene.model, scene.rest, 0.0);
  const double weight = -load[2];
  p.strength.assign(p.block_a.size(), {.tension = weight, .cohesion = weight});
  p.strength[0].compression = 1e-200;
  const auto corner = [&](int i) { return scene.contacts.points[static_cast<size_t>(i)].point_a; };
  VecX gamma = VecX::Zero(12);
  for (int i = 1; i < 4; ++i)
    if ((corner(i) - corner(0)).norm() < 1.2) gamma[3 * i] = 0.5 * weight;
  EXPECT_TRUE(proves_equilibrium(p, load, gamma));
}

// Sliding resists motion by friction 0.5: a push of 0.49 weights is no proof, one of 0.51 is.
TEST(MotionProof, SlidingBlockIsProvenToMoveAboveItsFriction) {
  const Scene scene(testing::make_case(0.5, 1e-9, 0.01), testing::box_on_floor({1, 1, 0.2}));
  const StepOptions step{.h = 1.0, .time_advance = 0.0};
  const ContactProblem p =
      build_step_problem(scene.model, scene.rest, scene.contacts, scene.memories, step).problem;
  for (const double push : {0.49, 0.51}) {
    VecX load = applied_forces(scene.model, scene.rest, 0.0);
    load[0] = -push * load[2];
    VecX v = VecX::Zero(6);
    v[0] = 1.0;
    v[2] = 0.5 * (1.0 + 1e-9);  // slides and dilates
    EXPECT_EQ(proves_motion(p, load, v), push > 0.5);
    v[2] = 0.5 * (1.0 - 1e-9);  // a force without limit could resist
    EXPECT_FALSE(proves_motion(p, load, v));
    MotionProof proof(p, load);
    EXPECT_EQ(proof.next_to(v).has_value(), push > 0.5);
    EXPECT_EQ(proof.search(), push > 0.5 ? MotionProof::Answer::moves : MotionProof::Answer::admissible);
  }
}

// A block that jams between two walls cannot open its joints. It stays at rest, while the one on it slides.
TEST(MotionProof, JointsAtRestNeedNotOpen) {
  const Scene scene(testing::make_case(0.5, 1e-9, 0.01),
                    testing::make_boxes({{.center = {-1, 0, 0.5}, .fixed = true},
                                         {.center = {1, 0, 0.5}, .fixed = true},
                                         {.center = {0, 0, 0.5}},
                                         {.center = {0, 0, 1.25}, .size = {0.5, 0.5, 0.5}}}));
  const StepOptions step{.h = 1.0, .time_advance = 0.0};
  const ContactProblem p =
      build_step_problem(scene.model, scene.rest, scene.contacts, scene.memories, step).problem;
  for (const double push : {0.49, 0.51}) {
    VecX load = applied_forces(scene.model, scene.rest, 0.0);
    load[6] = -push * load[8];
    EXPECT_EQ(MotionProof(p, load).search(),
              push > 0.5 ? MotionProof::Answer::moves : MotionProof::Answer::admissible);
  }
}

// Tension resists the opening beyond the dilatancy of the slip: a joint that slides and dilates dissipates by
// its cohesion alone.
TEST(MotionProof, SlidingDissipatesByCohesionAlone) {
  const Scene scene(testing::make_case(0.5, 1e-9, 0.01), testing::box_on_floor({1, 1, 0.2}));
  const StepOptions step{.h = 1.0, .time_advance = 0.0};
  ContactProblem p =
      build_step_problem(scene.model, scene.rest, scene.contacts, scene.memories, step).problem;
  const VecX weight = applied_forces(scene.model, scene.rest, 0.0);
  const double cohesion = -0.1 * weight[2];  // N, of each of 4 points
  const double tension = 1.9 * cohesion;     // next to its limit, cohesion / friction
  p.strength.assign(p.block_a.size(), {.tension = tension, .cohesion = cohesion});
  VecX slides = VecX::Zero(6), lifts = VecX::Zero(6);
  slides[0] = 1.0;
  slides[2] = 0.5 * (1.0 + 1e-9);
  lifts[0] = 1.0;
  lifts[2] = 0.7;
  for (const double times : {1.0 - 1e-6, 1.0 + 1e-6}) {
    VecX load = weight;
    load[0] = times * (4.0 * cohesion - 0.5 * weight[2]);
    EXPECT_EQ(proves_motion(p, load, slides), times > 1.0);
    load[0] = times * (4.0 * cohesion + 0.2 * 4.0 * tension - 0.7 * weight[2]);
    EXPECT_EQ(proves_motion(p, load, lifts), times > 1.0);
  }
}

}  // namespace
}  // namespace cupola::verdict_test
