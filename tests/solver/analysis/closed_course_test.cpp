#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/solver/construction_runs.hpp"

// Closed courses, courses between uprights, and whole domes against closed forms. theta: slope of the bed; w
// = gamma d h: weight of a course per length; d: depth; h: height; rho: radius.

namespace cupola::closed_course_test {
namespace {

using testing::build;
using testing::Built;
using testing::course_case;
using testing::make_ring;
using testing::normal_force;
using testing::RingSpec;

constexpr double kDeg = std::numbers::pi / 180.0;

Case ring_case(double fresh_friction) {
  Case scene = course_case(0.0, fresh_friction);
  scene.joints.strength = {};
  scene.analysis.staged.first_ring = 1;
  scene.analysis.staged.hold_below = 0;
  JointLawChange head = testing::joint_law(0.0);
  head.normal = 1e-7;
  scene.joints.head = head;
  return scene;
}

// A closed course on a bed of friction mu_b = tan phi needs the hoop force N = w rho tan(theta - phi), for n
// blocks of weight W: W tan(theta - phi) / (2 sin(pi / n)). It has that force where its heads are soft, so
// that the bed slides.
TEST(Construction, ClosedRingHoldsItselfByItsHoopForce) {
  for (const double friction : {0.0, 0.2}) {
    const RingSpec ring{.n = 12, .theta = 38.7 * kDeg};
    const Assembly assembly = make_ring(ring);
    Case scene = ring_case(friction);
    scene.analysis.staged.unit = StagedConstruction::Unit::ring;
    const Built built = build(scene, assembly);
    ASSERT_EQ(built.summary.status, Status::stable) << built.summary.message;
    const double weight = assembly.blocks[12].mass * testing::kG;
    const double expected =
        weight * std::tan(ring.theta - std::atan(friction)) / (2.0 * std::sin(std::numbers::pi / ring.n));
    // Equilibrium within 1e-5 of a block's weight, which is half of the hoop force.
    for (int k = 12; k < 23; ++k)
      EXPECT_NEAR(normal_force(built.frames.back(), k, k + 1) / expected, 1.0, 1e-4) << "mu " << friction;
  }
}

// The last block closes the ring: every open course needs cohesion, the closed one none. The first block
// slides down the steepest slope; one at the free end of a course slides along its radial head, alpha off
// that slope.
TEST(Construction, TheOpenCourseNeedsCohesionAndTheClosedRingNone) {
  const RingSpec ring{.n = 12, .theta = 38.7 * kDeg};
  const Assembly assembly = make_ring(ring);
  Case scene = ring_case(0.2);
  scene.analysis.staged.least = StagedConstruction::Least::cohesion;
  const double area = 2.0 * ring.radius * std::tan(std::numbers::pi / ring.n) * ring.depth;
  const double weight = assembly.blocks[12].mass * testing::kG / area;  // per area of bed
  const double alpha = std::atan(std::cos(ring.theta) * std::tan(std::numbers::pi / ring.n));
  scene.analysis.staged.fresh.cohesion = 1.5 * weight * std::sin(ring.theta);
  const Built built = build(scene, assembly);
  ASSERT_EQ(built.stages.size(), 12u) << built.summary.message;
  for (size_t k = 0; k < 11; ++k) {  // brackets of 1 %
    const double slope = std::sin(ring.theta) * (k == 0 ? 1.0 : std::cos(alpha));
    EXPECT_NEAR(built.least_stands(k) / (weight * (slope - 0.2 * std::cos(ring.theta))), 1.0, 0.01) << k;
  }
  EXPECT_EQ(built.stages[11].at("least_stands"), "0") << built.stages[11].at("note");
}

// A block between two uprights with radial heads, without friction: each head carries N = W tan(theta) / (2
// sin(pi / n)) and closes by its compliance c N / A. The block slips by 2 rho / (L cos theta) times that
// squeeze.
TEST(Construction, WedgeSlipsByTheSqueezeOfItsHeads) {
  const RingSpec ring{.n = 24, .theta = 45.0 * kDeg, .uprights = true};
  const Assembly assembly = make_ring(ring);
  double slips[2];
  for (const int i : {0, 1}) {
    const double compliance = i == 0 ? 1e-9 : 2e-8;
    Case scene = ring_case(0.0);
    scene.joints.head->normal = compliance;
    scene.analysis.staged.unit = StagedConstruction::Unit::ring;
    const Built built = build(scene, assembly);
    ASSERT_EQ(built.summary.status, Status::stable) << built.summary.message;
    const int block = 25;  // the first of the course that is no upright
    const double half = std::numbers::pi / ring.n, weight = assembly.blocks[block].mass * testing::kG;
    const double head_area = ring.depth * ring.height / std::cos(half);
    const double squeeze = compliance * weight * std::tan(ring.theta) / (2.0 * std::sin(half)) / head_area;
    const Vec3 d = built.frames.back().blocks.displacement[block];
    slips[i] = std::hypot(d.x(), d.y(), d.z());
    const double L = 2.0 * ring.radius * std::sin(half);
    // The middle of the block lies above its bed, nearer to the axis, where the clear length is less by 1 %.
    EXPECT_NEAR(slips[i] / (2.0 * ring.radius / (L * std::cos(ring.theta)) * squeeze), 1.0, 0.02);
    EXPECT_NEAR(std::stod(built.stages.back().at("head_squeeze_m")) / squeeze, 1.0, 0.2)
        << "at the worst point";
  }
  EXPECT_NEAR(slips[1] / slips[0], 20.0, 0.5);
}

// With friction mu_h in its heads the same block needs N = W sin theta / (2 [sin(pi / n) cos theta + mu_h cos
// alpha]), where alpha is the angle of the heads to the steepest slope: q / (kappa + 2 mu_h / L) for short
// blocks. It slides into that state, because its heads are soft.
TEST(Construction, WedgeBetweenUprightsNeedsLessThrustWithFrictionInItsHeads) {
  const RingSpec ring{.n = 24, .theta = 45.0 * kDeg, .uprights = true};
  const Assembly assembly = make_ring(ring);
  const int block = 25;
  const double half = std::numbers::pi / ring.n, weight = assembly.blocks[block].mass * testing::kG;
  const double alpha = std::atan(std::cos(ring.theta) * std::tan(half));
  for (const double friction : {0.0, 0.3, 0.6}) {
    Case scene = ring_case(0.0);
    scene.joints.head->friction = friction;
    scene.joints.head->normal = 2e-8;
    scene.analysis.staged.unit = StagedConstruction::Unit::ring;
    const Built built = build(scene, assembly);
    ASSERT_EQ(built.summary.status, Status::stable) << built.summary.message;
    const double needed = weight * std::sin(ring.theta) /
                          (2.0 * (std::sin(half) * std::cos(ring.theta) + friction * std::cos(alpha)));
    // The slip is not quite along the heads, because the block sinks into its bed and tilts.
    EXPECT_NEAR(normal_force(built.frames.back(), 24, block) / needed, 1.0, 0.01) << "mu_h " << friction;
  }
}

// Membrane of a spherical dome that is open above the height H: the hoop force is zero at z with H = z (2 -
// z^2 / R^2), whatever was laid first, because membranes are statically determinate. On a base that lets it
// spread there is no bending.
TEST(Construction, OpenDomeHasNoHoopForceAtHalfItsHeight) {
  const double R = 10.0, step = 5.0 * kDeg;
  const int n = 16, rings = 9;
  const Assembly dome = testing::make_sphere(R, 0.2, step, rings, n);
  Case scene = course_case(0.0, 0.6);
  scene.joints.compliance = {1e-10, 1e-10, Compliance::Per::area};
  scene.joints.strength = {.tension = 1e8, .cohesion = 1e8};
  scene.joints.base = testing::joint_law(0.0);
  StagedConstruction& staged = scene.analysis.staged;
  staged.unit = StagedConstruction::Unit::ring;
  staged.first_ring = 0;
  staged.fresh.cohesion = staged.fresh.tension = 1e8;
  const Built built = build(scene, dome);
  ASSERT_EQ(built.summary.status, Status::stable) << built.summary.message;
  for (size_t stage = 2; stage < static_cast<size_t>(rings); ++stage) {
    const double height = R * std::sin(static_cast<double>(stage + 1) * step);
    double z = 0.0, last_force = 0.0, last_z = 0.0;
    for (int ring = 0; ring <= static_cast<int>(stage) && z == 0.0; ++ring) {
      const int block = n + ring * n;
      const double force = normal_force(built.frames[stage], block, block + 1);
      const double middle = dome.blocks[block].centroid.z();
      if (ring > 0 && force > 0.0 && last_force < 0.0)
        z = last_z + (middle - last_z) * last_force / (last_force - force);
      last_force = force;
      last_z = middle;
    }
    double exact = 0.5 * height;  // fixed point of z = H / (2 - z^2 / R^2)
    for (int i = 0; i < 50; ++i) exact = height / (2.0 - exact * exact / (R * R));
    // The force of a course is the mean over it: the change of sign is found within a fifth of a course.
    EXPECT_NEAR(z / height, exact / height, 0.2 / static_cast<double>(stage + 1)) << "stage " << stage;
  }
}

}  // namespace
}  // namespace cupola::closed_course_test
