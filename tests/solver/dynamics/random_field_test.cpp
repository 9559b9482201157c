// Random fields: moments and correlation over many seeds, and the laws of joints that read them.
#include "assembly/model/random_field.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "solver/dynamics/joint_laws.hpp"

namespace cupola::random_field_test {
namespace {

constexpr int kSeeds = 4000;

// Over the seeds: mean 1, the coefficient of variation asked for, and the correlation exp(-(r / length)^2) of
// the logarithms in any direction. Tolerances are four standard errors, of a correlation rho (1 - rho^2) /
// sqrt(n).
TEST(RandomField, HasTheMomentsAndTheCorrelationLengthAskedFor) {
  const double variation = 0.2, length = 3.0, s2 = std::log1p(variation * variation);
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, 0.6, 0.8)})
    for (const double r : {0.5 * length, length, 2.0 * length}) {
      const Vec3 here(4.0, -2.0, 7.0), there = here + r * direction;
      double mean = 0.0, squares = 0.0, a2 = 0.0, b2 = 0.0, ab = 0.0;
      for (int seed = 0; seed < kSeeds; ++seed) {
        const RandomField field(seed, "friction", length, variation);
        const double at_here = field.at(here), a = std::log(at_here) + 0.5 * s2,
                     b = std::log(field.at(there)) + 0.5 * s2;
        mean += at_here / kSeeds;
        squares += at_here * at_here / kSeeds;
        a2 += a * a;
        b2 += b * b;
        ab += a * b;
      }
      EXPECT_NEAR(mean, 1.0, 4.0 * variation / std::sqrt(kSeeds));
      EXPECT_NEAR(std::sqrt(squares - mean * mean), variation,
                  4.0 * 1.2 * variation / std::sqrt(2.0 * kSeeds));
      const double rho = std::exp(-(r / length) * (r / length));
      EXPECT_NEAR(ab / std::sqrt(a2 * b2), rho, 4.0 * (1.0 - rho * rho) / std::sqrt(kSeeds)) << r;
    }
}

// Four standard errors of a mean and of a share of uniform numbers.
TEST(RandomField, HasUniformQuantiles) {
  double mean = 0.0, below = 0.0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const double u = RandomField(seed, "gap", 2.0, 1.0).quantile_at(Vec3(1.0, 2.0, 3.0));
    mean += u / kSeeds;
    below += (u < 0.1 ? 1.0 : 0.0) / kSeeds;
  }
  EXPECT_NEAR(mean, 0.5, 4.0 * std::sqrt(1.0 / 12.0 / kSeeds));
  EXPECT_NEAR(below, 0.1, 4.0 * std::sqrt(0.1 * 0.9 / kSeeds));
}

TEST(RandomField, DependsOnSeedAndQuantityOnly) {
  const Vec3 point(1.0, 2.0, 3.0);
  EXPECT_EQ(RandomField(5, "friction", 2.0, 0.3).at(point), RandomField(5, "friction", 2.0, 0.3).at(point));
  EXPECT_NE(RandomField(5, "friction", 2.0, 0.3).at(point), RandomField(6, "friction", 2.0, 0.3).at(point));
  EXPECT_NE(RandomField(5, "friction", 2.0, 0.3).at(point), RandomField(5, "strength", 2.0, 0.3).at(point));
  EXPECT_EQ(RandomField().at(point), 1.0);
}

// Where the field is as good as constant over a joint, its mean over the joint is its value there; a joint
// that is longer than the correlation length has a smaller variation.
TEST(RandomField, IsAveragedOverTheJoint) {
  const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const RandomField smooth(1, "friction", 1e4, 0.3);
  EXPECT_NEAR(smooth.mean_over(square), smooth.at({0.5, 0.5, 0.0}), 1e-4);
  double point = 0.0, mean = 0.0;
  for (int seed = 0; seed < 400; ++seed) {
    const RandomField rough(seed, "friction", 0.2, 0.3);
    point += std::pow(rough.at({0.5, 0.5, 0.0}) - 1.0, 2);
    mean += std::pow(rough.mean_over(square) - 1.0, 2);
  }
  // With r the distance along one edge: the integral of 2 (1 - r) exp(-(r / 0.2)^2), squared, of the logarithm.
  constexpr double kAlongAnEdge = 0.2 * 1.7724538509 - 0.04;
  EXPECT_NEAR(mean / point, kAlongAnEdge * kAlongAnEdge, 4.0 * 0.1 * std::sqrt(2.0 * 2.0 / 400.0))
      << "four standard errors of a ratio of variances";
}

TEST(RandomField, MultipliesTheLawsOfJoints) {
  Assembly assembly;
  assembly.blocks.resize(2);
  const Patch patch{0, 1, JointKind::bed, 0, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 1.0};
  Joints joints;
  joints.friction = 0.5;
  joints.compliance = {1e-9, 2e-9, Compliance::Per::area, {}};
  joints.strength.cohesion = 1e5;
  const JointLaw plain = JointTable(joints, 1).law(assembly, patch, 0.25);
  joints.field = JointField{3, 2.0, 0.2, 0.1, 0.3};
  const JointLaw law = JointTable(joints, 1).law(assembly, patch, 0.25);
  EXPECT_DOUBLE_EQ(law.mu, plain.mu * RandomField(3, "friction", 2.0, 0.2).mean_over(patch.polygon));
  EXPECT_DOUBLE_EQ(law.strength.cohesion,
                   plain.strength.cohesion * RandomField(3, "strength", 2.0, 0.1).mean_over(patch.polygon));
  const double soft = RandomField(3, "compliance", 2.0, 0.3).mean_over(patch.polygon);
  EXPECT_DOUBLE_EQ(law.compliance_normal, plain.compliance_normal * soft);
  EXPECT_DOUBLE_EQ(law.compliance_tangential, plain.compliance_tangential * soft);
  // Means are remembered: those of another polygon and of another field are not the one before.
  Patch moved = patch;
  for (Vec3& point : moved.polygon) point.x() += 3.0;
  const JointTable table(joints, 1);
  EXPECT_NE(table.law(assembly, moved, 0.25).mu, law.mu);
  EXPECT_EQ(table.law(assembly, patch, 0.25).mu, law.mu);
  joints.field->seed = 4;
  EXPECT_NE(JointTable(joints, 1).law(assembly, patch, 0.25).mu, law.mu);
  joints.field->seed = 3;
  joints.field->correlation_length = 1.0;
  EXPECT_NE(JointTable(joints, 1).law(assembly, patch, 0.25).mu, law.mu);
  const RandomField friction(3, "friction", 2.0, 0.2);
  constexpr int kAlong = 50;
  double sum = 0.0;
  for (int i = 0; i < kAlong * kAlong; ++i)
    sum += friction.at({(i / kAlong + 0.5) / kAlong, (i % kAlong + 0.5) / kAlong, 0.0});
  EXPECT_NEAR(law.mu / plain.mu, sum / (kAlong * kAlong), 2e-3)
      << "the remembered mean is the mean; a hundredth of its variation";
}

// The strengths of softening joints vary, their fracture energies do not: 2 G = strength times length. Where
// friction ends the pull at cohesion / mu, that varies with friction, too.
TEST(RandomField, LeavesFractureEnergiesAsTheyAre) {
  Assembly assembly;
  assembly.blocks.resize(2);
  const Patch patch{0, 1, JointKind::bed, 0, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 1.0};
  Joints joints;
  joints.friction = 0.5;
  joints.strength = {.tension = 2e5, .cohesion = 4e5};
  joints.failure = JointFailure::softening;
  joints.fracture_energy = FractureEnergy{50.0, 100.0};
  joints.field = JointField{3, 2.0, 0.2, 0.5, 0.0};
  for (const double cohesion : {4e5, 0.5e5}) {
    joints.strength.cohesion = cohesion;
    const JointLaw law = JointTable(joints, 1).law(assembly, patch, 1.0);
    const double pull = std::min(law.strength.tension, law.strength.cohesion / law.mu);
    EXPECT_DOUBLE_EQ(pull * law.crack.opening, 2.0 * 50.0) << cohesion;
    EXPECT_DOUBLE_EQ(law.strength.cohesion * law.crack.slip, 2.0 * 100.0) << cohesion;
  }
}

}  // namespace
}  // namespace cupola::random_field_test
