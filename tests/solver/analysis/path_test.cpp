#include <cmath>

#include "assembly/base/error.hpp"
#include "tests/solver/analysis/path_run.hpp"

// Equilibria along a path of loads or support motions.

namespace cupola::path_test {
namespace {

// Double cantilever: the support turns about an axis 0.5 m beside the joint, which opens to three to one. The
// work dissipated is the fracture energy, whatever the number of steps.
TEST(Path, ADoubleCantileverDissipatesItsFractureEnergy) {
  const Assembly assembly = couplet();
  for (const int steps : {7, 20, 50}) {
    Case scene = couplet_case(steps);
    const double broken = 2.0 * kEnergy.tension / kStrength.tension;  // m, opening
    scene.supports.moves.push_back({.region = {.blocks = {BlockRef{3}}},
                                    .rotation_deg = {0, -2.0 * broken / 0.5 * 180.0 / M_PI, 0},
                                    .pivot = {-1, 0, 0.2},
                                    .time = RampInTime{}});
    scene.analysis.path.control->direction = Vec3::UnitZ();
    const PathResult result = run(scene, assembly);
    ASSERT_EQ(result.summary.status, Status::stable) << result.summary.message;
    EXPECT_NEAR(result.rows.back()[3], kEnergy.tension * kArea, 0.01 * kEnergy.tension * kArea) << steps;
    EXPECT_NEAR(result.rows.back()[2], kWeight, 1e-3 * kWeight) << "broken";
    double opening = 0.0, damage = 1.0;
    for (int i = 0; i < result.frames.back().contacts.size(); ++i) {
      if (result.frames.back().contacts.kind[i] != JointKind::bed) continue;
      opening = std::max(opening, result.frames.back().contacts.crack_opening[i]);
      damage = std::min(damage, result.frames.back().contacts.damage[i]);
    }
    EXPECT_EQ(damage, 1.0);
    EXPECT_NEAR(opening, 3 * 2.0 * broken, 1e-3 * broken);  // joints that carry nothing have no elongation
  }
}

// Couplet (half a triplet) in shear: the work beyond friction is the fracture energy, and the largest force c
// A + mu N up to the softening within a step. Without normal force and with one that the support keeps.
TEST(Path, AShearedCoupletDissipatesItsFractureEnergy) {
  const Assembly assembly = couplet();
  for (const double pressure : {0.0, 2e5}) {
    for (const int steps : {7, 20, 50}) {
      Case scene = couplet_case(steps);
      const double broken = 2.0 * kEnergy.shear / kStrength.cohesion;  // m, slip
      scene.supports.moves.push_back({.region = {.blocks = {BlockRef{3}}},
                                      .displacement = {0, 0, -3 * kCompliance * pressure},
                                      .time = RampInTime{.duration = 1e-9}});
      scene.supports.moves.push_back(
          {.region = {.blocks = {BlockRef{3}}}, .displacement = {1.5 * broken, 0, 0}, .time = RampInTime{}});
      const PathResult result = run(scene, assembly);
      ASSERT_EQ(result.summary.status, Status::stable) << result.summary.message;
      double friction = 0.0, friction_work = 0.0, last = 0.0;
      for (const Frame& frame : result.frames) {
        double slip = 0.0;
        friction = 0.0;
        for (int i = 0; i < frame.contacts.size(); ++i) {
          if (frame.contacts.kind[i] != JointKind::bed) continue;
          slip += frame.contacts.area[i] / kArea * frame.contacts.slip[i];
          friction += 0.75 * frame.contacts.normal_force[i];
        }
        friction_work += friction * (slip - last);
        last = slip;
      }
      EXPECT_NEAR(friction, 0.75 * pressure * kArea, 0.75 * kWeight);
      const double energy = kEnergy.shear * kArea;
      EXPECT_NEAR(result.rows.back()[3] - friction_work, energy, 0.01 * energy) << steps << " " << pressure;
      EXPECT_NEAR(result.rows.back()[2], friction, 1e-3 * kStrength.cohesion * kArea);
      EXPECT_LE(result.largest_force(), 1.001 * (kStrength.cohesion * kArea + friction));
      if (steps == 50) {
        EXPECT_GE(result.largest_force(), 0.97 * (kStrength.cohesion * kArea + friction));
      }
    }
  }
}

// Each step starts where the last one leads, and each further solve of it from the last one: 74 Newton
// iterations in 85 solves, from afar 338.
TEST(Path, SolvesStartNearTheirEquilibrium) {
  Case scene = couplet_case(50);
  scene.supports.moves.push_back({.region = {.blocks = {BlockRef{3}}},
                                  .displacement = {3.0 * kEnergy.shear / kStrength.cohesion, 0, 0},
                                  .time = RampInTime{}});
  const PathResult path = run(scene, couplet());
  ASSERT_EQ(path.rows.size(), 51u) << path.summary.message;
  int solves = 0;
  for (const auto& row : path.rows) solves += static_cast<int>(row[5]);
  EXPECT_LT(path.summary.iterations, 2 * solves);
}

// Pulled and sheared beyond its cohesion, the bed slips at all of its points, although none presses.
TEST(Path, CountsThePointsThatSlipUnderPull) {
  Case scene = couplet_case(5);
  scene.joints.failure = JointFailure::plastic;
  const double elastic = 3 * kCompliance * kStrength.cohesion;  // m, of three joints
  scene.supports.moves.push_back({.region = {.blocks = {BlockRef{3}}},
                                  .displacement = {3 * elastic, 0, 0.2 * elastic},
                                  .time = RampInTime{}});
  const PathResult result = run(scene, couplet());
  ASSERT_EQ(result.summary.status, Status::stable) << result.summary.message;
  const ContactTable& contacts = result.frames.back().contacts;
  int points = 0;
  for (int i = 0; i < contacts.size(); ++i) {
    if (contacts.kind[i] != JointKind::bed) continue;
    ++points;
    EXPECT_LT(contacts.normal_force[i], 0.0);
    EXPECT_GT(contacts.slip[i], 0.0);
  }
  EXPECT_EQ(result.summary.slipping_contacts, points);
}

// A dry bed between joints with strength parts by more than the margin: nothing is damaged.
TEST(Path, ADryJointThatPartsHasNoDamage) {
  Case scene = couplet_case(4);
  scene.joints.failure = JointFailure::plastic;
  scene.joints.fracture_energy.reset();
  scene.joints.strength = {};
  scene.contact.margin = 5e-3;  // m
  scene.supports.moves.push_back(
      {.region = {.blocks = {BlockRef{3}}}, .displacement = {0, 0, 8e-3}, .time = RampInTime{}});
  const PathResult result = run(scene, couplet());
  ASSERT_EQ(result.summary.status, Status::stable) << result.summary.message;
  for (const auto& row : result.rows) EXPECT_EQ(row[4], 0.0);
  const ContactTable& contacts = result.frames.back().contacts;
  double widest = 0.0;
  for (int i = 0; i < contacts.size(); ++i) {
    const bool dry = contacts.kind[i] == JointKind::bed;
    EXPECT_EQ(std::isnan(contacts.damage[i]), dry);
    EXPECT_EQ(std::isnan(contacts.strength_use[i]), dry);
    widest = std::max(widest, contacts.gap[i]);
  }
  EXPECT_GT(widest, scene.contact.margin);
}

// A path whose case names no control gives the table of one that names the support that moves farthest, or the
// block whose load grows most.
TEST(Path, ChoosesItsControl) {
  const Assembly assembly = couplet();
  Case moved = couplet_case(4);
  for (const double x : {1e-5, 3e-5})
    moved.supports.moves.push_back({.region = {.blocks = {BlockRef{x > 2e-5 ? 3 : 0}}},
                                    .displacement = {0, x, 0},
                                    .time = RampInTime{}});
  Case loaded = couplet_case(4);
  loaded.loads.forces.push_back({BlockRef{1}, {}, Vec3(0, 300, 400), RampInTime{}});
  loaded.loads.forces.push_back({BlockRef{2}, {}, Vec3(0, 0, -600), {}});
  struct Choice {
    const char* what;
    Case scene;
    LoadPath::Control control;
  };
  for (Choice choice : {Choice{"support", moved, {BlockRef{3}, {}, Vec3::UnitY()}},
                        Choice{"load", loaded, {BlockRef{1}, {}, Vec3(0, 3, 4)}}}) {
    choice.scene.analysis.path.control = choice.control;
    const PathResult named = run(choice.scene, assembly);
    choice.scene.analysis.path.control.reset();
    const PathResult chosen = run(choice.scene, assembly);
    EXPECT_EQ(chosen.rows, named.rows) << choice.what;
    EXPECT_EQ(chosen.rows.size(), 5u) << choice.what << chosen.summary.message;
    EXPECT_NE(chosen.summary.message.find("chosen, along (0, "), std::string::npos) << chosen.summary.message;
    EXPECT_EQ(named.summary.message.find("chosen"), std::string::npos) << named.summary.message;
  }
  // What turns about its centroid changes with time, but points nowhere.
  Case still = couplet_case(4), turned = couplet_case(4);
  turned.supports.moves.push_back({.region = {.blocks = {BlockRef{3}}},
                                   .rotation_deg = {0, 0.01, 0},
                                   .pivot = {0, 0, 0.5},
                                   .time = RampInTime{}});
  for (Case* scene : {&still, &turned}) {
    scene->analysis.path.control.reset();
    try {
      run(*scene, assembly);
      ADD_FAILURE() << "no control was missed";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("the centroid of a support"), std::string::npos)
          << error.what();
    }
  }
}

// What the floor bears by the joint and by a rod to the upper block, and what the support above bears, balance
// each other and the weight.
TEST(Path, TheForceOfASupportCountsItsTies) {
  Case scene = couplet_case(4);
  scene.supports.moves.push_back(
      {.region = {.blocks = {BlockRef{3}}}, .displacement = {0, 0, 1e-5}, .time = RampInTime{}});
  PairTie rod;
  rod.block_a = BlockRef{0};
  rod.block_b = BlockRef{2};
  rod.point_a = {1, 0, 0};
  rod.point_b = {0.5, 0, 0.3};
  rod.stiffness = 1e8;
  scene.ties.pairs = {rod};
  const auto largest = [&](int support) {
    scene.analysis.path.control = LoadPath::Control{BlockRef{support}, {}, Vec3::UnitZ()};
    const PathResult path = run(scene, couplet());
    return path.rows.back()[2];
  };
  const double floor = largest(0), above = largest(3);
  EXPECT_LT(floor, 0.0) << "it pulls";
  EXPECT_NEAR(floor + above, 2.0 * kWeight, 1e-3 * kWeight) << floor << " " << above;
}

// Two blocks lean on each other over a span of 2 m. Their supports spread by s each: both turn about the
// inner edges of their springings by the angle at which the crown hinge, 1 m above, comes down, and the crown
// opens by 2 d sin(angle) at its lower edge. Faces farther apart than the margin are no contacts any more;
// the frame lists them all the same.
TEST(Path, TheCrownOfATwoBlockArchOpensAsItsHingesSay) {
  Assembly arch;
  const auto voussoir = [&arch](std::array<Eigen::Vector2d, 4> quad, bool mirrored, bool fixed) {
    if (mirrored)
      quad = {Eigen::Vector2d(-quad[1].x(), quad[1].y()), Eigen::Vector2d(-quad[0].x(), quad[0].y()),
              Eigen::Vector2d(-quad[3].x(), quad[3].y()), Eigen::Vector2d(-quad[2].x(), quad[2].y())};
    testing::add_voussoir(quad, 1.0, 2000.0, fixed, fixed ? -1 : 0, &arch);
  };
  for (const bool mirrored : {false, true}) {
    voussoir({Eigen::Vector2d(-1.5, 0), {-1, 0}, {0, 0.5}, {0, 1}}, mirrored, false);
    voussoir({Eigen::Vector2d(-2, -0.5), {-0.5, -0.5}, {-0.5, 0}, {-2, 0}}, mirrored, true);
  }
  compute_mass_properties(&arch);
  const double spread = 0.05;  // m, of each support
  Case scene = testing::make_case(0.75, 0.0, 0.01);
  scene.joints.compliance = {kCompliance, kCompliance, Compliance::Per::area};
  scene.analysis.type = AnalysisType::path;
  scene.analysis.tolerance = 1e-9;
  scene.analysis.path.steps = 40;
  scene.analysis.path.control = LoadPath::Control{BlockRef{3}, {}, Vec3::UnitX()};
  scene.supports.moves = {
      {.region = {.blocks = {BlockRef{1}}}, .displacement = {-spread, 0, 0}, .time = RampInTime{}},
      {.region = {.blocks = {BlockRef{3}}}, .displacement = {spread, 0, 0}, .time = RampInTime{}}};
  const PathResult result = run(scene, arch);
  ASSERT_EQ(result.summary.status, Status::stable) << result.summary.message;
  const double height = std::sqrt(2.0 - (1.0 + spread) * (1.0 + spread));
  const double angle = 0.25 * M_PI - std::atan2(height, 1.0 + spread);
  const ContactTable& contacts = result.frames.back().contacts;
  double widest = 0.0, margin = 0.0;
  for (int i = 0; i < contacts.size(); ++i) {
    if (contacts.block_a[i] != 0 || contacts.block_b[i] != 2) continue;
    widest = std::max(widest, contacts.gap[i]);
    margin = std::max(margin, contacts.normal_force[i] > 0.0 ? contacts.gap[i] : 0.0);
    if (contacts.gap[i] > 0.01) {
      EXPECT_EQ(contacts.force[i], Vec3::Zero());
    }
  }
  EXPECT_LT(margin, 1e-6) << "what carries touches";
  // The outermost points of the quadrature stand 11 % of the depth inside the lower edge.
  EXPECT_NEAR(widest, 2.0 * 0.5 * std::sin(angle), 0.15 * std::sin(angle));
}

/// Largest shear that a bed under N at a third of its width carries, over c A, by a force that grows in
/// `steps`.
double shear_over_cohesion(JointFailure failure, int steps) {
  const double cohesion = 1e5, normal = 2e4;
  Case scene = testing::make_case(0.0, 0.0, 0.01);
  scene.joints.compliance = {1e-10, 1e-10, Compliance::Per::area};
  scene.joints.strength = {.cohesion = cohesion};
  scene.joints.failure = failure;
  scene.contact.subdivide = 8;
  scene.loads.gravity.setZero();
  const double middle = failure == JointFailure::plastic ? 0.0 : 0.25;  // of what bears: no torsion
  scene.loads.forces.push_back({BlockRef{1}, Vec3(1.0 / 3, 0, 0), Vec3(0, 0, -normal), {}});
  scene.loads.forces.push_back(
      {BlockRef{1}, Vec3(middle, 0, 0), Vec3(0, 1.1 * cohesion * kArea, 0), RampInTime{}});
  scene.analysis.type = AnalysisType::path;
  scene.analysis.tolerance = 1e-6;
  scene.analysis.path.steps = steps;
  scene.analysis.path.control = LoadPath::Control{BlockRef{1}, {}, Vec3::UnitY()};
  const PathResult result = run(scene, testing::box_on_floor({1.0, 0.5, 0.2}));
  EXPECT_EQ(result.summary.status, Status::moving) << result.summary.message;
  return result.largest_force() / (cohesion * kArea);
}

// Without friction and under N at e = t/3, a brittle bed carries c on its compressed half, 3 (t/2 - e), while
// a plastic one carries c everywhere. Eight pieces place the edge of the compressed zone to 1/8.
TEST(Path, BrittleCohesionCountsOnTheCompressedAreaOnly) {
  EXPECT_NEAR(shear_over_cohesion(JointFailure::plastic, 20), 1.0, 0.01);
  EXPECT_NEAR(shear_over_cohesion(JointFailure::brittle, 20), 0.5, 0.0625);
}

// Under a growing load the path ends where no equilibrium exists: the block slides at mu W.
TEST(Path, EndsWhereNoEquilibriumExists) {
  Case scene = testing::make_case(0.4, 1e-8, 0.01);
  const Assembly assembly = testing::box_on_floor({1.0, 1.0, 0.2});
  const double weight = assembly.blocks[1].mass * testing::kG;
  scene.loads.forces.push_back({BlockRef{1}, Vec3(0, 0, 0), Vec3(weight, 0, 0), RampInTime{}});
  scene.analysis.type = AnalysisType::path;
  scene.analysis.tolerance = 1e-8;
  scene.analysis.path.steps = 10;
  scene.analysis.path.control = LoadPath::Control{BlockRef{1}, {}, Vec3::UnitX()};
  const PathResult result = run(scene, assembly);
  EXPECT_EQ(result.summary.status, Status::moving);
  for (const char* part : {"the path ends at", "no equilibrium exists: a mechanism"})
    EXPECT_NE(result.summary.message.find(part), std::string::npos) << result.summary.message;
  EXPECT_NEAR(result.largest_force(), 0.4 * weight, 0.1 / 64 * weight) << "the shortest step";
  EXPECT_EQ(result.frames.size(), result.rows.size());
  scene.loads.forces.back().time = {};  // the whole push from the start
  const std::string message = run(scene, assembly).summary.message;
  EXPECT_TRUE(message.starts_with("the path has no equilibrium; moving at 0 s")) << message;
}

TEST(Path, RefusesAControlBlockThatDoesNotExist) {
  Case scene = couplet_case(5);
  scene.analysis.path.control->block = BlockRef{7};
  EXPECT_THROW(run(scene, couplet()), InputError);
}

// A block under its weight: it is not part of the load that grows.
TEST(Path, TheForceOfAFreeControlIsTheLoadAdded) {
  Case scene = testing::make_case(0.5, 1e-10, 0.01);
  scene.loads.forces.push_back({BlockRef{1}, Vec3(0, 0, 0.5), Vec3(0, 0, -1e3), RampInTime{}});
  scene.analysis.type = AnalysisType::path;
  scene.analysis.path.steps = 2;
  const PathResult result = run(scene, testing::box_on_floor({1, 1, 1}));
  ASSERT_EQ(result.rows.size(), 3u) << result.summary.message;
  for (size_t k = 0; k < result.rows.size(); ++k)
    EXPECT_NEAR(result.rows[k][2], 500.0 * static_cast<double>(k), 1e-6) << "digits of path.csv";
  EXPECT_NE(result.summary.message.find("largest added load 1000 N at 1 s"), std::string::npos)
      << result.summary.message;
  scene.loads.forces.back().time = {};  // on it from the start
  scene.analysis.path.control = LoadPath::Control{BlockRef{1}, {}, -Vec3::UnitZ()};
  const std::string message = run(scene, testing::box_on_floor({1, 1, 1})).summary.message;
  EXPECT_TRUE(message.ends_with("; no load was added")) << message;
}

}  // namespace
}  // namespace cupola::path_test
