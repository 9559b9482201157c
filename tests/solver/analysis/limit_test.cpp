#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/model/thickness.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/record/mechanism.hpp"
#include "solver/analysis/statics/limit_search.hpp"
#include "tests/solver/motion_scenes.hpp"

// The search for critical values. The values themselves are rows of the verification manual.

namespace cupola::limit_test {
namespace {

using testing::make_arch;
using testing::make_case;

Case limit_case(LimitSearch::Parameter parameter, double low, double high, double friction) {
  Case scene = make_case(friction, 1e-8, 0.01);
  scene.analysis.type = AnalysisType::limit;
  scene.analysis.tolerance = 1e-9;
  scene.analysis.limit.parameter = parameter;
  scene.analysis.limit.low = low;
  scene.analysis.limit.high = high;
  return scene;
}

Summary run(const Case& scene, const Assembly& assembly) {
  return run_limit(scene, assembly, {}).value();
}

TEST(Bisect, FindsABracketOrReportsWhyNot) {
  const auto step_at = [](double critical) {
    return [critical](double x) {
      return LimitTrial{x, x < critical ? StaticOutcome::moving : StaticOutcome::equilibrium, 0.0};
    };
  };
  const Bracket found = bisect(0.0, 1.0, {1e-6, 0.0}, step_at(0.3));
  EXPECT_TRUE(found.found);
  EXPECT_GE(found.stable.value, 0.3);
  EXPECT_LT(found.moving.value, 0.3);
  EXPECT_LE(found.stable.value - found.moving.value, 1e-6 * 0.3);
  EXPECT_EQ(clauses(bisect(0.4, 1.0, {1e-6, 0.0}, step_at(0.3)).sought),
            "the structure stands at both ends of the bracket, 0.4 and 1; widen the bracket");
  EXPECT_EQ(clauses(bisect(0.0, 0.2, {1e-6, 0.0}, step_at(0.3)).sought),
            "the structure moves at both ends of the bracket, 0 and 0.2; it must stand at one");
  EXPECT_EQ(bisect(0.0, 1.0, {1e-6, 0.05}, step_at(0.3)).trials, 2 + 5) << "absolute width 1/32 < 0.05";
  const Bracket lost = bisect(0.0, 1.0, {1e-6, 0.0}, [&](double x) {
    return x == 0.5 ? LimitTrial{x, StaticOutcome::unconverged, 0.0} : step_at(0.3)(x);
  });
  // 0.5 lies on the stable side; the bracket is found without it.
  EXPECT_TRUE(lost.narrow);
  EXPECT_GE(lost.stable.value, 0.3);
  EXPECT_LT(lost.moving.value, 0.3);
}

// Trials that do not converge decide nothing: the bracket contains them and the message gives their interval.
TEST(Bisect, KeepsUndecidedValuesInsideTheBracket) {
  const Bracket bracket = bisect(0.0, 1.0, {1e-3, 0.0}, [](double x) {
    if (x > 0.28 && x < 0.31) return LimitTrial{x, StaticOutcome::unconverged, 0.0};
    return LimitTrial{x, x < 0.3 ? StaticOutcome::moving : StaticOutcome::equilibrium, 0.0};
  });
  EXPECT_TRUE(bracket.found);
  EXPECT_FALSE(bracket.narrow);
  EXPECT_NEAR(bracket.stable.value, 0.31, 1e-3);
  EXPECT_NEAR(bracket.moving.value, 0.28, 1e-3);
  EXPECT_NE(bracket.sought.reason.find("undecided from 0.30"), std::string::npos) << bracket.sought.reason;
}

// A width below the spacing of doubles cannot be reached. The middle of adjacent doubles is either of them,
// by the parity of their last bits, so several intervals are tried.
TEST(Bisect, EndsAtAdjacentDoublesBesideUndecidedValues) {
  for (int k = 0; k < 20; ++k) {
    const double low = 0.3 + 0.001 * k, high = low + 1e-6;
    int trials = 0;
    const Bracket bracket = bisect(0.0, 1.0, {1e-30, 0.0}, [&](double x) -> std::optional<LimitTrial> {
      if (++trials > 200) return std::nullopt;  // two bisections take at most 60 trials each
      if (x >= low && x <= high) return LimitTrial{x, StaticOutcome::unconverged, 0.0};
      return LimitTrial{x, x < low ? StaticOutcome::moving : StaticOutcome::equilibrium, 0.0};
    });
    EXPECT_TRUE(bracket.found) << bracket.sought.reason;
    EXPECT_FALSE(bracket.narrow);
  }
}

// Both laws admit the same forces, so that what the associated law proves to move moves under Coulomb's law
// too. The direct method and the bisection share no search.
TEST(Limit, NoArchStandsUnderCoulombsLawBelowTheAssociatedCriticalFriction) {
  for (const double thickness : {0.14, 0.2, 0.4})
    for (const int voussoirs : {9, 12}) {
      const Assembly arch = make_arch({.voussoirs = voussoirs, .thickness = thickness});
      Case scene = limit_case(LimitSearch::Parameter::friction, 0.05, 0.9, 0.7);
      const Summary associated = run(scene, arch);
      scene.analysis.friction_law = FrictionLaw::coulomb;
      const Summary coulomb = run(scene, arch);
      ASSERT_TRUE(associated.critical && coulomb.critical) << associated.message << "; " << coulomb.message;
      EXPECT_GE(coulomb.critical->stable, associated.critical->moving) << thickness << ", " << voussoirs;
    }
}

// At its minimum thickness the semicircle becomes a symmetric five-hinge mechanism. With an odd number of
// voussoirs the crown hinge splits into two, one on each side of the keystone: five groups move and six
// joints hinge.
TEST(Mechanism, SemicircleFormsFiveMovingGroups) {
  const Assembly assembly = make_arch({.voussoirs = 27, .thickness = 0.10138});
  const Model model = make_model(make_case(0.8, 1e-8, 0.01), assembly);
  const State rest = state_at_rest(model);
  ContactDetector detector(assembly, {});
  const ContactSet& contacts = detector.update(rest.poses);
  const StaticSolution solution =
      solve_static(model, rest, contacts, match_memories({}, contacts.points), {.tolerance = 1e-5});
  ASSERT_EQ(solution.outcome, StaticOutcome::moving) << solution.message;
  const Mechanism mechanism =
      find_mechanism(model, rest, contacts, solution.step.problem, solution.increment);
  EXPECT_EQ(mechanism.num_groups, 5);
  int hinges = 0;
  for (const MovingJoint& joint : mechanism.joints) {
    EXPECT_TRUE(joint.motion() == JointMotion::hinging || joint.motion() == JointMotion::closed);
    hinges += joint.motion() == JointMotion::hinging;
  }
  EXPECT_EQ(hinges, 6);
  EXPECT_EQ(mechanism.group.front(), 0) << "the support is at rest";
  EXPECT_GT(mechanism.load_power, 1e-3);
  // The only violation is the elastic closing E gamma of the joints.
  const ContactProblem& problem = solution.step.problem;
  const double closing = problem.E.cwiseProduct(solution.step_solution.gamma).cwiseAbs().maxCoeff();
  EXPECT_LT(mechanism.violation, 1.8 * closing / largest_speed(solution.step_solution.v) + 1e-8)
      << "normal and mu times tangential part";
  EXPECT_LT(mechanism.violation, 1e-3);
}

// One springing moves outwards: the arch follows on three hinges until a fourth forms. A thicker arch reaches
// a larger spread.
TEST(Spread, ThickerArchReachesALargerSpread) {
  double last = 0.0;
  for (const double t : {0.13, 0.15}) {
    Case scene = limit_case(LimitSearch::Parameter::spread, 0.0, 1.0, 0.8);
    scene.analysis.limit.relative_width = 2e-2;
    SupportMove move;
    move.region.blocks = {0};
    move.displacement = Vec3(0.5, 0, 0);
    scene.supports.moves = {move};
    const Summary summary = run(scene, make_arch({.voussoirs = 27, .thickness = t}));
    ASSERT_TRUE(summary.critical) << summary.message;
    EXPECT_GT(summary.critical->value, last + 0.01) << summary.message;
    last = summary.critical->value;
  }
  EXPECT_LT(last, 1.0);
}

// A step that leaves the arch out of balance in the geometry that it reached ends the path: the bracket, of
// which the steps were a fortieth, chose the result.
TEST(Spread, DoesNotDependOnTheBracket) {
  std::vector<double> values;
  for (const double high : {1.0, 40.0}) {
    Case scene = limit_case(LimitSearch::Parameter::spread, 0.0, high, 0.8);
    scene.analysis.limit.relative_width = 2e-2;
    SupportMove move;
    move.region.blocks = {0};
    move.displacement = Vec3(0.5, 0, 0);
    scene.supports.moves = {move};
    const Summary summary = run(scene, make_arch({.voussoirs = 27, .thickness = 0.15}));
    ASSERT_TRUE(summary.critical) << summary.message;
    values.push_back(summary.critical->value);
  }
  for (const double value : values) EXPECT_NEAR(value, values.front(), 1e-9 * values.front());
}

// A lintel bears on 0.2 m of a support that withdraws, and on 1 m of one that stays and bears more: it stands
// until the 0.2 m are used up. Solves that move it by what their own imbalance explains, 12 nm, are no fall.
// 3 %: soft joints end a little earlier, and steps later.
TEST(Spread, ALintelStandsUntilItsBearingIsUsedUp) {
  const Assembly lintel =
      testing::make_boxes({{.center = {-0.5, 0, -0.25}, .size = {1, 1, 0.5}, .fixed = true},
                           {.center = {2.5, 0, -0.25}, .size = {1, 1, 0.5}, .fixed = true},
                           {.center = {0.6, 0, 0.2}, .size = {3.2, 1, 0.4}}});
  for (const double high : {0.3, 1.0}) {
    Case scene = limit_case(LimitSearch::Parameter::spread, 0.0, high, 0.6);
    scene.joints.compliance = {1e-8, 2.4e-8, Compliance::Per::area};
    scene.analysis.friction_law = FrictionLaw::coulomb;
    SupportMove move;
    move.region.blocks = {1};
    move.displacement = Vec3(1, 0, 0);
    scene.supports.moves = {move};
    const Summary summary = run(scene, lintel);
    ASSERT_TRUE(summary.critical) << summary.message;
    EXPECT_NEAR(summary.critical->value, 0.2, 0.03 * 0.2) << summary.message;
  }
}

TEST(Thickness, IsScaledAboutTheMiddleSurface) {
  const Assembly thin = with_thickness(make_arch({.thickness = 0.2}), 0.6);
  const Assembly expected = make_arch({.thickness = 0.12});
  ASSERT_EQ(thin.vertices.size(), expected.vertices.size());
  for (size_t i = 0; i < thin.vertices.size(); ++i)
    EXPECT_LT((thin.vertices[i] - expected.vertices[i]).norm(), 1e-15);
  EXPECT_NEAR(thin.blocks[7].mass, expected.blocks[7].mass, 1e-10);
  EXPECT_THROW(with_thickness(testing::box_on_floor({1, 1, 1}), 0.5), InputError);
}

// Radial joints meet at the centre, where the thickness is twice the radius: there is no thicker arch. A
// thousandth of the edges is left.
TEST(Thickness, TheBracketEndsWhereStonesTurnInsideOut) {
  const Assembly arch = make_arch({.voussoirs = 12, .thickness = 0.4});
  EXPECT_NEAR(largest_thickness(arch).factor, 5.0 - 1e-3 * (5.0 - 1.0), 1e-9);  // rounding
  const auto limit = [&](double low, double high) {
    return run(limit_case(LimitSearch::Parameter::thickness, low, high, 0.7), arch);
  };
  const Summary within = limit(0.1, 2.0), beyond = limit(0.1, 10.0);
  ASSERT_TRUE(within.critical && beyond.critical) << beyond.message;
  EXPECT_NEAR(beyond.critical->value, within.critical->value, 1e-4 * within.critical->value);  // their width
  EXPECT_EQ(within.message.find("turns inside out"), std::string::npos) << within.message;
  EXPECT_NE(beyond.message.find("beyond a thickness factor of 4.996 block"), std::string::npos)
      << beyond.message;
  EXPECT_THROW(limit(6.0, 10.0), InputError);
}

// The case itself stands on the level, as it does at both ends.
TEST(Limit, ReportsABracketWithoutACriticalValue) {
  const Summary summary =
      run(limit_case(LimitSearch::Parameter::tilt, 1, 2, 0.5), testing::box_on_floor({1, 1, 1}));
  EXPECT_EQ(summary.status, Status::stable);
  EXPECT_FALSE(summary.critical);
  EXPECT_NE(summary.message.find("stands at both ends of the bracket"), std::string::npos);
}

// Narrower than two doubles: both ends are given, and the status says that the width was missed.
TEST(Limit, GivesBothEndsOfABracketThatMissedItsWidth) {
  for (const auto method : {LimitSearch::Method::bisection, LimitSearch::Method::direct}) {
    Case scene = limit_case(LimitSearch::Parameter::acceleration, 0.0, 1.0, 0.4);
    scene.analysis.limit.relative_width = 1e-17;
    scene.analysis.limit.method = method;
    const Summary summary = run(scene, testing::box_on_floor({1, 1, 0.2}));
    EXPECT_EQ(summary.status, Status::bracketed) << summary.message;
    EXPECT_FALSE(reached(summary.status)) << "exit code 3";
    ASSERT_TRUE(summary.critical) << summary.message;
    EXPECT_LE(summary.critical->stable, 0.4);
    EXPECT_GE(summary.critical->moving, 0.4);
    EXPECT_GT(summary.accuracy.reached, summary.accuracy.asked);
    EXPECT_NE(summary.message.find("> 1.0e-17 requested"), std::string::npos) << summary.message;
  }
}

// The accuracy is that of the critical value. Displacement and speed of a limit run would be those of a
// mechanism, whose amplitude means nothing.
TEST(LimitSummary, GivesTheBracketAsItsAccuracyAndNoDisplacement) {
  Case scene = limit_case(LimitSearch::Parameter::tilt, 0.0, 40.0, 0.4);
  const Summary s = run(scene, testing::box_on_floor({1.0, 0.5, 0.2}));
  EXPECT_EQ(s.status, Status::stable) << s.message;
  EXPECT_EQ(s.accuracy.quantity, "critical value");
  EXPECT_EQ(s.accuracy.asked, 1e-5) << "of loads in a direct limit analysis";
  const double width = std::abs(s.critical->stable - s.critical->moving) / s.critical->value;
  EXPECT_DOUBLE_EQ(s.accuracy.reached, width);
  EXPECT_FALSE(s.max_displacement_m);
  EXPECT_FALSE(s.max_speed_m_per_s);
  EXPECT_LE(s.equilibrium_residual.value(), kOutcomeTolerance) << "of the stable end";
}

TEST(LimitSummary, HasNoResidualsWithoutAnEquilibrium) {
  Case scene = limit_case(LimitSearch::Parameter::tilt, 30.0, 40.0, 0.4);
  scene.loads.gravity = testing::tilted_gravity(0.6);  // under which the case itself slides
  const Summary s = run(scene, testing::box_on_floor({1.0, 0.5, 0.2}));
  EXPECT_EQ(s.status, Status::moving);
  EXPECT_FALSE(s.equilibrium_residual);
  EXPECT_FALSE(s.contact_law_residual);
  EXPECT_FALSE(s.forces_unique.value);
  EXPECT_TRUE(std::isnan(s.accuracy.reached));
  EXPECT_EQ(s.certified_force_error.bounds, "no equilibrium was found");
}

TEST(StaticSummary, OfAMechanismHasNeitherDisplacementNorSpeed) {
  Case scene = make_case(0.2, 1e-8, 0.01);
  scene.loads.gravity = testing::tilted_gravity(0.3);
  const Assembly assembly = testing::box_on_floor({1.0, 0.5, 0.2});
  const Summary moving = run_static(scene, assembly, {});
  EXPECT_EQ(moving.status, Status::moving) << moving.message;
  EXPECT_FALSE(moving.max_displacement_m);
  EXPECT_FALSE(moving.max_speed_m_per_s);
  scene.joints.friction = 0.6;
  const Summary stable = run_static(scene, assembly, {});
  EXPECT_EQ(stable.status, Status::stable) << stable.message;
  EXPECT_GT(stable.max_displacement_m.value(), 0.0);
  EXPECT_FALSE(stable.max_speed_m_per_s);
  EXPECT_TRUE(stable.forces_unique.value);
  ASSERT_TRUE(stable.largest_law_violation);
  EXPECT_LE(stable.largest_law_violation->value, 1e-6);
}

}  // namespace
}  // namespace cupola::limit_test
