// What a search records of what it sought and found: limits, horizontal accelerations, the least fresh mortar.
#include <gtest/gtest.h>

#include "solver/analysis/analysis.hpp"
#include "tests/solver/analysis/limit_scenes.hpp"
#include "tests/solver/construction_runs.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::sought_test {
namespace {

using Method = LimitSearch::Method;
using Parameter = LimitSearch::Parameter;
using testing::limit_case;

/// The record has these texts, and the message has its reason and what else is known.
void expect(const Summary& summary, const Sought& expected) {
  ASSERT_TRUE(summary.sought) << summary.message;
  const Sought& sought = *summary.sought;
  EXPECT_EQ(sought.quantity, expected.quantity);
  EXPECT_EQ(sought.found, expected.found) << summary.message;
  EXPECT_EQ(sought.reason, expected.reason);
  EXPECT_EQ(sought.advice, expected.advice);
  EXPECT_EQ(sought.also, expected.also);
  for (const std::string& clause : {sought.reason, sought.also})
    EXPECT_NE(summary.message.find(clause), std::string::npos) << clause << " of: " << summary.message;
}

Summary limit(Case scene, const Assembly& assembly, Method method = Method::direct) {
  scene.analysis.limit.method = method;
  return run_limit(scene, assembly, {}).value();
}

Assembly slab() {
  return testing::box_on_floor({1, 1, 0.2});
}

// A block of friction 0.3 slides at 0.3 g.
TEST(Sought, ALimitBeyondTheBracketIsNoneInIt) {
  const Case scene = limit_case(Parameter::acceleration, 0.0, 0.1, 0.3);
  const std::string reason = "the structure stands at both ends of the bracket, 0 and 0.1";
  expect(limit(scene, slab()), {"critical acceleration", "no limit from 0 to 0.1", reason,
                                "widen the bracket beyond about 0.3", ""});
  expect(limit(scene, slab(), Method::bisection),
         {"critical acceleration", "not found", reason, "widen the bracket", ""});
}

// The case has a friction of 0.7, with which the arch stands, or of 0.1, with which it falls.
TEST(Sought, WhatTheCaseDoesOtherwiseIsUnknown) {
  const Assembly arch = testing::make_arch({.voussoirs = 12, .thickness = 0.16});
  const auto of = [&](double low, double high, double friction) {
    return limit(limit_case(Parameter::friction, low, high, friction), arch);
  };
  const std::string stands = "the structure stands at every value from 0.7 to 0.9";
  const std::string moves = "the structure moves at every value from 0.05 to 0.1";
  const std::string leaves_out = "the bracket leaves out the case itself, which has a friction of ";
  expect(of(0.7, 0.9, 0.7), {"critical friction", "no limit above 0.7", stands, "", ""});
  expect(of(0.7, 0.9, 0.1), {"critical friction", "unknown", stands, "", leaves_out + "0.1"});
  expect(of(0.05, 0.1, 0.1), {"critical friction", "none", moves, "", ""});
  expect(of(0.05, 0.1, 0.7),
         {"critical friction", "unknown", moves, "", "the case itself stands; " + leaves_out + "0.7"});
  expect(of(0.75, 0.9, 0.7),
         {"critical friction", "no limit above 0.75", "the structure stands at every value from 0.75 to 0.9",
          "", leaves_out + "0.7"});
}

// Pulled by 0 it stands, by 3 g to one side and 2 g to the other it slides.
TEST(Sought, WhatStandsBetweenEndsThatMoveIsUnknown) {
  const Case scene = limit_case(Parameter::acceleration, -3.0, 2.0, 0.3);
  const std::string reason = "the structure moves at both ends of the bracket, -3 and 2";
  const std::string own = "the case itself stands";
  expect(limit(scene, slab()), {"critical acceleration", "unknown", reason, "it must stand at one",
                                "it stands from -0.3 up to 0.3; " + own});
  expect(limit(scene, slab(), Method::bisection),
         {"critical acceleration", "unknown", reason, "it must stand at one", own});
}

// A floor moves by up to 0.5 m, and the slab on it too; or it moves by nothing.
TEST(Sought, OfASpreadTheAdviceIsApart) {
  Case scene = limit_case(Parameter::spread, 0.0, 0.5, 0.3);
  scene.supports.moves = {{.region = {}, .displacement = Vec3(1, 0, 0), .time = {}}};
  const std::string leaves_out = "the bracket leaves out the case itself, which has a spread factor of 1";
  expect(limit(scene, slab(), Method::bisection),
         {"critical spread", "not found", "the structure stands up to the end of the bracket, 0.5",
          "widen the bracket", leaves_out});
  scene.supports.moves.clear();
  expect(limit(scene, slab(), Method::bisection),
         {"critical spread", "not found", "the structure stands, and no support moves",
          "give the motion that it multiplies, supports.moves", leaves_out});
}

/// A slab that slides without a force of 0.5 to 1.5 times its weight, and with a share of the weight as force.
Case held_slab(double share, double high) {
  Case scene = limit_case(Parameter::load, 0.0, high, 0.5);
  scene.loads.gravity = Vec3(9.81, 0.0, -9.81);
  const Vec3 force(-share * free_weight(slab(), 9.81), 0.0, 0.0);
  scene.loads.forces = {{.block = BlockRef{1}, .point = {}, .force = force, .time = {}}};
  return scene;
}

TEST(Sought, ASecondLimitIsWhatElseIsKnown) {
  const Summary most = limit(held_slab(1.0, 1000.0), slab()), least = limit(held_slab(1.0, 1.2), slab());
  const Summary bisected = limit(held_slab(1.0, 1000.0), slab(), Method::bisection);
  for (const Summary* summary : {&most, &least, &bisected}) {
    ASSERT_TRUE(summary->sought && summary->critical) << summary->message;
    EXPECT_EQ(summary->sought->quantity, "critical load");
    EXPECT_EQ(summary->sought->found, "") << "a value";
  }
  EXPECT_TRUE(most.sought->reason.starts_with("an admissible state at 1.5, a mechanism at"))
      << most.sought->reason;
  EXPECT_EQ(most.sought->also, "it moves again below 0.5");
  EXPECT_EQ(least.sought->also, "it moves again beyond 1.5");
  EXPECT_EQ(bisected.sought->also, "it moves again at 0");
}

// No bracket helps what falls by itself.
TEST(Sought, WhatFallsHasALimitWhereItStandsElsewhere) {
  expect(limit(held_slab(0.01, 1000.0), slab()),
         {"critical load", "not found", "the structure moves at both ends of the bracket, 0 and 1000", "",
          "it stands from 50 up to 150"});
  expect(limit(held_slab(0.01, 40.0), slab()),
         {"critical load", "not found", "the structure moves at every value from 0 to 40", "",
          "it stands only above"});
  expect(limit(held_slab(0.01, 40.0), slab(), Method::bisection),
         {"critical load", "none", "the structure moves at both ends of the bracket, 0 and 40", "", ""});
}

TEST(Sought, ALimitOfSomeJointsNamesThem) {
  Case scene = limit_case(Parameter::friction, 0.0, 0.8, 0.7);
  scene.analysis.limit.joints = RingJoints{0, 0, RingJoints::Sort::all, {}};
  const Summary summary = limit(scene, slab());
  ASSERT_TRUE(summary.sought);
  EXPECT_EQ(summary.sought->quantity, "critical friction of the joints of course 0");
  EXPECT_EQ(summary.sought->found, "no limit");
}

// Robustness of a brick that tips about its edges, and of one in a tight pit.
TEST(Sought, HorizontalAccelerations) {
  Case scene = testing::make_case(0.7, 1e-8, 0.01);
  scene.analysis.type = AnalysisType::static_;
  scene.analysis.robustness = 4;
  expect(run_static(scene, testing::box_on_floor({0.2, 0.5, 0.8}), {}),
         {"horizontal acceleration", "",
          "the least of 4 horizontal accelerations that make it move is 0.25 g, towards 0 degrees", "", ""});
  std::vector<testing::BoxSpec> pit{{.center = {0, 0, -0.5}, .size = {10, 10, 1}, .fixed = true},
                                    {.center = {0, 0, 0.5}, .size = {1, 1, 1}}};
  for (const double x : {-1.0, 1.0}) {
    pit.push_back({.center = {x, 0, 0.5}, .size = {1, 1, 1}, .fixed = true});
    pit.push_back({.center = {0, x, 0.5}, .size = {1, 1, 1}, .fixed = true});
  }
  expect(run_static(scene, testing::make_boxes(pit), {}),
         {"horizontal acceleration", "no limit", "no horizontal acceleration in 4 directions makes it move",
          "", ""});
  scene.analysis.robustness = 0;
  EXPECT_FALSE(run_static(scene, slab(), {}).sought);
}

// Courses slide on a slope, a slender block tips over whatever its friction, and level ones need none.
TEST(Sought, TheLeastFreshMortar) {
  Case scene = testing::make_case(0.7, 1e-8, 0.01);
  scene.analysis.type = AnalysisType::staged;
  scene.analysis.staged.fresh.friction = 0.5;
  scene.analysis.staged.least = StagedConstruction::Least::friction;
  const std::string quantity = "critical fresh friction";
  const Assembly wall = testing::running_bond_wall({1.0, 0.5, 0.3}, 2, 2);
  expect(testing::build(scene, wall).summary,
         {quantity, "0", "every stage stands without fresh friction", "", ""});
  scene.loads.gravity = testing::tilted_gravity(0.3);
  const Summary slides = testing::build(scene, wall).summary;
  ASSERT_TRUE(slides.sought && slides.critical) << slides.message;
  EXPECT_EQ(slides.sought->found, "") << "a value";
  EXPECT_TRUE(slides.sought->reason.starts_with("the most demanding is stage ")) << slides.sought->reason;
  const Assembly slender = testing::running_bond_wall({0.16, 0.5, 1.0}, 1, 1);
  const Summary tips = testing::build(scene, slender).summary;
  ASSERT_TRUE(tips.sought);
  EXPECT_EQ(tips.sought->found, "none");
  EXPECT_TRUE(tips.sought->reason.starts_with("no fresh friction up to 10 holds stage 0 in course 0 "))
      << tips.sought->reason;
}

// A beam that stands only with the counterweight of a later course, and may not be laid before.
TEST(Sought, TheLeastFreshMortarOfAStageThatIsNotSearchedIsUnknown) {
  Case scene = testing::make_case(0.6, 1e-8, 0.01);
  scene.analysis.type = AnalysisType::staged;
  scene.analysis.staged.fresh.friction = 0.5;
  scene.analysis.staged.least = StagedConstruction::Least::friction;
  scene.analysis.staged.first_ring = 1;
  const Assembly boxes =
      testing::make_boxes({{.center = {0, 0, -0.5}, .fixed = true},
                           {.center = {0.6, 0, 0.25}, .size = {2, 1, 0.5}, .ring = 0},
                           {.center = {-0.2, 0, 0.75}, .size = {0.4, 1, 0.5}, .density = 5000.0, .ring = 1}});
  expect(testing::build(scene, boxes).summary,
         {"critical fresh friction", "unknown",
          "the least fresh friction of stage 0 in course 0 (block 1) was not found (it is sought from "
          "analysis.staged.first_ring on)",
          "", ""});
}

}  // namespace
}  // namespace cupola::sought_test
