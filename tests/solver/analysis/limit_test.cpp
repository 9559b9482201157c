#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/limit_search.hpp"
#include "solver/analysis/mechanism.hpp"
#include "solver/analysis/thickness.hpp"
#include "tests/solver/motion_scenes.hpp"

// Critical values of plane problems. The expected numbers are closed forms or solutions of linear programmes
// over the friction cones (static and kinematic limit analysis with associated flow). The outcome of the
// static solve is exact in the limit of a small inertia share.

namespace cupola::limit_test {
namespace {

using testing::ArchSpec;
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

/// Whether the assembly as built stands under its weight.
bool stands(const Assembly& assembly, double friction) {
  const Model model = make_model(make_case(friction, 1e-8, 0.01), assembly);
  const State rest = state_at_rest(model);
  ContactDetector detector(assembly, {});
  const ContactSet& contacts = detector.update(rest.poses);
  StaticOptions options;
  options.tolerance = kOutcomeTolerance;
  const StaticSolution solution =
      solve_static(model, rest, contacts, match_memories({}, contacts.points), options);
  EXPECT_NE(solution.outcome, StaticOutcome::unconverged) << solution.message;
  return solution.outcome == StaticOutcome::equilibrium;
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
  EXPECT_EQ(bisect(0.4, 1.0, {1e-6, 0.0}, step_at(0.3)).message,
            "the structure stands at both ends of the bracket, 0.4 and 1; widen the bracket");
  EXPECT_EQ(bisect(0.0, 0.2, {1e-6, 0.0}, step_at(0.3)).message,
            "the structure moves at both ends of the bracket, 0 and 0.2; widen the bracket");
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
  EXPECT_NE(bracket.message.find("undecided from 0.30"), std::string::npos) << bracket.message;
}

// Toppling of a block of base B and height H on a tilting plane: tan a = B / H. Stack of k cubes: tan a = 1 /
// k.
TEST(Tilt, TopplesABlockAtItsDiagonal) {
  const Summary summary =
      run(limit_case(LimitSearch::Parameter::tilt, 5.0, 40.0, 0.8), testing::box_on_floor({1, 1, 2}));
  ASSERT_TRUE(summary.critical) << summary.message;
  EXPECT_NEAR(summary.critical->value, 26.565, 0.03);  // bracket of 1e-3 relative
  EXPECT_LT(summary.critical->stable, summary.critical->moving);
}

TEST(Tilt, TopplesAStackOfCubes) {
  for (const int k : {2, 3, 5}) {
    const Assembly stack = testing::stack_of_cubes(1.0, std::vector<double>(k, 1000.0));
    const Summary summary = run(limit_case(LimitSearch::Parameter::tilt, 2.0, 40.0, 0.8), stack);
    ASSERT_TRUE(summary.critical) << summary.message;
    EXPECT_NEAR(std::tan(summary.critical->value * std::numbers::pi / 180.0) * k, 1.0, 2e-3) << k << " cubes";
  }
}

// Minimum thickness over radius of a semicircular arch of n voussoirs with flat faces, mu = 0.8.
TEST(Arch, MinimumThicknessOfTheSemicircle) {
  struct Row {
    int n;
    double t;
  };
  for (const Row& row : std::initializer_list<Row>{{7, .09570},
                                                   {8, .09997},
                                                   {9, .10153},
                                                   {11, .10459},
                                                   {13, .10253},
                                                   {15, .10607},
                                                   {16, .10708},
                                                   {20, .10735},
                                                   {21, .10670},
                                                   {27, .10672},
                                                   {30, .10741},
                                                   {50, .10744},
                                                   {51, .10736},
                                                   {100, .10746}}) {
    EXPECT_TRUE(stands(make_arch({.voussoirs = row.n, .thickness = 1.005 * row.t}), 0.8)) << row.n;
    EXPECT_FALSE(stands(make_arch({.voussoirs = row.n, .thickness = 0.995 * row.t}), 0.8)) << row.n;
  }
}

// The same for other half-angles of embrace, 27 voussoirs.
TEST(Arch, MinimumThicknessOfOtherEmbraces) {
  struct Row {
    double beta_deg, t;
  };
  for (const Row& row : std::initializer_list<Row>{{30, .001520},
                                                   {45, .007438},
                                                   {60, .022646},
                                                   {75, .053491},
                                                   {90, .10672},
                                                   {110, .23118},
                                                   {120, .34885}}) {
    ArchSpec arch{.voussoirs = 27, .thickness = 1.01 * row.t, .beta_deg = row.beta_deg};
    EXPECT_TRUE(stands(make_arch(arch), 0.8)) << row.beta_deg;
    arch.thickness = 0.99 * row.t;
    EXPECT_FALSE(stands(make_arch(arch), 0.8)) << row.beta_deg;
  }
}

// Minimum friction. The published value for a continuous arch is 0.309215 at any thickness.
TEST(Arch, MinimumFriction) {
  struct Row {
    int n;
    double t, mu;
  };
  for (const Row& row : std::initializer_list<Row>{{27, .12, .38118},
                                                   {27, .15, .35114},
                                                   {27, .20, .30899},
                                                   {10, .12, .38566},
                                                   {10, .25, .30300},
                                                   {20, .15, .35127},
                                                   {100, .20, .30922}}) {
    const Summary summary = run(limit_case(LimitSearch::Parameter::friction, 0.2, 0.6, 0.4),
                                make_arch({.voussoirs = row.n, .thickness = row.t}));
    ASSERT_TRUE(summary.critical) << summary.message;
    EXPECT_NEAR(summary.critical->value, row.mu, 3e-3) << row.n << " voussoirs, t/R " << row.t;
  }
}

// Critical horizontal acceleration over g, which equals the tangent of the critical tilt.
TEST(Arch, CriticalAccelerationAndTilt) {
  struct Row {
    ArchSpec arch;
    double mu, lambda;
  };
  const ArchSpec wide{.voussoirs = 15, .thickness = .10, .beta_deg = 60};
  const ArchSpec wide_thick{.voussoirs = 15, .thickness = .15, .beta_deg = 60};
  for (const Row& row : std::initializer_list<Row>{{{.voussoirs = 27, .thickness = .15}, .4, .05235},
                                                   {{.voussoirs = 27, .thickness = .15}, .6, .14534},
                                                   {{.voussoirs = 20, .thickness = .15}, .6, .14935},
                                                   {{.voussoirs = 27, .thickness = .20}, .6, .28434},
                                                   {wide, .4, .58393},
                                                   {wide_thick, .4, .70921},
                                                   {wide_thick, .6, .92100}}) {
    Case scene = limit_case(LimitSearch::Parameter::acceleration, 0.01, 1.5, row.mu);
    const Summary summary = run(scene, make_arch(row.arch));
    ASSERT_TRUE(summary.critical) << summary.message;
    EXPECT_NEAR(summary.critical->value / row.lambda, 1.0, 5e-3) << row.lambda;
    scene.analysis.limit = {
        .parameter = LimitSearch::Parameter::tilt, .low = 0.1, .high = 60.0, .joints = {}};
    const Summary tilted = run(scene, make_arch(row.arch));
    ASSERT_TRUE(tilted.critical) << tilted.message;
    EXPECT_NEAR(std::tan(tilted.critical->value * std::numbers::pi / 180.0) / row.lambda, 1.0, 5e-3);
  }
}

// Thrust over weight at the springings lies between the minimum and the maximum of limit analysis.
TEST(Arch, ThrustLiesBetweenMinimumAndMaximum) {
  struct Row {
    int n;
    double t, low, high;
  };
  for (const Row& row : std::initializer_list<Row>{
           {27, .15, .17557, .22737}, {20, .15, .17563, .22772}, {27, .12, .19059, .20747}}) {
    Frame frame;
    AnalysisSinks sinks;
    sinks.frame = [&frame](const Frame& f) { frame = f; };
    Case scene = make_case(0.6, 1e-8, 1.0);
    scene.analysis.type = AnalysisType::static_;
    scene.analysis.tolerance = 1e-9;
    const Summary summary = run_static(scene, make_arch({.voussoirs = row.n, .thickness = row.t}), sinks);
    ASSERT_EQ(summary.status, Status::stable) << summary.message;
    Vec3 left = Vec3::Zero(), right = Vec3::Zero();
    for (int i = 0; i < frame.contacts.size(); ++i) {
      if (frame.contacts.block_a[i] == 0) right += frame.contacts.force[i];
      if (frame.contacts.block_b[i] == row.n + 1) left -= frame.contacts.force[i];
    }
    EXPECT_GT(-right.x() / summary.weight_N, row.low);
    EXPECT_LT(-right.x() / summary.weight_N, row.high);
    EXPECT_NEAR(right.z() / summary.weight_N, 0.5, 1e-6);
    EXPECT_NEAR(left.z() / summary.weight_N, 0.5, 1e-6);
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
  const StaticSolution solution = solve_static(model, rest, contacts, match_memories({}, contacts.points),
                                               {.tolerance = 1e-5});
  ASSERT_EQ(solution.outcome, StaticOutcome::moving) << solution.message;
  const Mechanism mechanism = find_mechanism(model, rest, contacts, solution);
  EXPECT_EQ(mechanism.num_groups, 5);
  int hinges = 0;
  for (const MovingJoint& joint : mechanism.joints) {
    EXPECT_TRUE(joint.motion == JointMotion::hinging || joint.motion == JointMotion::closed);
    hinges += joint.motion == JointMotion::hinging;
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

// Load multiplier: a block on a rough floor is pushed with lambda W at its foot and slides at lambda = mu.
TEST(Load, CriticalPushOfABlockIsItsFriction) {
  const Assembly assembly = testing::box_on_floor({2, 2, 0.5});
  Case scene = limit_case(LimitSearch::Parameter::load, 0.0, 1.0, 0.45);
  const double W = assembly.blocks[1].mass * testing::kG;
  scene.loads.forces = {{.block = 1, .point = Vec3(0, 0, 0), .force = Vec3(W, 0, 0), .time = {}}};
  const Summary summary = run(scene, assembly);
  ASSERT_TRUE(summary.critical) << summary.message;
  EXPECT_NEAR(summary.critical->value, 0.45, 1e-3);
}

// Stack of blocks of length 1; the k-th from the top projects by 1 / (2 k): the harmonic overhang.
TEST(Overhang, StandsUpToTheHarmonicSum) {
  for (const int n : {3, 4, 10}) {
    for (const double factor : {0.999, 1.001}) {
      std::vector<testing::BoxSpec> boxes;
      double x = 0.0;
      for (int k = n; k >= 1; --k) {  // from the bottom up
        x += factor * 0.5 / k;
        boxes.push_back({.center = {x, 0, 0.1 + 0.2 * (n - k)}, .size = {1, 0.5, 0.2}, .ring = n - k});
      }
      boxes.insert(boxes.begin(), {.center = {0, 0, -0.1}, .size = {1, 0.5, 0.2}, .fixed = true});
      EXPECT_EQ(stands(testing::make_boxes(boxes), 0.5), factor < 1.0) << n << " blocks, factor " << factor;
    }
  }
}

TEST(Wall, HorizontalLoadFactorAgreesWithFerrisAndTinLoi) {
  struct Row {
    int courses;
    bool whole_first;
    double lambda;
  };
  for (const Row& row : std::initializer_list<Row>{{6, false, .64286},  // published .643
                                                   {6, true, .65000},
                                                   {10, false, .58000},
                                                   {10, true, .59282}}) {
    const Case scene = limit_case(LimitSearch::Parameter::acceleration, 0.3, 0.9, 0.65);
    const Summary summary = run(scene, testing::ferris_wall(row.courses, row.whole_first));
    ASSERT_TRUE(summary.critical) << summary.message;
    EXPECT_NEAR(summary.critical->value / row.lambda, 1.0, 5e-3) << row.courses << " courses";
  }
}

/// Two cards on a floor that lean against each other at `phi` from the vertical. Their feet reach from a to a
/// + w, and they meet on a vertical face.
struct Cards {
  double phi, a = 0.5, w = 0.02;

  double height(double x) const { return x / std::tan(phi); }
  Assembly assembly() const {
    Assembly cards = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {10, 10, 1}, .fixed = true}});
    const Eigen::Vector2d low(0, height(a)), high(0, height(a + w));
    testing::add_voussoir({Eigen::Vector2d{-a - w, 0}, {-a, 0}, low, high}, 1.0, 1000.0, false, 0, &cards);
    testing::add_voussoir({Eigen::Vector2d{a, 0}, {a + w, 0}, high, low}, 1.0, 1000.0, false, 0, &cards);
    compute_mass_properties(&cards);
    return cards;
  }
  /// The minimum thrust H at the top of the vertical face keeps a card from falling inwards about the inner
  /// edge of its foot. By symmetry the thrust is horizontal there, and the floor must resist it: H <= mu W.
  double least_friction() const {
    const double k = (a + w) / a, centroid = a / 3.0 * (k * k * k - 1.0) / (k * k - 1.0);
    return (a - centroid) / height(a + w);
  }
};

TEST(Cards, CriticalFrictionIsHalfTheTangentOfTheInclination) {
  for (const double phi_deg : {15.0, 30.0, 45.0}) {
    const Cards cards{.phi = phi_deg * std::numbers::pi / 180.0};
    const Summary summary =
        run(limit_case(LimitSearch::Parameter::friction, 0.02, 1.0, 0.5), cards.assembly());
    ASSERT_TRUE(summary.critical) << summary.message;
    EXPECT_NEAR(summary.critical->value / cards.least_friction(), 1.0, 2e-3) << phi_deg << " deg";
    // tan(phi) / 2 for cards without thickness; the relative difference is of order w / a.
    EXPECT_NEAR(cards.least_friction() / (0.5 * std::tan(cards.phi)), 1.0, 2.0 * cards.w / cards.a);
  }
}

// One springing moves outwards: the arch follows on three hinges until a fourth forms. A thicker arch reaches
// a larger spread.
TEST(Spread, ThickerArchReachesALargerSpread) {
  double last = 0.0;
  for (const double t : {0.13, 0.15}) {
    Case scene = limit_case(LimitSearch::Parameter::spread, 0.0, 1.0, 0.8);
    scene.analysis.limit.relative_width = 2e-2;
    SupportMove move;
    move.blocks = {0};
    move.displacement = Vec3(0.5, 0, 0);
    scene.supports.moves = {move};
    const Summary summary = run(scene, make_arch({.voussoirs = 27, .thickness = t}));
    ASSERT_TRUE(summary.critical) << summary.message;
    EXPECT_GT(summary.critical->value, last + 0.01) << summary.message;
    last = summary.critical->value;
  }
  EXPECT_LT(last, 1.0);
}

// The thickness is scaled about the centreline of radius 1, down to the minimum thickness.
TEST(Thickness, MinimumOfTheSemicircleAndOfAShallowArch) {
  struct Row {
    double beta_deg, t, least;
  };
  for (const Row& row : std::initializer_list<Row>{{90, .15, .10672}, {60, .05, .022646}}) {
    const Summary summary = run(limit_case(LimitSearch::Parameter::thickness, 0.2, 1.2, 0.8),
                                make_arch({.thickness = row.t, .beta_deg = row.beta_deg}));
    ASSERT_TRUE(summary.critical) << summary.message;
    EXPECT_NEAR(summary.critical->value * row.t / row.least, 1.0, 5e-3) << row.beta_deg;
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

TEST(Limit, RefusesADirectionAlongGravity) {
  Case scene = limit_case(LimitSearch::Parameter::tilt, 1, 2, 0.5);
  scene.analysis.limit.direction = Vec3(0, 0, 1);
  EXPECT_THROW(run(scene, testing::box_on_floor({1, 1, 1})), InputError);
}

TEST(Limit, ReportsABracketWithoutACriticalValue) {
  const Summary summary =
      run(limit_case(LimitSearch::Parameter::tilt, 1, 2, 0.5), testing::box_on_floor({1, 1, 1}));
  EXPECT_EQ(summary.status, Status::unconverged);
  EXPECT_FALSE(summary.critical);
  EXPECT_NE(summary.message.find("stands at both ends of the bracket"), std::string::npos);
}

}  // namespace
}  // namespace cupola::limit_test
