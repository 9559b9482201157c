// The generator's checks and contact detection apply one rule (assembly/model/joint_rule.hpp): what the
// generator accepts as a joint makes contacts, and what it refuses the solver refuses too.

#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/files/assembly_file.hpp"
#include "generators/generate.hpp"
#include "solver/collision/geometry_warnings.hpp"
#include "tests/pipeline/program_run.hpp"

namespace cupola::joint_rule_test {
namespace {

/// A box as an OBJ object.
std::string obj_box(const std::string& name, const Vec3& low, const Vec3& size, int first) {
  std::string text = "o " + name + "\n";
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 at = low + Vec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1).cwiseProduct(size);
    text += fmt::format("v {} {} {}\n", at.x(), at.y(), at.z());
  }
  for (const auto& f :
       {std::array{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 2, 6, 5}, {3, 7, 8, 4}, {1, 5, 7, 3}, {2, 4, 8, 6}})
    text += fmt::format("f {} {} {} {}\n", first + f[0] - 1, first + f[1] - 1, first + f[2] - 1,
                        first + f[3] - 1);
  return text;
}

struct TwoBlocks {
  bool refused_by_generator = false, refused_by_solver = false;
  int joints = 0, patches = 0;
  std::string report;                 // of the generator
  std::vector<std::string> warnings;  // of the solver
  std::string message;
};

/// A block of 80 mm on a fixed one, displaced by `shift` (m) from the place where it rests on it entirely.
TwoBlocks two_blocks(const Vec3& shift, bool supported = true) {
  const ProgramFolder folder;
  const std::string path = folder.file("two.obj");
  const Vec3 size = Vec3::Constant(0.08);
  std::ofstream(path) << obj_box("base", Vec3::Zero(), size, 1) +
                             obj_box("top", Vec3(0, 0, 0.08) + shift, size, 9);
  Case scene;
  scene.geometry.imported.emplace();
  scene.geometry.imported->path = path;
  if (supported) scene.geometry.imported->supports = {"base"};
  TwoBlocks result;
  GenerateReport report;
  try {
    generate(scene, &report);
    result.joints = report.model.num_joints;
    result.report = fmt::format("{}", fmt::join(warnings_of(report), "\n"));
  } catch (const InputError& error) {
    result.refused_by_generator = true;
    result.message = error.what();
  }
  Assembly assembly = import_blocks(*scene.geometry.imported, 1800.0);
  try {
    result.warnings = geometry_warnings(assembly, {});
    result.patches =
        static_cast<int>(ContactDetector(assembly, {}).update(initial_poses(assembly)).patches.size());
  } catch (const InputError&) {
    result.refused_by_solver = true;
  }
  return result;
}

// The margin is 1 % of the block, 0.8 mm; the least width of a joint is a tenth of that.
TEST(JointRule, IsTheSameInGeneratorAndSolver) {
  for (const double overlap : {1e-5, 0.7e-3, 0.9e-3, 5e-3}) {
    const TwoBlocks found = two_blocks(Vec3(0, 0, -overlap));
    EXPECT_EQ(found.refused_by_generator, overlap > 0.8e-3) << overlap;
    EXPECT_EQ(found.refused_by_solver, overlap > 0.8e-3) << overlap;
  }
  for (const double gap : {0.0, 1e-5, 0.7e-3, 0.9e-3, 5e-3}) {
    const TwoBlocks found = two_blocks(Vec3(0, 0, gap));
    EXPECT_EQ(found.joints, gap < 0.8e-3 ? 1 : 0) << gap;
    EXPECT_EQ(found.patches, gap < 0.8e-3 ? 1 : 0) << gap;
  }
  for (const double width : {1e-6, 5e-5, 1e-4, 1e-3}) {
    const TwoBlocks found = two_blocks(Vec3(0.08 - width, 0, 0));
    EXPECT_EQ(found.joints, width > 0.8e-4 ? 1 : 0) << width;
    EXPECT_EQ(found.patches, width > 0.8e-4 ? 1 : 0) << width;
  }
}

TEST(JointRule, ABearingThatIsIgnoredIsNamedByBoth) {
  const TwoBlocks found = two_blocks(Vec3(0.08 - 5e-5, 0, 0));
  const std::string sentence =
      "blocks base and top: their joint is only 5e-05 m wide, less than 1e-3 of the smallest block, and is "
      "ignored";
  EXPECT_NE(found.report.find(sentence), std::string::npos) << found.report;
  ASSERT_EQ(found.warnings.size(), 1u);
  EXPECT_EQ(found.warnings.front(), sentence);
}

TEST(JointRule, AnOverlapIsNamedWithTheKeyThatAllowsIt) {
  const TwoBlocks found = two_blocks(Vec3(0, 0, -0.9e-3));
  EXPECT_NE(found.message.find("overlap by 0.0009 m, more than contact.margin = 0.0008 m"), std::string::npos)
      << found.message;
}

TEST(JointRule, WithoutAFixedBlockBothProgramsSayWhatToSet) {
  const char* advice =
      "no block is fixed: set geometry.import.supports, flagged_supports, fixed_by or fixed_below";
  EXPECT_NE(two_blocks(Vec3::Zero(), false).report.find(advice), std::string::npos);

  const ProgramFolder folder;
  std::ofstream(folder.file("one.obj")) << obj_box("one", Vec3::Zero(), Vec3::Ones(), 1);
  std::ofstream(folder.file("one.yaml"))
      << "geometry: {import: {file: one.obj}}\njoints: {compliance: {per: point}}\n";
  EXPECT_EQ(folder.run("cupola-generate one.yaml --output one.vtu").code, 0);
  const ProgramRun solved = folder.run("cupola-solve one.yaml --assembly one.vtu --output results");
  EXPECT_EQ(solved.code, 2);
  EXPECT_NE(solved.err.find(advice), std::string::npos) << solved.err;
  EXPECT_EQ(std::count(solved.err.begin(), solved.err.end(), '\n'), 1) << solved.err;
}

TEST(BlockNames, WorkWhereverNumbersDo) {
  const ProgramFolder folder;
  const Vec3 size = Vec3::Ones();
  std::ofstream(folder.file("tower.obj")) << obj_box("the ground", Vec3(0, 0, -1), size, 1) +
                                                 obj_box("b5_2", Vec3::Zero(), size, 9) +
                                                 obj_box("7", Vec3(0, 0, 1), size, 17);
  const auto write_case = [&](const std::string& block) {
    std::ofstream(folder.file("tower.yaml"))
        << "geometry: {import: {file: tower.obj, supports: [the ground]}}\n"
           "joints: {compliance: {per: point}}\n"
           "loads: {forces: [{block: " +
               block +
               ", force: [0, 0, -1000]}]}\n"
               "ties: {pairs: [{block_a: b5_2, block_b: \"7\"}]}\n"
               "supports: {moves: [{blocks: [the ground], displacement: [0, 0, 0]}]}\n";
  };
  write_case("b5_3");
  const ProgramRun misspelt = folder.run("cupola-generate tower.yaml --output tower.vtu");
  EXPECT_EQ(misspelt.code, 2);
  EXPECT_NE(misspelt.err.find("loads.forces[0].block: no block is named 'b5_3'; did you mean 'b5_2'?"),
            std::string::npos)
      << misspelt.err;

  // Named, and by its number.
  std::map<std::string, std::string> joints;
  for (const std::string block : {"b5_2", "1"}) {
    write_case(block);
    ASSERT_EQ(folder.run("cupola-generate tower.yaml --output tower.vtu").code, 0);
    const ProgramRun solved = folder.run("cupola-solve tower.yaml --assembly tower.vtu --output results");
    ASSERT_EQ(solved.code, 0) << solved.err;
    const ProgramRun post = folder.run(
        "cupola-post analyse tower.yaml --assembly tower.vtu --results results --output post --tables");
    ASSERT_EQ(post.code, 0) << post.err;
    joints[block] = slurp(folder.file("post/joints.csv"));
  }
  EXPECT_EQ(joints["b5_2"], joints["1"]);
  EXPECT_EQ(joints["1"].find("block_a,block_a_name,block_b,block_b_name,kind"), 0u) << joints["1"];
  EXPECT_NE(joints["1"].find("\n0,the ground,1,b5_2,"), std::string::npos) << joints["1"];
  EXPECT_EQ(read_assembly(folder.file("tower.vtu")).blocks.at(2).name, "7");
}

}  // namespace
}  // namespace cupola::joint_rule_test
