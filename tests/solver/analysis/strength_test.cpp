#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/analysis/analysis.hpp"
#include "solver/analysis/statics/static_solve.hpp"
#include "tests/solver/motion_scenes.hpp"

// Rectangular bed joints with strength, against the plastic limits of their resultants.

namespace cupola::strength_statics_test {
namespace {

constexpr double kWidth = 1.0, kDepth = 0.5, kFriction = 0.6;  // m, m
constexpr double kArea = kWidth * kDepth;

Case make_strong_case(const JointStrength& strength, int subdivide) {
  Case scene = testing::make_case(kFriction, 1e-10, 0.01);
  scene.joints.compliance = {1e-10, 1e-10, Compliance::Per::area};
  scene.joints.strength = strength;
  scene.contact.subdivide = subdivide;
  scene.loads.gravity.setZero();  // the load is applied at a point
  return scene;
}

/// A force (N) at (eccentricity, 0, 0) of the bed between a fixed block and one of kWidth x kDepth x 1 m.
StaticOutcome outcome(const Vec3& force, double eccentricity, const JointStrength& strength, int subdivide,
                      FrictionLaw law = FrictionLaw::associated) {
  Case scene = make_strong_case(strength, subdivide);
  scene.loads.forces.push_back({BlockRef{1}, Vec3(eccentricity, 0, 0), force, {}});
  const Assembly assembly = testing::box_on_floor({kWidth, kDepth, 1.0});
  const Model model = make_model(scene, assembly);
  const State rest = state_at_rest(model);
  const ContactSet contacts = ContactDetector(assembly, detection_options(scene)).update(rest.poses);
  StaticOptions options;
  options.tolerance = 1e-6;
  options.solve.law = law;
  return solve_static(model, rest, contacts, match_memories({}, contacts.points), options).outcome;
}

/// Largest value in [low, high] for which `stands` holds, to 1e-4 of the range.
template <class Stands>
double largest(double low, double high, const Stands& stands) {
  const double width = 1e-4 * (high - low);
  while (high - low > width) {
    const double middle = 0.5 * (low + high);
    (stands(middle) == StaticOutcome::equilibrium ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double largest_eccentricity(double n, const JointStrength& strength, int subdivide) {
  return largest(0.0, 0.5 * kWidth, [&](double e) { return outcome({0, 0, -n}, e, strength, subdivide); });
}

// A normal force n at e on a width t that carries at most fc: e = t/2 (1 - n / (fc b t)) (Heyman 1966, "The
// stone skeleton", section on finite strength). The points of the quadrature replace the edge of the
// compressed zone: the error is of second order in the size of a piece. The constant is measured; with five
// points the errors reach a third.
TEST(StrengthStatics, EccentricityTendsToThatOfTheCompressedZone) {
  constexpr double kConstant = 0.75;
  const JointStrength strength{.compression = 1e6};
  for (const int subdivide : {1, 2, 4, 8, 16}) {
    double largest_error = 0.0;
    for (const double use : {1.0 / 12, 0.13, 0.2, 0.3, 0.37, 0.45, 0.61}) {
      const double exact = 0.5 * kWidth * (1.0 - use);
      const double e = largest_eccentricity(use * strength.compression * kArea, strength, subdivide);
      largest_error = std::max(largest_error, std::abs(e / exact - 1.0));
    }
    EXPECT_LE(largest_error, kConstant / (subdivide * subdivide)) << subdivide;
    if (subdivide == 1) {
      EXPECT_GT(largest_error, 0.3);
    }
  }
}

// In a plane scene the points that differ only in y are merged between the faces, so that forces out of the
// plane balance; divided joints have more than two of them on a line.
TEST(StrengthStatics, PlaneScenesWithDividedJointsBalance) {
  for (const int subdivide : {1, 2, 5}) {
    Case scene = make_strong_case({.cohesion = 1e5}, subdivide);
    scene.loads.gravity = testing::tilted_gravity(0.2);
    scene.analysis.type = AnalysisType::static_;
    scene.analysis.plane = true;
    const Summary summary = run_static(scene, testing::box_on_floor({kWidth, kDepth, 0.4}), {});
    EXPECT_EQ(summary.status, Status::stable) << subdivide << ": " << summary.message;
  }
}

// Shear with full normal force in the middle: V = c A + mu N (plastic, point by point) under every flow rule.
TEST(StrengthStatics, ShearIsCohesionPlusFriction) {
  const JointStrength strength{.cohesion = 2e5};
  for (const FrictionLaw law : {FrictionLaw::associated, FrictionLaw::coulomb}) {
    for (const double n : {0.0, 1e5}) {
      const double limit = strength.cohesion * kArea + kFriction * n;
      const auto stands = [&](double v) { return outcome({v, 0, -n}, 0.0, strength, 1, law); };
      EXPECT_EQ(stands(0.999 * limit), StaticOutcome::equilibrium) << to_string(law) << " " << n;
      EXPECT_EQ(stands(1.001 * limit), StaticOutcome::moving) << to_string(law) << " " << n;
    }
  }
}

// Interaction of N, V and M on a bed of width t: with tension f the plastic stress blocks of a pull f over t
// - x and a push F over x carry N = F b x - f b (t - x) at M = b x (t - x) (F + f) / 2; shear c A + mu N is
// independent of M where mu > 0 and all points are at -f or F, if each point slides: |t| <= c + mu n holds
// point by point. The error of M is of second order in the size of a piece, as that of the eccentricity.
TEST(StrengthStatics, BendingTendsToThatOfThePlasticStressBlocks) {
  const JointStrength strength{.tension = 1e5, .cohesion = 1e6, .compression = 5e5};
  for (const int subdivide : {1, 2, 4, 8}) {
    double largest_error = 0.0;
    for (const double x : {0.23, 0.31, 0.47}) {  // m, compressed
      const double n = kDepth * (strength.compression * x - strength.tension * (kWidth - x));
      const double moment = 0.5 * kDepth * x * (kWidth - x) * (strength.compression + strength.tension);
      const double exact = moment / n;
      const double e = largest(0.0, 2.0 * exact, [&](double at) {
        return outcome({0, 0, -n}, at, strength, subdivide);
      });
      largest_error = std::max(largest_error, std::abs(e / exact - 1.0));
    }
    EXPECT_LE(largest_error, 0.75 / (subdivide * subdivide)) << subdivide;
  }
}

// The horizontal acceleration of the ground that makes a block slide is mu + c A / W, by bisection under both
// laws.
TEST(StrengthStatics, CriticalAccelerationOfACohesiveBlock) {
  const Assembly assembly = testing::box_on_floor({1.0, 0.5, 0.1});
  const double weight = assembly.blocks[1].mass * testing::kG;
  Case scene = make_strong_case({.cohesion = 0.3 * weight / kArea}, 1);
  scene.loads.gravity = {0, 0, -testing::kG};
  scene.analysis.type = AnalysisType::limit;
  scene.analysis.tolerance = 1e-6;
  scene.analysis.limit.parameter = LimitSearch::Parameter::acceleration;
  scene.analysis.limit.method = LimitSearch::Method::bisection;
  scene.analysis.limit.high = 2.0;
  for (const FrictionLaw law : {FrictionLaw::associated, FrictionLaw::coulomb}) {
    scene.analysis.friction_law = law;
    const Summary summary = run_limit(scene, assembly, {}).value();
    ASSERT_TRUE(summary.critical) << summary.message;
    EXPECT_LE(summary.critical->stable, kFriction + 0.3 + 1e-6);  // tolerance of the equilibrium
    EXPECT_GE(summary.critical->moving, kFriction + 0.3 - 1e-6);
    EXPECT_NEAR(summary.critical->value, kFriction + 0.3, 1e-3) << "width of the bracket";
  }
}

// A central pull ends at ft A, and at c A / mu where friction ends the cone before.
TEST(StrengthStatics, TensionEndsAtTheStrengthOrTheApexOfTheCone) {
  const double apex = 2e5 / kFriction;
  for (const double tension : {1e5, 1e6}) {
    const JointStrength strength{.tension = tension, .cohesion = 2e5};
    const double limit = std::min(tension, apex) * kArea;
    EXPECT_EQ(outcome({0, 0, 0.999 * limit}, 0.0, strength, 1), StaticOutcome::equilibrium);
    EXPECT_EQ(outcome({0, 0, 1.001 * limit}, 0.0, strength, 1), StaticOutcome::moving);
  }
}

// The dry block rocks about its edge at e = t/2; with tension the pull on the other edge holds it: plastic
// stress blocks of ft over t - x and of an unlimited push on the edge give N (e - t/2) = ft b t^2 / 2.
// Friction leaves cohesion / mu of a larger tension: the share that a pull uses is relative to what is left.
TEST(StrengthStatics, SharesOfStrengthCountWhatFrictionLeavesOfTheTension) {
  for (const auto& [force, share] : {std::pair{0.9 * 1e5 * kArea, 0.9}, {-0.3 * 2e6 * kArea, 0.3}}) {
    Case scene = make_strong_case({3e5, kFriction * 1e5, 2e6}, 1);
    scene.loads.forces.push_back({BlockRef{1}, Vec3(0, 0, 0), Vec3(0, 0, force), {}});
    scene.analysis.type = AnalysisType::static_;
    AnalysisSinks sinks;
    std::vector<double> use;
    sinks.frame = [&](const Frame& frame) { use = frame.contacts.strength_use; };
    run_static(scene, testing::box_on_floor({kWidth, kDepth, 1.0}), sinks);
    ASSERT_FALSE(use.empty());
    for (const double of_point : use) EXPECT_NEAR(of_point, share, 1e-6);
  }
}

TEST(StrengthStatics, TensionHoldsABlockBeyondItsEdge) {
  const JointStrength strength{.tension = 1e4, .cohesion = 1e6};
  const double n = 1e4;
  const double exact = 0.5 * kWidth + 0.5 * strength.tension * kDepth * kWidth * kWidth / n;
  const double e = largest(0.5 * kWidth, 1.5 * exact, [&](double at) {
    return outcome({0, 0, -n}, at, strength, 1);
  });
  EXPECT_NEAR(e / exact, 1.0, 2e-3);  // bisection; the quadrature of a constant stress is exact
}

}  // namespace
}  // namespace cupola::strength_statics_test
