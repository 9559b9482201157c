#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/solver/construction_runs.hpp"

// Open courses block by block against closed forms. theta: slope of the bed; gamma: weight per volume.

namespace cupola::open_course_test {
namespace {

using testing::build;
using testing::Built;
using testing::course_case;
using testing::CourseSpec;
using testing::kGamma;
using testing::make_course;

constexpr double kDeg = std::numbers::pi / 180.0;

// A brick at the free end of a course stands if c >= gamma h (sin theta - mu_b cos theta), wherever it lies
// in the course.
TEST(Construction, FreeEndBrickNeedsTheCohesionOfItsOwnWeight) {
  const CourseSpec course{.bricks = 2};
  const Assembly assembly = make_course(course);
  for (const double theta_deg : {22.9, 38.7, 62.7})
    for (const double friction : {0.0, 0.2, 0.4}) {
      const double theta = theta_deg * kDeg;
      const double needed = kGamma * course.height * (std::sin(theta) - friction * std::cos(theta));
      Case scene = course_case(theta, friction);
      scene.analysis.staged.least = StagedConstruction::Least::cohesion;
      scene.analysis.staged.fresh.cohesion = 1.01 * needed;
      const Built built = build(scene, assembly);
      ASSERT_EQ(built.stages.size(), 2u) << built.summary.message;
      EXPECT_EQ(built.summary.status, Status::stable) << built.summary.message;
      for (size_t k = 0; k < 2; ++k) {  // brackets of 1 %
        EXPECT_NEAR(built.least_stands(k) / needed, 1.0, 0.01) << theta_deg << " deg, mu " << friction;
        EXPECT_NEAR(built.least_moves(k) / needed, 1.0, 0.01) << theta_deg << " deg, mu " << friction;
      }
    }
}

// The same with a given cohesion, sought in the friction of the bed: mu_b >= tan theta - c / (gamma h cos
// theta).
TEST(Construction, FreeEndBrickNeedsTheFrictionThatItsCohesionLeaves) {
  const CourseSpec course{.bricks = 2};
  const Assembly assembly = make_course(course);
  for (const double theta_deg : {22.9, 38.7})
    for (const double cohesion : {0.0, 100.0, 250.0}) {
      const double theta = theta_deg * kDeg;
      const double needed = std::tan(theta) - cohesion / (kGamma * course.height * std::cos(theta));
      ASSERT_GT(needed, 0.0);
      Case scene = course_case(theta, 1.01 * needed);
      scene.analysis.staged.least = StagedConstruction::Least::friction;
      scene.analysis.staged.fresh.cohesion = cohesion;
      const Built built = build(scene, assembly);
      ASSERT_EQ(built.stages.size(), 2u) << built.summary.message;
      for (size_t k = 0; k < 2; ++k) {  // brackets of 1 %
        EXPECT_NEAR(built.least_stands(k) / needed, 1.0, 0.01)
            << theta_deg << " deg, c " << cohesion << " Pa";
        EXPECT_NEAR(built.least_moves(k) / needed, 1.0, 0.01) << theta_deg << " deg, c " << cohesion << " Pa";
      }
    }
}

// The lowest fresh bed carries all fresh courses.
TEST(Construction, FreshCoursesAddTheirWeights) {
  const double theta = 22.9 * kDeg, friction = 0.2;
  for (const int m : {2, 3}) {
    const CourseSpec course{.bricks = 1, .courses = m};
    Case scene = course_case(theta, friction);
    const double needed = m * kGamma * course.height * (std::sin(theta) - friction * std::cos(theta));
    scene.analysis.staged.fresh.courses = m;
    scene.analysis.staged.fresh.cohesion = 1.01 * needed;
    scene.analysis.staged.least = StagedConstruction::Least::cohesion;
    const Built built = build(scene, make_course(course));
    ASSERT_EQ(built.stages.size(), static_cast<size_t>(m)) << built.summary.message;
    EXPECT_NEAR(built.least_stands(m - 1) / needed, 1.0, 0.01);  // a bracket of 1 %
    EXPECT_NEAR(built.least_moves(m - 1) / needed, 1.0, 0.01);
    ASSERT_TRUE(built.summary.critical);
    EXPECT_EQ(built.summary.critical->parameter, "fresh cohesion");
  }
}

// With one fresh course the bed below has hardened when the next course is laid.
TEST(Construction, OnlyTheYoungestBedIsFresh) {
  const double theta = 38.7 * kDeg;
  const CourseSpec course{.bricks = 1, .courses = 2};
  Case scene = course_case(theta, 0.0);
  scene.analysis.staged.fresh.cohesion = 1.01 * kGamma * course.height * std::sin(theta);
  const Built built = build(scene, make_course(course));
  EXPECT_EQ(built.summary.status, Status::stable) << built.summary.message;
  scene.analysis.staged.fresh.courses = 2;
  const Built fails = build(scene, make_course(course));
  EXPECT_EQ(fails.summary.status, Status::moving) << fails.summary.message;
  ASSERT_EQ(fails.failures.size(), 2u);
  for (const auto& row : fails.failures) EXPECT_EQ(row.at("how"), "slides");
}

// A free upright of height H and depth d tips at tan theta = d / H.
TEST(Construction, FreeUprightTipsWhereItsWeightLeavesItsBase) {
  const CourseSpec upright{.bricks = 1, .length = 0.05, .height = 0.17};
  for (const double share : {0.99, 1.01}) {
    Case scene = course_case(std::atan(share * upright.depth / upright.height), 5.0);
    const Built built = build(scene, make_course(upright));
    EXPECT_EQ(to_string(built.summary.status), to_string(share < 1.0 ? Status::stable : Status::moving))
        << built.summary.message;
    if (share > 1.0) {
      ASSERT_EQ(built.failures.size(), 1u);
      EXPECT_EQ(built.failures[0].at("how"), "tips");
      EXPECT_EQ(built.failures[0].at("block"), "2");
    }
  }
}

// Embedded on both sides with cohesion c over the height h_e it holds if 2 c d h_e >= W sin theta; its bed
// has neither friction nor cohesion.
TEST(Construction, EmbeddedUprightHoldsByTheCohesionOfItsSides) {
  const CourseSpec upright{.bricks = 1, .length = 0.05, .height = 0.12, .uprights = true};
  const Assembly assembly = make_course(upright);
  const double theta = 45.0 * kDeg, weight = assembly.blocks[2].mass * testing::kG;
  for (const double share : {0.99, 1.01}) {
    Case scene = course_case(theta, 0.0);
    const double cohesion = share * weight * std::sin(theta) / (2.0 * upright.depth * upright.height);
    scene.joints.head = testing::joint_law(0.0, cohesion);
    const Built built = build(scene, assembly);
    EXPECT_TRUE(share < 1.0 ? moves(built.summary.status) : stands(built.summary.status))
        << built.summary.message;
  }
}

// A flat brick slides without cohesion, the tall one that follows tips with any: no value is that of the
// construction, and the third brick is never laid.
TEST(Construction, NoCohesionIsNamedIfAStageFallsWithAny) {
  const double theta = 38.7 * kDeg, density = kGamma / testing::kG;
  Assembly assembly = testing::make_boxes(
      {{.center = {0, 0, -0.05}, .size = {1, 3, 0.1}, .fixed = true},
       {.center = {0, -1, 0.025}, .size = {0.34, 0.34, 0.05}, .density = density, .ring = 5},
       {.center = {0, 0, 0.2}, .size = {0.1, 0.34, 0.4}, .density = density, .ring = 6},
       {.center = {0, 1, 0.025}, .size = {0.34, 0.34, 0.05}, .density = density, .ring = 7}});
  assembly.num_rings = 8;
  Case scene = course_case(theta, 0.2);
  scene.analysis.staged.least = StagedConstruction::Least::cohesion;
  const Built built = build(scene, assembly);
  ASSERT_EQ(built.stages.size(), 2u) << built.summary.message;
  EXPECT_NE(built.stages[0].at("least_stands"), "");
  EXPECT_EQ(built.stages[1].at("least_stands"), "");
  EXPECT_EQ(built.summary.status, Status::moving);
  EXPECT_FALSE(built.summary.critical) << "only stage 0 has a value";
  EXPECT_TRUE(
      built.summary.message.ends_with("; the construction ends at stage 1, 1 stage was not reached; 0 stages "
                                      "stand without fresh cohesion; no "
                                      "fresh cohesion up to 1 MPa holds stage 1 in course 6 (block 2)"))
      << built.summary.message;
}

// Without `least` there is no mortar with which to go on.
TEST(Construction, EndsAtTheFirstStageThatDoesNotStand) {
  const Built built = build(course_case(38.7 * kDeg, 0.2), make_course({.bricks = 3}));
  EXPECT_EQ(built.summary.status, Status::moving);
  EXPECT_EQ(built.stages.size(), 1u);
  EXPECT_NE(built.summary.message.find("the construction ends at stage 0, 2 stages were not reached"),
            std::string::npos)
      << built.summary.message;
}

}  // namespace
}  // namespace cupola::open_course_test
