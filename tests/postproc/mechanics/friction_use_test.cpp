#include <array>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "postproc/mechanics/joint_wrenches.hpp"
#include "tests/postproc/models.hpp"

namespace cupola::friction_use_test {
namespace {

constexpr double kMu = 0.7, kArea = 0.24;  // m2, of each of four points

/// The friction use of a single bed with these normal forces (N) and shears at its four corners. With
/// strength, the cohesion (Pa) counts where there is pressure.
double use_of(const std::array<double, 4>& normal, const std::array<Vec3, 4>& shear,
              std::optional<double> cohesion = {}) {
  const Assembly a = test::column(1);
  ContactTable c = test::column_at_rest(a, 9.81, 0.0, 0.6, 0.4).contacts;
  for (size_t i = 0; i < 4; ++i) {
    c.normal_force[i] = normal[i];
    c.force[i] = Vec3(0, 0, normal[i]) + shear[i];
    const double limit = (normal[i] > 0.0 ? cohesion.value_or(0.0) * kArea : 0.0) + kMu * normal[i];
    c.friction_use[i] = limit > 0.0 ? shear[i].norm() / limit : 0.0;
    if (cohesion) c.friction_limit.push_back(limit);
  }
  return joint_wrenches(a, c, shell_of(a, Vec3::UnitZ())).wrenches[0].friction_use;
}

// Shears of 40 N against each other carry nothing: the joint transmits 4 x 7 N of 0.7 x 400 N.
TEST(FrictionUse, DoesNotCountShearsThatOpposeEachOther) {
  const Vec3 x(7, 0, 0), y(0, 40, 0);
  EXPECT_NEAR(use_of({100, 100, 100, 100}, {x + y, x - y, x + y, x - y}), 0.1, 1e-12);
  EXPECT_NEAR(use_of({100, 100, 100, 100}, {y, -y, y, -y}), 0.0, 1e-12);
}

// Statics does not say which points of a joint carry its shear: its use is the same for all of them.
TEST(FrictionUse, DoesNotDependOnWhichPointsCarryTheShear) {
  const Vec3 none = Vec3::Zero(), x(35, 0, 0);
  for (const std::optional<double> cohesion : {std::optional<double>(), std::optional<double>(200.0)}) {
    const double use = 140.0 / (4.0 * cohesion.value_or(0.0) * kArea + kMu * 400.0);
    EXPECT_NEAR(use_of({100, 100, 100, 100}, {x, x, x, x}, cohesion), use, 1e-12);
    EXPECT_NEAR(use_of({100, 100, 100, 100}, {2 * x, 2 * x, none, none}, cohesion), use, 1e-12);
  }
  EXPECT_NEAR(use_of({300, 100, 0, 0}, {none, 2 * x, none, none}), 70.0 / (kMu * 400.0), 1e-12);
}

// In an open hinge, cracked points have neither pressure nor cohesion, whatever strength the joint has or had.
TEST(FrictionUse, CountsNothingForOpenPointsOfJointsWithStrength) {
  const Vec3 none = Vec3::Zero(), x(35, 0, 0);
  EXPECT_NEAR(use_of({200, 0, 0, 0}, {2 * x, none, none, none}, 0.0), 70.0 / (kMu * 200.0), 1e-12);
  EXPECT_NEAR(use_of({100, 100, 0, 0}, {x, x, none, none}, 500.0), 70.0 / (2.0 * 500.0 * kArea + kMu * 200.0),
              1e-12);
}

TEST(FrictionUse, IsOneWhereAllPointsSlide) {
  const double cohesion = 500.0;
  std::array<Vec3, 4> shear;
  const std::array<double, 4> normal{400, 20, 100, 1};
  for (size_t i = 0; i < 4; ++i) shear[i] = (cohesion * kArea + kMu * normal[i]) * Vec3(0.6, 0.8, 0.0);
  EXPECT_NEAR(use_of(normal, shear, cohesion), 1.0, 1e-12);
}

// Of joints with strength that are pulled, too: here 400 N, three quarters of them at x = 0.
TEST(CentreOfPressure, IsTheirsWhereNormalForcesPull) {
  const Assembly a = test::column(1);
  ContactTable c = test::column_at_rest(a, 9.81, 0.0, 0.6, 0.4).contacts;
  for (size_t i = 0; i < 4; ++i) {
    c.normal_force[i] = c.point[i].x() == 0.0 ? -150.0 : -50.0;
    c.force[i] = Vec3(0, 0, c.normal_force[i]);
  }
  const JointWrench joint = joint_wrenches(a, c, shell_of(a, Vec3::UnitZ())).wrenches[0];
  EXPECT_NEAR(joint.centre_of_pressure.x(), 0.3, 1e-12);
  EXPECT_NEAR(joint.eccentricity, 0.3, 1e-12);
  EXPECT_TRUE(std::isnan(joint.kern)) << "of pressure only";
}

// Of a bed that only bends, the forces of its points cancel to rounding: 100 N on two, as much pull on the
// others.
TEST(CentreOfPressure, IsTheCentroidInPureBending) {
  const Assembly a = test::column(1);
  for (const double rest : {0.0, 1e-13, 1e-5}) {  // the last is below the floor of forces, 1e-6 of 60 N
    ContactTable c = test::column_at_rest(a, 9.81, 0.0, 0.6, 0.4).contacts;
    for (size_t i = 0; i < 4; ++i) {
      c.normal_force[i] = (c.point[i].x() == 0.0 ? 100.0 : -100.0) + rest;
      c.force[i] = Vec3(0, 15, c.normal_force[i]);
    }
    const JointWrench joint = joint_wrenches(a, c, shell_of(a, Vec3::UnitZ())).wrenches[0];
    EXPECT_FALSE(joint.negligible) << "60 N of shear";
    EXPECT_EQ(joint.centre_of_pressure, joint.patch.centroid);
    EXPECT_NEAR(joint.wrench.moment.y(), 4 * 100.0 * 0.6, 1e-10) << "rounding of 240 N m";
    EXPECT_EQ(joint.normal_force, 0.0);
    for (const double undefined : {joint.eccentricity, joint.edge_distance, joint.kern})
      EXPECT_TRUE(std::isnan(undefined)) << undefined;
  }
}

// A limit leaves rounding in the open points of a hinge, here beside 2 x 100 N: half of the bed is open.
TEST(OpenShare, CountsPointsUpToTheFloorAsOpen) {
  const Assembly a = test::column(1);
  ContactTable c = test::column_at_rest(a, 9.81, 0.0, 0.6, 0.4).contacts;
  for (size_t i = 0; i < 4; ++i) {
    c.normal_force[i] = i < 2 ? 100.0 : 3.5e-14;
    c.force[i] = Vec3(0, 0, c.normal_force[i]);
  }
  EXPECT_NEAR(joint_wrenches(a, c, shell_of(a, Vec3::UnitZ())).wrenches[0].open_share, 0.5, 1e-12);
}

}  // namespace
}  // namespace cupola::friction_use_test
