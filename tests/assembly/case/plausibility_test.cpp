// Values that a case file admits but masonry hardly has: every check, at values that a user would write by
// mistake.
#include "assembly/case/plausibility.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "assembly/case/bundled.hpp"
#include "assembly/case/case_reader.hpp"
#include "tests/assembly/case/case_scratch.hpp"
#include "tests/assembly/scene.hpp"

namespace cupola::plausibility_test {
namespace {

struct Mistake {
  std::string base;                  ///< bundled case
  std::vector<std::string> options;  ///< as after --set
  std::string sentence;              ///< its beginning
};

const std::vector<Mistake> kMistakes = {
    {"dome_circular",
     {"material.unit_weight=18"},
     "material.unit_weight = 18 N/m3: 3000 to 80000 N/m3 expected; in kN/m3"},
    {"dome_circular", {"material.unit_weight=1.8e6"}, "material.unit_weight = 1.8e+06 N/m3: "},
    {"dome_circular",
     {"geometry.surface.span=45000"},
     "geometry.surface.span = 45000 m: 0.05 to 250 m expected; in millimetres?"},
    {"dome_circular",
     {"geometry.surface.thickness=2200"},
     "geometry.surface.thickness = 2200 m: 0.002 to 20 m expected; in mill"},
    {"groin_vault",
     {"geometry.surface.thickness=4"},
     "geometry.surface.thickness = 4 m: 0.002 to 3 m expected; in mill"},
    {"dome_circular", {"geometry.surface.thickness=0.0011"}, "geometry.surface.thickness = 0.0011 m: "},
    {"dome_circular",
     {"geometry.surface.crown_angle_deg=1.05"},
     "geometry.surface.crown_angle_deg = 1.05 deg: 4 to 180 deg expected; in radians?"},
    {"octagon_circular",
     {"geometry.surface.crown_angle_deg=1.05"},
     "geometry.surface.crown_angle_deg = 1.05 deg: "},
    {"wall_small",
     {"geometry.surface={type: arch, half_embrace_deg: 1.57}"},
     "geometry.surface.half_embrace_deg = 1.57 deg: "},
    {"wall_small", {"geometry.surface={type: arch, width: 5000}"}, "geometry.surface.width = 5000 m: "},
    {"wall_small", {"geometry.surface.length=12000"}, "geometry.surface.length = 12000 m: "},
    {"wall_small", {"geometry.surface.height=6000"}, "geometry.surface.height = 6000 m: "},
    {"wall_small", {"geometry.surface.thickness=300"}, "geometry.surface.thickness = 300 m: "},
    {"dome_circular",
     {"imperfections.gap=2"},
     "imperfections.gap = 2 m: at most 0.05 m expected; in millimetres?"},
    {"dome_circular", {"imperfections.noise=1"}, "imperfections.noise = 1 m: "},
    {"dome_circular",
     {"joints.friction=30"},
     "joints.friction = 30: at most 3 expected; an angle in degrees?"},
    {"dome_circular", {"joints.base.friction=30"}, "joints.base.friction = 30: "},
    {"dome_circular", {"joints.rings=[{from: 0, friction: 30}]"}, "joints.rings[0].friction = 30: "},
    {"dome_circular",
     {"joints.compliance.normal=1e8"},
     "joints.compliance.normal = 1e+08 m/N: 1e-17 to 1e-05 m/N expected; a stiffness"},
    {"dome_circular",
     {"joints.compliance.per=area", "joints.compliance.tangential=1e10"},
     "joints.compliance.tangential = 1e+10 m3/N: "},
    {"dome_circular", {"joints.head.normal=1e-20"}, "joints.head.normal = 1e-20 m/N: "},
    {"brunelleschi_mortar",
     {"joints.compressive_strength=2.5"},
     "joints.compressive_strength = 2.5 Pa: 50 to 1e+09 Pa expected; in MPa or kPa?"},
    {"brunelleschi_mortar", {"joints.bed.cohesion=0.1"}, "joints.bed.cohesion = 0.1 Pa: "},
    {"brunelleschi_mortar",
     {"joints.cohesion=5e4", "joints.tension=2e5"},
     "joints.tension = 200000 Pa exceeds cohesion / friction = 125000 Pa"},
    {"brunelleschi_mortar",
     {"joints.cohesion=5e4", "joints.head.tension=2e5"},
     "joints.head.tension = 200000 Pa exceeds cohesion / friction = 125000 Pa"},
    {"brunelleschi_mortar",
     {"joints.tension=1e4", "joints.failure=softening", "joints.fracture_energy={tension: 0.01, shear: 100}",
      "analysis={type: dynamic}"},
     "joints.fracture_energy.tension = 0.01 N/m: 0.1 to 100000 N/m expected; in N/mm?"},
    {"arch",
     {"joints.compliance={per: area}", "joints.compressive_strength=2.5e6"},
     "contact.subdivide is not given: an undivided joint with compressive strength, or whose peak stress is "
     "sought, is 20 % too strong where a sixth"},
    {"arch",
     {"joints.compliance={per: area}", "analysis={type: limit, limit: {parameter: peak_stress}}"},
     "contact.subdivide is not given: "},
    {"arch",
     {"joints.compliance={per: area}", "joints.bed.compressive_strength=2.5e6"},
     "contact.subdivide is not given: "},
    {"arch",
     {"joints.compliance={per: area}", "joints.rings=[{from: 3, compressive_strength: 2.5e6}]"},
     "contact.subdivide is not given: "},
    {"dome_circular",
     {"loads.gravity=[0, 0, 9.81]"},
     "loads.gravity (z) = 9.81 m/s2: at most 0 m/s2 expected; upward?"},
    {"dome_circular", {"loads.gravity=[0, 0, -1]"}, "loads.gravity (its length) = 1 m/s2: "},
    {"dome_circular", {"loads.gravity=[0, 0, -9810]"}, "loads.gravity (its length) = 9810 m/s2: "},
    {"dome_circular",
     {"loads.lantern.weight_fraction=2"},
     "loads.lantern.weight_fraction = 2 of the weight: at most 1 of the weight expected; in per cent?"},
    {"dome_circular",
     {"loads.faces=[{kind: extrados, pressure: 0.6}]"},
     "loads.faces[0].pressure = 0.6 N/m2: "},
    {"dome_circular",
     {"loads.faces=[{kind: extrados, traction: [1e9, 0, 0]}]"},
     "loads.faces[0].traction = 1e+09 N/m2: "},
    {"dome_circular",
     {"ties.pairs=[{block_a: 0, block_b: 1, stiffness: 200}]"},
     "ties.pairs[0].stiffness = 200 N/m: "},
    {"dome_circular",
     {"geometry.chains=[{course: 3, axial_stiffness: 2e13}]"},
     "geometry.chains[0].axial_stiffness = 2e+13 N: "},
    {"dome_circular",
     {"analysis.type=dynamic", "analysis.time_step=5", "analysis.duration=1000"},
     "analysis.time_step = 5 s: "},
    {"portal",
     {"analysis.limit={parameter: tilt, low: 0, high: 0.5}"},
     "analysis.limit.high = 0.5 deg: 1.5708 to 90 deg expected; in radians?"},
    {"portal", {"analysis.limit.high=9.81"}, "analysis.limit.high = 9.81 g: at most 5 g expected; in m/s2?"},
};

TEST(ImplausibleValues, EveryMistakeGivesOneWarningWithItsCause) {
  for (const Mistake& mistake : kMistakes) {
    const Case scene = read_case(bundled_folder() + "/" + mistake.base + ".yaml", mistake.options);
    ASSERT_EQ(scene.warnings.size(), 1u) << mistake.sentence << ::testing::PrintToString(scene.warnings);
    EXPECT_TRUE(scene.warnings.front().starts_with(mistake.sentence)) << scene.warnings.front();
    EXPECT_NE(scene.warnings.front().find(';'), std::string::npos) << "the likely cause is missing";
  }
}

// Whoever writes 1 asks for it.
TEST(ImplausibleValues, UndividedJointsThatTheCaseAsksForAreNone) {
  EXPECT_TRUE(
      read_case(bundled_folder() + "/arch.yaml", {"joints.compressive_strength=2.5e6", "contact.subdivide=1"})
          .warnings.empty());
}

TEST(ImplausibleValues, NoDefaultIsOne) {
  for (const char* parameter : {"friction", "tilt", "acceleration", "load", "thickness", "spread",
                                "joint_extent", "lantern", "peak_stress"})
    EXPECT_EQ(read_case(bundled_folder() + "/dome_circular.yaml",
                        {std::string("analysis={type: limit, limit: {parameter: ") + parameter + "}}"})
                  .warnings,
              std::vector<std::string>{})
        << parameter;
}

// Loads and moves act on the complete model: not where the last course is not laid, and moves not where the
// blocks on the supports are held.
TEST(ImplausibleForBlocks, WhatNoStageFeels) {
  Assembly blocks = test::two_block_assembly();
  blocks.blocks.push_back(blocks.blocks.back());
  blocks.blocks[1].ring = 0;
  blocks.blocks[2].ring = 1;
  Case scene;
  scene.analysis.type = AnalysisType::staged;
  scene.loads.forces = {{.block = 1, .point = {}, .force = Vec3(0, 0, -1e3), .time = {}}};
  scene.supports.moves.emplace_back().displacement = {1e-3, 0, 0};
  const auto starts = [&] {
    std::string found;
    for (const std::string& text : implausible_for_blocks(scene, blocks))
      found += text.substr(0, text.find(':')) + ",";
    return found;
  };
  EXPECT_EQ(starts(), "");
  scene.analysis.staged.last_ring = 1;
  EXPECT_EQ(starts(), "");
  scene.analysis.staged.last_ring = 0;
  EXPECT_EQ(starts(), "loads,supports.moves,");
  scene.analysis.staged.last_ring = -1;
  scene.analysis.staged.hold_below = 0;
  EXPECT_EQ(starts(), "loads,supports.moves,") << "the block of the load is held";
  scene.loads.forces[0].block = 2;
  EXPECT_EQ(starts(), "supports.moves,");
}

// A fixed cube from z = 0 to 1 m and a block of 1 m height on it.
TEST(ImplausibleForBlocks, ValuesThatMustFitTheBlocks) {
  const Assembly blocks = test::two_block_assembly();
  Case scene;
  EXPECT_TRUE(implausible_for_blocks(scene, blocks).empty());
  const auto only = [&](const Case& changed) {
    const std::vector<std::string> found = implausible_for_blocks(changed, blocks);
    return found.size() == 1 ? found[0] : std::to_string(found.size()) + " warnings";
  };
  Case section = scene;
  section.postproc.sections = {1.2, 100.0};
  EXPECT_TRUE(only(section).starts_with(
      "postproc.sections: the height 100 m cuts no block; the model reaches from 1 to 1.333 m"))
      << only(section);
  Case plane = scene;
  plane.postproc.planes = {{"beside", Vec3(4.2, 0, 0), Vec3(2, 0, 0)}};
  EXPECT_TRUE(only(plane).starts_with("postproc.planes: beside passes 3.667 m beside the model"))
      << only(plane);
  Case force = scene;
  force.loads.forces.resize(1);
  force.loads.forces[0].force = Vec3(0, 0, -1);  // blocks of hundreds of newtons
  EXPECT_TRUE(only(force).starts_with("loads.forces[0].force = 1 N: ")) << only(force);
  EXPECT_NE(only(force).find("in kN? Forces are in N"), std::string::npos);
  force.analysis.type = AnalysisType::limit;  // a unit load, which the analysis multiplies
  force.analysis.limit.parameter = LimitSearch::Parameter::load;
  EXPECT_EQ(only(force), "0 warnings");
  Case heavy = scene;
  heavy.geometry.imported.emplace();
  EXPECT_TRUE(implausible_for_blocks(heavy, blocks).empty());
  Assembly light = blocks;  // by a table of bricks in kN/m3
  light.blocks[1].mass = 20.0 * light.blocks[1].volume;
  const std::vector<std::string> density = implausible_for_blocks(heavy, light);
  ASSERT_EQ(density.size(), 1u);
  EXPECT_TRUE(density[0].starts_with("geometry.import (density of block 1) = 20 kg/m3: ")) << density[0];
  Case move = scene;
  move.supports.moves.resize(1);
  move.supports.moves[0].displacement = Vec3(20, 0, 0);
  move.supports.moves[0].time = RampInTime{};
  EXPECT_TRUE(only(move).starts_with("supports.moves[0].displacement = 20 m: ")) << only(move);
  Case settled = scene;
  settled.supports.moves.resize(1);
  for (const AnalysisType type : {AnalysisType::static_, AnalysisType::range}) {
    settled.analysis.type = type;
    settled.supports.moves[0].displacement = Vec3(0, 0, -0.01);
    EXPECT_EQ(only(settled), "0 warnings") << "they keep the joints as built";
  }
  settled.analysis.type = AnalysisType::dynamic;
  EXPECT_TRUE(only(settled).starts_with("supports.moves[0]: has moved at the start, where the other blocks"))
      << only(settled);
  settled.supports.moves[0].displacement.setZero();
  EXPECT_EQ(only(settled), "0 warnings");
  settled.supports.moves[0].tilt_deg = 0.1;
  EXPECT_EQ(only(settled).find("supports.moves[0]"), 0u) << only(settled);
  settled.analysis.start = Analysis::Start::static_;
  EXPECT_EQ(only(settled), "0 warnings");
  settled.analysis.start = Analysis::Start::automatic;
  settled.supports.moves[0].time = RampInTime{};
  EXPECT_EQ(only(settled), "0 warnings");
  Case imported = scene;
  imported.geometry.imported.emplace();
  Assembly millimetres = blocks;
  for (Vec3& x : millimetres.vertices) x *= 1e4;
  const auto found = implausible_for_blocks(imported, millimetres);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("drawn in millimetres? Set geometry.import.metres_per_unit: 0.001"),
            std::string::npos)
      << found[0];
}

/// The lines `NAME CASE key.path=value ...` of cases/variants.txt.
std::vector<std::vector<std::string>> variants() {
  std::vector<std::vector<std::string>> lines;
  std::ifstream file(bundled_folder() + "/variants.txt");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::vector<std::string> split{std::istream_iterator<std::string>(words), {}};
    if (!split.empty() && split[0][0] != '#') lines.push_back(std::move(split));
  }
  return lines;
}

TEST(ImplausibleValues, NoShippedCaseWarns) {
  int cases = 0;
  for (const auto& entry : std::filesystem::directory_iterator(bundled_folder())) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".yaml" || name.starts_with("claims")) continue;
    if (name == "wall_j4d_force.yaml") continue;  // the density of its beam stands for a load
    const Case scene = read_case(entry.path().string());
    EXPECT_TRUE(scene.warnings.empty()) << name << ": " << scene.warnings.front();
    for (const SweptKey& swept : scene.sweep)
      for (const std::string& value : swept.values) {
        const Case member = read_case(entry.path().string(), {swept.key + "=" + value});
        EXPECT_TRUE(member.warnings.empty()) << name << " " << value << ": " << member.warnings.front();
      }
    ++cases;
  }
  EXPECT_GE(cases, 15);
  EXPECT_GE(variants().size(), 100u);
  for (const std::vector<std::string>& words : variants()) {
    std::vector<std::string> options;
    for (size_t i = 2; i < words.size(); ++i)
      if (!words[i].starts_with("--")) options.push_back(words[i]);
    const Case scene = read_case(bundled_folder() + "/" + words[1] + ".yaml", options);
    EXPECT_TRUE(scene.warnings.empty()) << words[0] << ": " << scene.warnings.front();
  }
}

TEST(Compliance, DefaultsDependOnWhatTheyArePer) {
  const ScratchFolder scratch;
  const auto read = [&](const std::string& compliance) {
    return read_case(scratch.write(
                         "wall.yaml",
                         "geometry: {surface: {type: wall}, bond: {type: running}}\njoints: {compliance: {" +
                             compliance + "}}\n"))
        .joints.compliance;
  };
  EXPECT_EQ(read("per: point").normal, 1e-8);
  EXPECT_EQ(read("per: point").tangential, 1e-8);
  EXPECT_EQ(read("per: area").normal, 1e-10);
  EXPECT_EQ(read("per: area").tangential, 2.4e-10);
  EXPECT_EQ(read("per: area, normal: 3e-11").normal, 3e-11);
}

}  // namespace
}  // namespace cupola::plausibility_test
