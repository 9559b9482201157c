#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "generators/importer/import.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/static_solve.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "tests/generators/shared_data.hpp"

// Assemblies of BlockResearchGroup/compas_cra (MIT licence). What the associated law says of them was found
// by linear programmes over the friction cones; where Coulomb's law says something else, the associated law
// jams: sliding would open the joint, and the neighbours do not let it.

namespace cupola::compas_assemblies_test {
namespace {

constexpr double kG = 9.81;  // m/s2

struct Scene {
  std::string file;
  std::vector<std::string> supports;
  double mu;
  Vec3 gravity = Vec3(0.0, 0.0, -kG);
};

Assembly import_scene(const Scene& scene) {
  ImportedBlocks source;
  source.path = shared_data() + "/compas_cra/" + scene.file;
  source.supports = scene.supports;
  Assembly assembly = import_blocks(source, 1000.0);
  if (scene.file == "bridge.json") {
    for (size_t block = 11; block <= 15; ++block) assembly.blocks[block].density *= 3.51;
    compute_mass_properties(&assembly);
  }
  return assembly;
}

StaticSolution solve(const Case& c, const Assembly& assembly, FrictionLaw law) {
  const Model model = make_model(c, assembly);
  const State rest = state_at_rest(model);
  ContactDetector detector(assembly, detection_options(c));
  const ContactSet& contacts = detector.update(rest.poses);
  StaticOptions options;
  options.tolerance = kVerdictTolerance;
  options.law = law;
  options.may_move = true;
  return solve_static(model, rest, contacts, match_memories({}, contacts.points), options);
}

StaticSolution solve(const Scene& scene, FrictionLaw law, double compliance = 1e-9) {
  Case c;
  c.joints.friction = scene.mu;
  c.joints.compliance = {compliance, compliance, Compliance::Per::point};
  c.loads.gravity = scene.gravity;
  return solve(c, import_scene(scene), law);
}

void expect_verdict(const Scene& scene, FrictionLaw law, Verdict expected) {
  const StaticSolution solution = solve(scene, law);
  EXPECT_EQ(to_string(solution.verdict), to_string(expected))
      << scene.file << ", mu " << scene.mu << ", gravity " << scene.gravity.transpose() << ", "
      << to_string(law) << ": " << solution.message;
}

/// Gravity as the blocks see it once they are tilted about x or y, deg.
Vec3 tilted_about_x(double deg) {
  const double a = deg * std::numbers::pi / 180.0;
  return kG * Vec3(0.0, -std::sin(a), -std::cos(a));
}
Vec3 tilted_about_y(double deg) {
  const double a = deg * std::numbers::pi / 180.0;
  return kG * Vec3(std::sin(a), 0.0, -std::cos(a));
}

class CompasAssembly : public ::testing::Test {
 protected:
  void SetUp() override {
    if (shared_data().empty()) GTEST_SKIP() << "no shared data";
  }
};

const std::vector<std::string> kWalls{"0", "1"};

// A beam between two vertical walls: the associated law holds it at any friction by prestress, Coulomb's law
// lets it fall.
TEST_F(CompasAssembly, BeamBetweenWallsJamsOrFalls) {
  for (const double mu : {0.1, 0.84}) {
    expect_verdict({"H.json", kWalls, mu}, FrictionLaw::associated, Verdict::equilibrium);
    expect_verdict({"H.json", kWalls, mu}, FrictionLaw::coulomb, Verdict::moving);
  }
}

// Between walls that lean inward by 30 deg the associated law needs mu >= tan 30 deg.
TEST_F(CompasAssembly, KeystoneUpsideDownJamsFromTheSlopeOfItsWalls) {
  const double tan30 = std::tan(std::numbers::pi / 6.0);
  expect_verdict({"A.json", kWalls, 1.01 * tan30}, FrictionLaw::associated, Verdict::equilibrium);
  expect_verdict({"A.json", kWalls, 0.99 * tan30}, FrictionLaw::associated, Verdict::moving);
  expect_verdict({"A.json", kWalls, 0.84}, FrictionLaw::coulomb, Verdict::moving);
}

// A wedge of 60 deg jams at every tilt.
TEST_F(CompasAssembly, SteepWedgeJamsAtEveryTilt) {
  for (const char* file : {"type-a.json", "type-b.json"})
    for (const double deg : {0.0, 30.0, 60.0, 89.0, 120.0, 150.0, 180.0}) {
      expect_verdict({file, kWalls, .84, tilted_about_x(deg)}, FrictionLaw::associated, Verdict::equilibrium);
      expect_verdict({file, kWalls, .84, tilted_about_y(deg)}, FrictionLaw::associated, Verdict::equilibrium);
    }
}

struct Tilt {
  const char* file;
  bool about_x;
  FrictionLaw law;
  double critical_deg;
};

// Wedges of 30 deg on tilting ground: with a tall head it topples; the low one slides up a flank at 30 deg +
// atan mu, and along the groove at tan(theta) = mu / sqrt(cos^2 30 - mu^2 sin^2 30) under the associated law
// but at mu / cos 30 under Coulomb's.
TEST_F(CompasAssembly, FlatWedgesSlideOrTopple) {
  const double mu = 0.84, rad = 180.0 / std::numbers::pi, cos30 = std::sqrt(0.75);
  const double coulomb = std::atan(mu / cos30) * rad;
  for (const Tilt& tilt :
       std::initializer_list<Tilt>{{"type-c.json", false, FrictionLaw::associated, 65.71},
                                   {"type-c.json", true, FrictionLaw::associated, 46.96},
                                   {"type-d.json", false, FrictionLaw::associated, 30 + std::atan(mu) * rad},
                                   {"type-d.json", true, FrictionLaw::associated, 47.96},
                                   {"type-d.json", false, FrictionLaw::coulomb, 30 + std::atan(mu) * rad},
                                   {"type-d.json", true, FrictionLaw::coulomb, coulomb}}) {
    for (const double factor : {0.99, 1.01}) {
      const double deg = factor * tilt.critical_deg;
      expect_verdict({tilt.file, kWalls, mu, tilt.about_x ? tilted_about_x(deg) : tilted_about_y(deg)},
                     tilt.law, factor < 1.0 ? Verdict::equilibrium : Verdict::moving);
    }
  }
}

// What stands under the associated law may need less than that law gives: Coulomb's law holds no more.
TEST_F(CompasAssembly, TallHeadTopplesNoLaterUnderCoulombsLaw) {
  expect_verdict({"type-c.json", kWalls, 0.84, tilted_about_y(0.95 * 65.71)}, FrictionLaw::coulomb,
                 Verdict::equilibrium);
  expect_verdict({"type-c.json", kWalls, 0.84, tilted_about_y(1.01 * 65.71)}, FrictionLaw::coulomb,
                 Verdict::moving);
}

TEST_F(CompasAssembly, ThatStandUnderEitherLaw) {
  for (const FrictionLaw law : {FrictionLaw::associated, FrictionLaw::coulomb}) {
    expect_verdict({"cubes.json", {"0"}, 0.84}, law, Verdict::equilibrium);
    for (const double mu : {0.4, 1.0}) expect_verdict({"bridge.json", kWalls, mu}, law, Verdict::equilibrium);
    for (const double mu : {0.5, 0.9}) {
      expect_verdict({"shelf-stable.json", {"0"}, mu}, law, Verdict::equilibrium);
    }
  }
}

/// Farthest that a block has moved after a second and a half, the weight put on within the first second.
double displacement_in_motion(const Scene& scene, FrictionLaw law) {
  Case c;
  c.joints.friction = scene.mu;
  c.joints.compliance = {1e-9, 1e-9, Compliance::Per::point};
  c.loads.gravity = scene.gravity;
  c.loads.dead_load_time = RampInTime{.from = 0.0, .to = 1.0, .start = 0.0, .duration = 1.0};
  c.analysis.type = AnalysisType::dynamic;
  c.analysis.friction_law = law;
  c.analysis.tolerance = 1e-6;
  c.analysis.time_step = 2e-3;
  c.analysis.duration = 1.5;
  c.analysis.damping = 1e-3;
  const Summary summary = run_dynamic(c, import_scene(scene), {}).value();
  EXPECT_NE(summary.status, Status::unconverged) << summary.message;
  return summary.max_displacement_m;
}

// Where Coulomb's law decides otherwise than the associated one, no programme over the cones tells: the
// motion does. The shelf at 0.4 jams by the associated law and drops a block by Coulomb's; the wedge with the
// tall head, whose groove would hold it up to 44 deg were it low, tips onto its front and slides from 35.1
// deg on.
TEST_F(CompasAssembly, VerdictsUnderCoulombsLawAreThoseOfTheMotion) {
  struct Row {
    Scene scene;
    bool stands;
  };
  for (const Row& row :
       std::initializer_list<Row>{{{"shelf-stable.json", {"0"}, 0.4}, false},
                                  {{"shelf-stable.json", {"0"}, 0.7}, true},
                                  {{"type-c.json", kWalls, 0.84, tilted_about_x(34.7)}, true},
                                  {{"type-c.json", kWalls, 0.84, tilted_about_x(35.5)}, false}}) {
    expect_verdict(row.scene, FrictionLaw::associated, Verdict::equilibrium);
    expect_verdict(row.scene, FrictionLaw::coulomb, row.stands ? Verdict::equilibrium : Verdict::moving);
    // The rest sinks by 1e-4 m on its springs.
    const double moved = displacement_in_motion(row.scene, FrictionLaw::coulomb);
    EXPECT_EQ(moved < 1e-3, row.stands) << row.scene.file << " mu " << row.scene.mu << " moved " << moved;
    EXPECT_EQ(moved > 0.1, !row.stands) << row.scene.file << " mu " << row.scene.mu << " moved " << moved;
  }
}

TEST_F(CompasAssembly, SnakeNeedsFriction) {
  for (const FrictionLaw law : {FrictionLaw::associated, FrictionLaw::coulomb}) {
    expect_verdict({"snake.json", {"0"}, 0.4}, law, Verdict::moving);
    expect_verdict({"snake.json", {"0"}, 0.6}, law, Verdict::equilibrium);
  }
}

// Blocks with curved faces, meshed block by block, so that neighbours' faces do not mate: the file brings the
// 40 strips along in which they touch. Facets within 0.03 rad count as plane, volumes are those of the file.
TEST_F(CompasAssembly, CurvedBlocksStandOnTheInterfacesOfTheirFile) {
  ImportedBlocks source;
  source.path = shared_data() + "/compas_cra/curve-3-blocks.json";
  source.supports = {"0"};
  source.facet_angle = 0.03;
  ImportReport report;
  const Assembly assembly = import_blocks(source, 1000.0, &report);
  double volume = 0.0;
  for (const Block& block : assembly.blocks) volume += block.volume;
  EXPECT_NEAR(volume, 4.269792, 1e-6);
  EXPECT_LE(assembly.parts.size(), 20u);  // a person would draw one wedge for each strip of a hollow face

  const std::string file =
      (std::filesystem::temp_directory_path() / fmt::format("cupola_curve_{}.csv", ::getpid())).string();
  std::ofstream(file) << contacts_csv(source, assembly, report);
  Case c;
  c.joints.compliance = {1e-9, 1e-9, Compliance::Per::point};
  c.contact.method = ContactDetection::Method::file;
  c.contact.file = file;
  for (const double mu : {0.2, 0.5, 0.84}) {
    c.joints.friction = mu;
    const StaticSolution solution = solve(c, assembly, FrictionLaw::associated);
    EXPECT_EQ(to_string(solution.verdict), to_string(Verdict::equilibrium)) << mu << solution.message;
  }
  c.joints.friction = 0.02;
  EXPECT_NE(to_string(solve(c, assembly, FrictionLaw::associated).verdict), to_string(Verdict::equilibrium));
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace cupola::compas_assemblies_test
