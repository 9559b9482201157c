#include <cmath>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/construction/least_search.hpp"
#include "solver/dynamics/laying_order.hpp"
#include "solver/dynamics/stages.hpp"
#include "tests/solver/course_scenes.hpp"

// Construction block by block against closed forms. theta: slope of the bed; w = gamma d h: weight of a course per length.

namespace cupola::construction_test {
namespace {

using testing::course_case;
using testing::CourseSpec;
using testing::kGamma;
using testing::make_course;
using testing::RingSpec;

constexpr double kDeg = std::numbers::pi / 180.0;

struct Built {
  Summary summary;
  std::vector<Frame> frames;
  std::vector<std::map<std::string, std::string>> stages, failures;
  double least_stands(size_t stage) const { return std::stod(stages.at(stage).at("least_stands")); }
  double least_moves(size_t stage) const { return std::stod(stages.at(stage).at("least_moves")); }
};

std::vector<std::map<std::string, std::string>> parse_rows(const std::string& text) {
  std::vector<std::string> names;
  std::vector<std::map<std::string, std::string>> rows;
  std::istringstream lines(text);
  for (std::string line, cell; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::vector<std::string> values;
    while (std::getline(cells, cell, ',')) values.push_back(cell);
    if (names.empty()) {
      names = values;
      continue;
    }
    rows.emplace_back();
    for (size_t i = 0; i < std::min(names.size(), values.size()); ++i) rows.back()[names[i]] = values[i];
  }
  return rows;
}

Built build(const Case& scene, const Assembly& assembly, AnalysisSinks sinks = {}) {
  Built built;
  std::map<std::string, std::string> tables;
  sinks.frame = [&](const Frame& frame) { built.frames.push_back(frame); };
  sinks.table = [&](const std::string& name, const std::string& text) { tables[name] = text; };
  built.summary = run_analysis(scene, assembly, sinks).value();
  built.stages = parse_rows(tables["construction.csv"]);
  built.failures = parse_rows(tables["failures.csv"]);
  return built;
}

// A brick at the free end of a course stands if c >= gamma h (sin theta - mu_b cos theta), wherever it lies in the course.
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

/// Sum of the normal forces between two blocks, N.
double normal_force(const Frame& frame, int a, int b) {
  double sum = 0.0;
  for (int i = 0; i < frame.contacts.size(); ++i)
    if (frame.contacts.block_a[i] == a && frame.contacts.block_b[i] == b)
      sum += frame.contacts.normal_force[i];
  return sum;
}

Case ring_case(double fresh_friction) {
  Case scene = course_case(0.0, fresh_friction);
  scene.joints.strength = {};
  scene.analysis.staged.first_ring = 1;
  scene.analysis.staged.hold_below = 0;
  scene.joints.head = JointLawChange{.friction = 0.0,
                                     .normal = 1e-7,
                                     .tangential = {},
                                     .tension = {},
                                     .cohesion = {},
                                     .compressive_strength = {},
                                     .fracture_energy = {}};
  return scene;
}

// A closed course on a bed of friction mu_b = tan phi needs the hoop force N = w rho tan(theta - phi), for n blocks of weight W:
// W tan(theta - phi) / (2 sin(pi / n)). It has that force where its heads are soft, so that the bed slides.
TEST(Construction, ClosedRingHoldsItselfByItsHoopForce) {
  for (const double friction : {0.0, 0.2}) {
    const RingSpec ring{.n = 12, .theta = 38.7 * kDeg};
    const Assembly assembly = testing::make_ring(ring);
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

// The last block closes the ring: every open course needs cohesion, the closed one none. The first block slides down the steepest
// slope; one at the free end of a course slides along its radial head, alpha off that slope.
TEST(Construction, TheOpenCourseNeedsCohesionAndTheClosedRingNone) {
  const RingSpec ring{.n = 12, .theta = 38.7 * kDeg};
  const Assembly assembly = testing::make_ring(ring);
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

// A block between two uprights with radial heads, without friction: each head carries N = W tan(theta) / (2 sin(pi / n)) and
// closes by its compliance c N / A. The block slips by 2 rho / (L cos theta) times that squeeze.
TEST(Construction, WedgeSlipsByTheSqueezeOfItsHeads) {
  const RingSpec ring{.n = 24, .theta = 45.0 * kDeg, .uprights = true};
  const Assembly assembly = testing::make_ring(ring);
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

// With friction mu_h in its heads the same block needs N = W sin theta / (2 [sin(pi / n) cos theta + mu_h cos alpha]), where
// alpha is the angle of the heads to the steepest slope: q / (kappa + 2 mu_h / L) for short blocks. It slides into that state, because
// its heads are soft.
TEST(Construction, WedgeBetweenUprightsNeedsLessThrustWithFrictionInItsHeads) {
  const RingSpec ring{.n = 24, .theta = 45.0 * kDeg, .uprights = true};
  const Assembly assembly = testing::make_ring(ring);
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

// A course with parallel heads between uprights slides as a whole under Coulomb's law: nothing presses its heads, even where an arch
// could stand (mu_h > 4 d / L, tests/solver/analysis/coulomb_scenes_test.cpp). Dilatancy jams it at any friction. In stiff joints
// the jammed state must not be taken for one of Coulomb's law.
TEST(Construction, PlateBandeBetweenUprightsJamsOnlyUnderTheAssociatedLaw) {
  const CourseSpec course{.bricks = 4, .length = 0.68, .uprights = true};  // L = 8 d
  const Assembly assembly = make_course(course);
  for (const double compliance : {1e-10, 1e-13})
    for (const double share : {0.2, 0.98, 1.02})
      for (const FrictionLaw law : {FrictionLaw::associated, FrictionLaw::coulomb}) {
        Case scene = course_case(38.7 * kDeg, 0.0);
        scene.analysis.staged.unit = StagedConstruction::Unit::ring;
        scene.analysis.friction_law = law;
        scene.joints.compliance = {compliance, compliance, Compliance::Per::area};
        scene.joints.head = JointLawChange{.friction = share * 0.5,
                                           .normal = {},
                                           .tangential = {},
                                           .tension = 0.0,
                                           .cohesion = 0.0,
                                           .compressive_strength = {},
                                           .fracture_energy = {}};
        const Built built = build(scene, assembly);
        EXPECT_EQ(to_string(built.summary.status),
                  to_string(law == FrictionLaw::associated ? Status::stable : Status::moving))
            << compliance << " m3/N, " << share << ", " << to_string(law) << ": " << built.summary.message;
      }
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

// Embedded on both sides with cohesion c over the height h_e it holds if 2 c d h_e >= W sin theta; its bed has neither friction nor
// cohesion.
TEST(Construction, EmbeddedUprightHoldsByTheCohesionOfItsSides) {
  const CourseSpec upright{.bricks = 1, .length = 0.05, .height = 0.12, .uprights = true};
  const Assembly assembly = make_course(upright);
  const double theta = 45.0 * kDeg, weight = assembly.blocks[2].mass * testing::kG;
  for (const double share : {0.99, 1.01}) {
    Case scene = course_case(theta, 0.0);
    const double cohesion = share * weight * std::sin(theta) / (2.0 * upright.depth * upright.height);
    scene.joints.head = JointLawChange{.friction = 0.0,
                                       .normal = {},
                                       .tangential = {},
                                       .tension = 0.0,
                                       .cohesion = cohesion,
                                       .compressive_strength = {},
                                       .fracture_energy = {}};
    const Built built = build(scene, assembly);
    EXPECT_EQ(to_string(built.summary.status), to_string(share < 1.0 ? Status::moving : Status::stable))
        << built.summary.message;
  }
}

// Column of m cubes of weight W with joints of compliance c over the area A. A block is laid where the one below then is, and settles by
// what is laid on the joints below it from then on: W c / A per joint and stage. The joint of the block just laid is fresh.
TEST(Construction, CarriedColumnSettlesFromTheBirthOfEachBlock) {
  const int m = 4;
  const Assembly column = testing::stack_of_cubes(1.0, std::vector<double>(m, 1000.0));
  const double c = 1e-9, fresh = 5e-9, weight = 1000.0 * testing::kG;
  std::vector<double> sank(m, 0.0);
  for (int stage = 0; stage < m; ++stage) {
    if (stage > 0) sank[stage] = sank[stage - 1];
    for (int k = 0; k <= stage; ++k)
      for (int joint = 0; joint <= k; ++joint) sank[k] += (joint == stage ? fresh : c) * weight;
  }
  for (const bool carry : {false, true}) {
    Case scene = course_case(0.0, 0.4);
    scene.joints.strength = {};
    scene.joints.compliance = {c, c, Compliance::Per::area};
    scene.analysis.staged.first_ring = 0;
    scene.analysis.staged.carry = carry;
    if (carry) scene.analysis.staged.fresh.normal = fresh;
    const Built built = build(scene, column);
    ASSERT_EQ(built.summary.status, Status::stable) << built.summary.message;
    ASSERT_EQ(built.frames.size(), static_cast<size_t>(m));
    for (int k = 0; k < m; ++k) {
      double from_rest = 0.0;
      for (int j = 0; j <= k; ++j) from_rest += (m - j) * c * weight;
      const double found = -built.frames.back().blocks.displacement[k + 1].z();
      EXPECT_NEAR(found / (carry ? sank[k] : from_rest), 1.0, 1e-4)
          << "block " << k << (carry ? ", carried" : "");
      EXPECT_NEAR(normal_force(built.frames.back(), k, k + 1) / ((m - k) * weight), 1.0, 1e-4);
    }
  }
}

// Membrane of a spherical dome that is open above the height H: the hoop force is zero at z with H = z (2 - z^2 / R^2), whatever was
// laid first, because membranes are statically determinate. On a base that lets it spread there is no bending.
TEST(Construction, OpenDomeHasNoHoopForceAtHalfItsHeight) {
  const double R = 10.0, step = 5.0 * kDeg;
  const int n = 16, rings = 9;
  const Assembly dome = testing::make_sphere(R, 0.2, step, rings, n);
  Case scene = course_case(0.0, 0.6);
  scene.joints.compliance = {1e-10, 1e-10, Compliance::Per::area};
  scene.joints.strength = {.tension = 1e8, .cohesion = 1e8};
  scene.joints.base = JointLawChange{.friction = 0.0,
                                     .normal = {},
                                     .tangential = {},
                                     .tension = 0.0,
                                     .cohesion = 0.0,
                                     .compressive_strength = {},
                                     .fracture_energy = {}};
  StagedConstruction& staged = scene.analysis.staged;
  staged.unit = StagedConstruction::Unit::ring;
  staged.first_ring = 0;
  staged.fresh.cohesion = staged.fresh.tension = 1e8;
  const Built built = build(scene, dome);
  ASSERT_EQ(built.summary.status, Status::stable) << built.summary.message;
  for (const size_t stage : {6u, 8u}) {
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
    // A course is a tenth of the height; the force of a course is the mean over it.
    EXPECT_NEAR(z / height, exact / height, 0.02) << "stage " << stage;
  }
}

// Two courses below the course laid, instead of all, change neither the verdict nor the cohesion; a stack of courses settles less.
TEST(Construction, HoldingLowerCoursesKeepsTheLeastCohesion) {
  const double theta = 38.7 * kDeg;
  const CourseSpec course{.bricks = 2, .courses = 6};
  const Assembly assembly = make_course(course);
  double least[2];
  for (const int i : {0, 1}) {
    Case scene = course_case(theta, 0.2);
    scene.analysis.staged.first_ring = testing::kFirstCourse + 5;
    scene.analysis.staged.hold_below = i == 0 ? -1 : 2;
    scene.analysis.staged.least = StagedConstruction::Least::cohesion;
    scene.analysis.staged.fresh.cohesion = 2000.0;
    const Built built = build(scene, assembly);
    ASSERT_EQ(built.stages.size(), 2u) << built.summary.message;
    EXPECT_EQ(built.stages[1].at("blocks"), i == 0 ? "13" : "6");
    least[i] = built.least_stands(1);
  }
  EXPECT_NEAR(least[1] / least[0], 1.0, 0.01) << "brackets of 1 %";
}

TEST(Construction, ResumesWithTheSameBits) {
  Case scene = course_case(38.7 * kDeg, 0.2);
  scene.analysis.staged.least = StagedConstruction::Least::cohesion;
  scene.analysis.staged.fresh.cohesion = 2000.0;
  const Assembly assembly = make_course({.bricks = 3, .courses = 2});
  const Built whole = build(scene, assembly);
  std::string bytes;
  int asked = 0;
  std::vector<Frame> frames;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { frames.push_back(frame); };
  sinks.checkpoint = [&](const std::string& written) { bytes = written; };
  sinks.interrupted = [&] { return ++asked == 4; };
  EXPECT_FALSE(run_analysis(scene, assembly, sinks));
  AnalysisSinks again;
  again.resume_from = bytes;
  const Built rest = build(scene, assembly, again);
  ASSERT_EQ(frames.size() + rest.frames.size(), whole.frames.size());
  ASSERT_EQ(frames.size(), 4u);
  for (size_t i = 0; i < rest.frames.size(); ++i)
    for (int k = 0; k < rest.frames[i].contacts.size(); ++k)
      ASSERT_EQ(rest.frames[i].contacts.force[k], whole.frames[i + 4].contacts.force[k]);
  EXPECT_EQ(rest.summary.message, whole.summary.message);
  ASSERT_EQ(rest.stages.size(), whole.stages.size());
  for (size_t i = 0; i < rest.stages.size(); ++i)
    EXPECT_EQ(rest.stages[i].at("least_stands"), whole.stages[i].at("least_stands"));
}

// A joint with a support is fresh while the course of its block is laid, and no longer.
TEST(Construction, JointsWithSupportsHaveTheAgeOfTheirBlocks) {
  const double theta = 38.7 * kDeg;
  Assembly assembly = testing::make_boxes(
      {{.center = {0, 0, -0.05}, .size = {1, 3, 0.1}, .fixed = true},
       {.center = {0, 0, 0.025}, .size = {0.34, 0.34, 0.05}, .density = kGamma / testing::kG, .ring = 3},
       {.center = {0, 1, 0.025}, .size = {0.34, 0.34, 0.05}, .density = kGamma / testing::kG, .ring = 4}});
  assembly.num_rings = 5;
  Case scene = course_case(theta, 0.0);
  scene.analysis.staged.first_ring = 3;
  scene.analysis.staged.least = StagedConstruction::Least::cohesion;
  const Built built = build(scene, assembly);
  ASSERT_EQ(built.stages.size(), 2u) << built.summary.message;
  const double needed = kGamma * 0.05 * std::sin(theta);
  for (size_t k = 0; k < 2; ++k) EXPECT_NEAR(built.least_stands(k) / needed, 1.0, 0.01);
  EXPECT_EQ(built.failures.front().at("block"), "1");
  EXPECT_EQ(built.failures.back().at("block"), "2") << "block 1 has hardened";
}

// Without `least` there is no mortar with which to go on.
TEST(Construction, EndsAtTheFirstStageThatDoesNotStand) {
  const Built built = build(course_case(38.7 * kDeg, 0.2), make_course({.bricks = 3}));
  EXPECT_EQ(built.summary.status, Status::moving);
  EXPECT_EQ(built.stages.size(), 1u);
  EXPECT_NE(built.summary.message.find("the construction ends there, 2 stages were not reached"),
            std::string::npos)
      << built.summary.message;
}

// Ages of 0 and 1 course, interpolated at 5 days for courses of 5 days.
TEST(Construction, CuringInterpolatesBetweenAges) {
  StagedConstruction staged;
  staged.days_per_course = 5.0;
  JointLawChange young, old;
  young.cohesion = 1000.0;
  old.cohesion = 5000.0;
  staged.curing = {{0.0, young}, {20.0, old}};
  Joints joints;
  add_fresh_joints(staged, 10, 10, &joints);
  ASSERT_EQ(joints.rings.size(), 5u) << "ages of 0, 5, 10, 15 and 20 days";
  for (const RingJoints& group : joints.rings) {
    EXPECT_EQ(group.from, group.to);
    EXPECT_DOUBLE_EQ(*group.law.cohesion, 1000.0 + 1000.0 * (10 - group.from));
  }
}

TEST(LayingOrder, TeamsLayEqualArcsInTheOrderOfTheCase) {
  const Assembly course = make_course({.bricks = 7});  // blocks 2 to 8
  StagedConstruction staged;
  staged.unit = StagedConstruction::Unit::block;
  staged.teams = 2;
  std::vector<LaidBlocks> stages = laying_order(course, staged, testing::kFirstCourse, testing::kFirstCourse);
  ASSERT_EQ(stages.size(), 4u);
  EXPECT_EQ(stages[0].blocks, (std::vector<int>{2, 5}));
  EXPECT_EQ(stages[2].blocks, (std::vector<int>{4, 7}));
  EXPECT_EQ(stages[3].blocks, (std::vector<int>{8}));
  EXPECT_DOUBLE_EQ(stages[1].share, 0.5);
  staged.teams = 1;
  staged.order = StagedConstruction::Order::alternating;  // it is odd
  EXPECT_EQ(laying_order(course, staged, testing::kFirstCourse, testing::kFirstCourse)[0].blocks,
            (std::vector<int>{8}));
  staged.order = StagedConstruction::Order::given;
  staged.sequence = {5, 3};
  stages = laying_order(course, staged, testing::kFirstCourse, testing::kFirstCourse);
  EXPECT_EQ(stages[0].blocks, (std::vector<int>{5}));
  EXPECT_EQ(stages[1].blocks, (std::vector<int>{3}));
  EXPECT_EQ(stages[2].blocks, (std::vector<int>{2}));
  EXPECT_EQ(stages.size(), 7u);
}

/// A structure that needs `needed` and whose solves do not converge between two values.
TryValue needs(double needed, double from, double to, int* solves = nullptr) {
  return [=](double value) -> std::optional<LimitTrial> {
    if (solves) ++*solves;
    if (value > from && value < to) return LimitTrial{value, StaticOutcome::unconverged, 0.0};
    return LimitTrial{value, value >= needed ? StaticOutcome::equilibrium : StaticOutcome::moving, 0.0};
  };
}

TEST(LeastSearch, StartsFromTheLastBracket) {
  LeastSearch search(1000.0, 1e6, {0.01, 1.0});
  int solves = 0;
  LeastSearch::Result result = search.find(needs(437.0, 0, 0, &solves));
  EXPECT_TRUE(result.bracket.narrow);
  EXPECT_GE(result.bracket.stable.value, 437.0);
  EXPECT_LT(result.bracket.moving.value, 437.0);
  EXPECT_LE(result.bracket.stable.value - result.bracket.moving.value, 4.4);
  solves = 0;
  result = search.find(needs(437.0, 0, 0, &solves));
  EXPECT_TRUE(result.bracket.narrow);
  EXPECT_EQ(solves, 2);
  EXPECT_TRUE(search.find(needs(0.0, 0, 0)).needs_none);
  EXPECT_FALSE(search.find(needs(1e7, 0, 0)).bracket.found) << "nothing up to 1e6 holds it";
}

// A solve that does not converge is never an end of the bracket.
TEST(LeastSearch, UnconvergedIsNotAVerdict) {
  LeastSearch::Result result = LeastSearch(1000.0, 1e6, {0.01, 1.0}).find(needs(437.0, 400.0, 500.0));
  ASSERT_TRUE(result.bracket.found);
  EXPECT_FALSE(result.bracket.narrow);
  EXPECT_GE(result.bracket.stable.value, 500.0);
  EXPECT_LE(result.bracket.moving.value, 400.0);
  result = LeastSearch(1000.0, 1e6, {0.01, 1.0}).find(needs(437.0, -1.0, 1e7));
  EXPECT_FALSE(result.needs_none);
  EXPECT_FALSE(result.bracket.found);
}

}  // namespace
}  // namespace cupola::construction_test
