// Warnings about implausible input: once on the terminal of a run of three programs, kept in its files, shown
// in the report, and errors with --strict.

#include <fstream>

#include <gtest/gtest.h>

#include "assembly/case/bundled.hpp"
#include "assembly/case/case_reader.hpp"
#include "assembly/case/plausibility.hpp"
#include "assembly/model/relative_compliance.hpp"
#include "generators/generate.hpp"
#include "solver/collision/contact_detector.hpp"
#include "solver/collision/geometry_warnings.hpp"
#include "solver/dynamics/joints_on_supports.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "tests/pipeline/program_run.hpp"

namespace cupola::warnings_test {
namespace {

const std::string kGenerate = "cupola-generate wall.yaml --output assembly.vtu --quiet";
const std::string kSolve = "cupola-solve wall.yaml --assembly assembly.vtu --output results --quiet";
const std::string kPost =
    "cupola-post analyse wall.yaml --assembly assembly.vtu --results results --output post --quiet";
const std::string kSentence = "material.unit_weight = 18 N/m3: 3000 to 80000 N/m3 expected; in kN/m3";

void write_wall(const ProgramFolder& folder, const std::string& rest) {
  std::ofstream(folder.file("wall.yaml"))
      << "geometry: {surface: {type: wall, length: 2, height: 1, thickness: 0.3}, bond: {type: running, "
         "rings: 3, blocks_per_ring: 2}}\njoints: {friction: 0.6, compliance: {per: area}}\n"
      << rest;
}

TEST(Warnings, ArePrintedOnceAndKept) {
  const ProgramFolder folder;
  write_wall(folder, "material: {unit_weight: 18}\npostproc: {sections: [100]}\n");
  const ProgramRun generated = folder.run(kGenerate);
  EXPECT_EQ(generated.code, 0);
  EXPECT_EQ(generated.err.find("cupola-generate: warning: " + kSentence), 0u) << generated.err;
  EXPECT_NE(generated.err.find("postproc.sections: the height 100 m cuts no block"), std::string::npos);
  EXPECT_EQ(std::count(generated.err.begin(), generated.err.end(), '\n'), 2) << generated.err;
  const ProgramRun solved = folder.run(kSolve);
  EXPECT_EQ(solved.code, 0);
  EXPECT_EQ(solved.err, "");
  const ProgramRun drawn = folder.run(kPost);
  EXPECT_EQ(drawn.code, 0);
  EXPECT_EQ(drawn.err, "");
  for (const char* file : {"results/summary.json", "post/summary.json", "post/report.html"})
    EXPECT_NE(slurp(folder.file(file)).find(kSentence), std::string::npos) << file;
  // What the generator has not seen is printed where it appears.
  const ProgramRun slippery = folder.run(kSolve + " --set joints.friction=30");
  EXPECT_EQ(slippery.err.find("cupola-solve: warning: joints.friction = 30: at most 3 expected"), 0u)
      << slippery.err;
  EXPECT_EQ(std::count(slippery.err.begin(), slippery.err.end(), '\n'), 1) << slippery.err;
}

TEST(Warnings, SoftJointsAreFoundBeforeTheSolve) {
  const ProgramFolder folder;
  write_wall(folder, "");
  ASSERT_EQ(folder.run(kGenerate).code, 0);
  const std::string soft = " --set joints.compliance.normal=9e-7";
  const ProgramRun solved = folder.run(kSolve + soft);
  EXPECT_EQ(solved.code, 0);
  EXPECT_NE(solved.err.find("lets the model sink by about"), std::string::npos) << solved.err;
  EXPECT_NE(slurp(folder.file("results/summary.json")).find("lets the model sink by about"),
            std::string::npos);
  EXPECT_EQ(folder.run(kSolve + soft + " --strict").code, 2);
  const ProgramRun moving =
      folder.run(kSolve + soft + " --set analysis.type=dynamic --set analysis.duration=0.02");
  EXPECT_NE(moving.err.find("lets the model sink by about"), std::string::npos) << moving.err;
}

// A block that is thrown up bounces on joints that take longer than a step to stop it. The results stay.
TEST(Warnings, OfTheResultsAreErrorsToo) {
  const ProgramFolder folder;
  std::ofstream(folder.file("wall.yaml"))
      << "geometry: {surface: {type: wall, length: 1, height: 1, thickness: 1}, bond: {type: stack, "
         "rings: 1, blocks_per_ring: 1, slices_per_block: 1}}\n"
         "joints: {friction: 0.7, compliance: {normal: 1e-9, tangential: 1e-9, per: area}}\n"
         "loads: {forces: [{block: 1, force: [0, 0, 1e5], time: {type: table, times: [0, 0.1, 0.1001], "
         "values: [1, 1, 0]}}]}\n"
         "analysis: {type: dynamic, friction_law: coulomb, time_step: 1e-3, duration: 1.5}\n";
  ASSERT_EQ(folder.run(kGenerate).code, 0);
  const ProgramRun solved = folder.run(kSolve + " --strict");
  EXPECT_EQ(solved.code, 2);
  EXPECT_NE(solved.err.find("cupola-solve: warning: blocks met and bounced"), std::string::npos)
      << solved.err;
  EXPECT_NE(slurp(folder.file("results/summary.json")).find("blocks met and bounced"), std::string::npos);
}

TEST(Warnings, AreErrorsWithStrict) {
  const ProgramFolder folder;
  write_wall(folder, "material: {unit_weight: 18}\n");
  for (const std::string& command :
       {kGenerate, kGenerate + " --check", kSolve + " --check", kPost + " --check"}) {
    EXPECT_EQ(folder.run(command + " --strict --set material.unit_weight=18000").code, 0) << command;
    const ProgramRun run = folder.run(command + " --strict");
    EXPECT_EQ(run.code, 2) << command;
    EXPECT_NE(run.err.find("warning: " + kSentence), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("error: --strict: the warning above is an error"), std::string::npos) << run.err;
  }
  ASSERT_EQ(folder.run(kGenerate).code, 0);
  EXPECT_EQ(folder.run(kSolve + " --strict").code, 2) << "although the generator has printed it";
  ASSERT_EQ(folder.run(kSolve).code, 0);
  EXPECT_EQ(folder.run(kPost + " --strict").code, 2);
}

TEST(Warnings, OneSetOptionChangesSeveralKeys) {
  const ProgramFolder folder;
  write_wall(folder, "");
  for (const std::string options :
       {"--set joints.friction=30 material.unit_weight=18 --check wall.yaml",
        "wall.yaml --set joints.friction=30 --check --set material.unit_weight=18",
        "--set joints.friction=30 material.unit_weight=18 wall.yaml --check"}) {
    const ProgramRun run = folder.run("cupola-generate " + options);
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.err.find(kSentence), std::string::npos) << options << "\n" << run.err;
    EXPECT_NE(run.err.find("joints.friction = 30"), std::string::npos) << options << "\n" << run.err;
  }
}

// Colour and control characters belong on a terminal only.
TEST(Warnings, AreNotColouredInAFile) {
  const ProgramFolder folder;
  write_wall(folder, "material: {unit_weight: 18}\n");
  EXPECT_EQ(folder.run(kGenerate).err.find('\033'), std::string::npos);
  EXPECT_EQ(folder.run(kSolve + " --nonsense").err.find('\033'), std::string::npos);
}

/// All warnings that the programs give for a case as shipped.
std::vector<std::string> all_warnings(const std::string& path,
                                      const std::vector<std::string>& settings = {}) {
  Case scene = read_case(path, settings);
  const Assembly assembly = generate(scene);
  resolve_compliance(assembly, scene.loads.gravity, &scene.joints.compliance);
  std::vector<std::string> warnings = assembly.case_warnings;
  const auto add = [&warnings](const std::vector<std::string>& more) {
    warnings.insert(warnings.end(), more.begin(), more.end());
  };
  add(assembly.block_warnings);
  add(geometry_warnings(assembly, detection_options(scene)));
  add(joint_warnings(scene, assembly,
                     ContactDetector(assembly, detection_options(scene)).update(initial_poses(assembly)),
                     false));
  return warnings;
}

// Of the cases of thousands of blocks one suffices in the fast test.
TEST(Warnings, NoSmallShippedCaseWarns) {
  for (const std::string name : {"portal", "wall_window", "wall_small", "wall_herringbone", "dome_circular"})
    EXPECT_EQ(all_warnings(bundled_folder() + "/" + name + ".yaml"), std::vector<std::string>{}) << name;
}

// Joints that an imperfection opens are still joints.
TEST(Warnings, NoBlockOfAModelWithGapsLacksJoints) {
  EXPECT_EQ(all_warnings(bundled_folder() + "/dome_circular.yaml", {"imperfections.gap=2e-4"}),
            std::vector<std::string>{});
}

/// Runs whose warnings are right.
bool is_doubtful(const std::string& name) {
  return name == "wall_j4d_force" ||  // the density of its beam stands for a load
         name ==
             "arch_moved" ||  // exported under load: its blocks overlap by what they compress their joints
         name ==
             "dome_circular_herringbone_gap1e-2" ||  // its gaps of 10 mm let corners overlap by some 1e-7 m
         name.starts_with("cross_vault") ||
         name.starts_with("pavilion_vault") ||  // drawn elsewhere, with slivers
         (name.starts_with("dome_circular_state") && name.ends_with("_soft"));
}

TEST(WarningsSlow, NoShippedCaseWarns) {
  for (const auto& entry : std::filesystem::directory_iterator(bundled_folder())) {
    if (entry.path().extension() != ".yaml") continue;
    if (is_doubtful(entry.path().stem())) continue;
    EXPECT_EQ(all_warnings(entry.path().string()), std::vector<std::string>{}) << entry.path();
  }
}

TEST(WarningsSlow, NoVariantOfAShippedCaseWarns) {
  std::istringstream lines(slurp(bundled_folder() + "/variants.txt"));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, shipped, word;
    if (!(words >> name >> shipped) || name.starts_with("#")) continue;
    if (is_doubtful(name)) continue;
    std::vector<std::string> settings;
    while (words >> word)
      if (!word.starts_with("--")) settings.push_back(word);
    EXPECT_EQ(all_warnings(bundled_folder() + "/" + shipped + ".yaml", settings), std::vector<std::string>{})
        << name;
  }
}

}  // namespace
}  // namespace cupola::warnings_test
