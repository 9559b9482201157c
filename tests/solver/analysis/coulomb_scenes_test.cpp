#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/analysis/analysis.hpp"
#include "tests/solver/motion_scenes.hpp"

// Static equilibrium under Coulomb's law: scenes with closed forms, among them those that jam under the
// associated law.

namespace cupola::coulomb_scenes_test {
namespace {

using testing::kG;

constexpr FrictionLaw kBothLaws[] = {FrictionLaw::associated, FrictionLaw::coulomb};
constexpr double kMargin = 0.02;  // of a critical value; the compliance moves lever arms by far less

Case statics(double mu, FrictionLaw law) {
  Case input;
  input.joints.friction = mu;
  input.joints.compliance = {1e-10, 1e-10, Compliance::Per::point};
  input.analysis.tolerance = 1e-8;
  input.analysis.friction_law = law;
  return input;
}

/// Standing is proven under both laws; a motion need not be under Coulomb's.
void expect_verdict(const Case& input, const Assembly& assembly, bool standing, const std::string& what) {
  const Summary summary = run_static(input, assembly, {});
  EXPECT_EQ(summary.status == Status::stable, standing)
      << what << ", " << to_string(input.analysis.friction_law) << ": " << summary.message;
  EXPECT_EQ(moves(summary.status), !standing)
      << what << ", " << to_string(input.analysis.friction_law) << ": " << summary.message;
}

/// Plate-bande: n equal blocks in a row over the clear length L (m), of depth d (m) and 1 m wide, with
/// vertical joints. Block 0 is a fixed upright at the left. Block 1, the upright at the right, is fixed too,
/// or stands on a plinth and weighs 100 times the row. The free upright is ring 1, everything else ring 0.
struct PlateBande {
  int n = 2;
  double L = 4.0, d = 1.0;
  bool free_upright = false;

  double load() const { return 1000.0 * kG * d; }  ///< q, N/m
  /// Thrust of the arch inside the row whose joints are open at the bottom in the middle and at the top of
  /// the uprights: the largest moment at a joint over the depth. N.
  double arch_thrust() const {
    const double odd = n % 2 == 0 ? 1.0 : 1.0 - 1.0 / (n * n);
    return load() * L * L / (8.0 * d) * odd;
  }
  Assembly assembly() const;
};

Assembly PlateBande::assembly() const {
  const Vec3 upright(1.0, 1.0, 3.0 * d);
  std::vector<testing::BoxSpec> boxes{
      {.center = {-0.5 * L - 0.5, 0, 0}, .size = upright, .fixed = true},
      {.center = {0.5 * L + 0.5, 0, 0}, .size = upright, .fixed = !free_upright, .ring = 1}};
  if (free_upright) {
    boxes[1].density = 1000.0 * 100.0 * L / 3.0;
    const double base = -1.5 * d;  // of the upright
    boxes.push_back({.center = {0.5 * L + 0.5, 0, base - 0.5}, .size = {3, 1, 1}});
    boxes.push_back({.center = {0.5 * L + 0.5, 0, base - 1.5}, .size = {3, 1, 1}, .fixed = true});
  }
  for (int k = 0; k < n; ++k)
    boxes.push_back({.center = {L * ((k + 0.5) / n - 0.5), 0, 0}, .size = {L / n, 1, d}});
  Assembly assembly = testing::make_boxes(boxes);
  assembly.num_rings = 2;
  return assembly;
}

// Between fixed uprights the thrust comes from the rotation of the blocks only, because a block that slides
// along an upright neither opens nor presses the joint. The thrust is that of the arch, H, for any
// compliance, as all joints have the same, and each upright takes q L / 2 by friction: the row stands if
//
//     mu >= q L / (2 H) = 4 d / L   (n even),   4 d / L n^2 / (n^2 - 1)   (n odd).
//
// Under the associated law sliding at an upright presses the row together: it jams at any friction.
TEST(CoulombScenes, PlateBandeBetweenFixedUprightsSlidesBelowItsFriction) {
  for (const PlateBande row : {PlateBande{2, 8.0}, {3, 8.0}, {4, 8.0}, {5, 12.0}}) {
    const Assembly assembly = row.assembly();
    const double critical = 0.5 * row.load() * row.L / row.arch_thrust();
    const std::string what = fmt::format("{} blocks", row.n);
    for (const double share : {0.1, 1.0 - kMargin, 1.0 + kMargin}) {
      const double mu = share * critical;
      expect_verdict(statics(mu, FrictionLaw::associated), assembly, true, what);
      expect_verdict(statics(mu, FrictionLaw::coulomb), assembly, share >= 1.0,
                     what + fmt::format(" at {:g} of the critical friction", share));
    }
  }
}

// Where the upright at the right slides without friction on its plinth and is pressed against the row by the
// force N, the row stands if N >= q L / (2 mu), so that the heads do not slide, and N >= H, so that the row
// does not open as an arch. The law does not matter: nothing resists the opening of a joint that slides.
TEST(CoulombScenes, PlateBandeAgainstAFreeUprightNeedsItsThrust) {
  for (const double mu : {0.2, 0.8}) {
    const PlateBande row{4, 8.0, 1.0, true};
    const double needed = std::max(0.5 * row.load() * row.L / mu, row.arch_thrust());
    ASSERT_EQ(needed == row.arch_thrust(), mu > 0.5) << "the cases differ in what governs";
    const Assembly assembly = row.assembly();
    for (const FrictionLaw law : kBothLaws)
      for (const double share : {1.0 - kMargin, 1.0 + kMargin}) {
        Case input = statics(mu, law);
        RingJoints plinth;
        plinth.from = plinth.to = 1;
        plinth.sort = RingJoints::Sort::bed;
        plinth.law.friction = 0.0;
        input.joints.rings = {plinth};
        const double height = mu > 0.5 ? -0.5 * row.d : 0.0;  // of the thrust at the upright
        input.loads.forces = {
            {.block = 1, .point = Vec3(0, 0, height), .force = Vec3(-share * needed, 0, 0), .time = {}}};
        expect_verdict(input, assembly, share >= 1.0,
                       fmt::format("mu {}, {:g} of the thrust needed", mu, share));
      }
  }
}

// A keystone between walls that lean outward by beta. As it sinks on joints of equal compliance along and
// across, the friction that it needs is 1 / tan(beta) times the normal force. With less it slides, and each
// wall carries
//
//     N (sin beta + mu cos beta) = W / 2,   thrust N (cos beta - mu sin beta)
//
// under either law.
TEST(CoulombScenes, KeystoneThrustsAgainstItsWallsAsItsFrictionGives) {
  for (const double beta_deg : {15.0, 45.0}) {
    const double beta = beta_deg * std::numbers::pi / 180.0;
    const Assembly keystone = testing::wedge_between_walls(beta_deg);
    for (const FrictionLaw law : kBothLaws)
      for (const double mu : {0.1, 0.4, 0.8}) {
        ASSERT_LT(mu, 1.0 / std::tan(beta));
        AnalysisSinks sinks;
        Frame frame;
        sinks.frame = [&frame](const Frame& solved) { frame = solved; };
        const Summary summary = run_static(statics(mu, law), keystone, sinks);
        ASSERT_EQ(summary.status, Status::stable) << summary.message;
        Vec3 from_left = Vec3::Zero();
        for (int i = 0; i < frame.contacts.size(); ++i)
          if (frame.contacts.block_a[i] == 0) from_left += frame.contacts.force[i];
        const double half = 0.5 * keystone.blocks[2].mass * kG;
        const double N = half / (std::sin(beta) + mu * std::cos(beta));
        const Vec3 expected(N * (std::cos(beta) - mu * std::sin(beta)), 0.0, half);
        // Ten times the tolerance of the static solve, for the contact law.
        EXPECT_LE((from_left - expected).norm(), 1e-7 * half)
            << beta_deg << " deg, mu " << mu << ", " << to_string(law) << ": " << from_left.transpose();
      }
  }
}

// Two cards lean against each other at phi from the vertical. Their thrust, from the balance of moments about
// the inner edge of a foot, is what the floor must resist; it does not depend on the law.
TEST(CoulombScenes, LeaningCardsNeedTheFrictionOfTheAssociatedLaw) {
  for (const double phi_deg : {15.0, 45.0}) {
    const testing::LeaningCards cards{.lean = phi_deg * std::numbers::pi / 180.0};
    const Assembly assembly = cards.assembly();
    for (const double share : {1.0 - kMargin, 1.0 + kMargin})
      expect_verdict(statics(share * cards.critical_friction(), FrictionLaw::coulomb), assembly, share >= 1.0,
                     fmt::format("{} deg, {:g} of the critical friction", phi_deg, share));
  }
}

// Walls of ten courses (Ferris and Tin-Loi 2001) under a horizontal load. Linear programmes give the limits
// 0.58000 and 0.59282 under the associated law, the second with whole blocks at the ends of the first course.
// Coulomb's law admits the same forces, so that it cannot carry more. Below the limit no reference decides:
// `stable` is verified by the residuals of equilibrium and of the law, which are computed independently of
// the solver.
TEST(CoulombScenes, WallsOfTenCoursesCarryAtMostTheAssociatedLoad) {
  for (const bool whole_first : {false, true}) {
    const double limit = whole_first ? 0.59282 : 0.58000;
    const Assembly wall = testing::ferris_wall(10, whole_first);
    for (const double share : {0.95, 1.0 + 1e-3}) {
      Case input = statics(0.65, FrictionLaw::coulomb);
      input.loads.gravity = kG * Vec3(share * limit, 0, -1);
      expect_verdict(input, wall, share < 1.0, fmt::format("{:g} of the associated limit", share));
    }
  }
}

// Wall 1 of the same paper carries 0.640 under Coulomb's law and 0.643 under the associated one. Between
// them, blocks at rest under the associated forces solve the contact problem of rigid joints under Coulomb's
// law too. A solver that takes this solution, which costs a fifth, turns Coulomb's limits into associated
// ones.
TEST(CoulombScenes, RigidWallMovesBelowTheAssociatedLimit) {
  const Assembly wall = testing::ferris_wall(6, false);
  for (const double load : {0.62, 0.6415}) {
    Case input = statics(0.65, FrictionLaw::coulomb);
    input.joints.compliance = {0.0, 0.0, Compliance::Per::point};
    input.loads.gravity = kG * Vec3(load, 0, -1);
    expect_verdict(input, wall, load < 0.64, fmt::format("horizontal load {:g} of the weight", load));
  }
}

}  // namespace
}  // namespace cupola::coulomb_scenes_test
