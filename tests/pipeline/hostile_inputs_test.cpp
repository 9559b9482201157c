// File names that a shell or make would interpret, and cases that name parts which the blocks do not have.

#include "tests/pipeline/program_run.hpp"

namespace cupola::hostile_inputs_test {
namespace {

TEST(HostileInputs, NamesOfCasesRunNoCommand) {
  const ProgramFolder folder;
  const std::string makefile = CUPOLA_SOURCE_DIR "/Makefile.cases";
  for (const char* name : {"x;touch pwned;y.yaml", "$(shell touch pwned).yaml", "e`touch pwned`.yaml",
                           "a b.yaml", "q\"z.yaml", "it's.yaml", "c:d.yaml", "a|touch pwned.yaml",
                           "a&touch pwned.yaml", "a>pwned.yaml", "#.yaml", "%.yaml"})
    std::ofstream(folder.file(name)) << "sweep: {joints.friction: [0.3, 0.4]}\n";
  std::ofstream(folder.file("swept-case_1.yaml")) << "sweep: {joints.friction: [0.3, 0.4]}\n";
  std::ofstream(folder.file("plain.yaml")) << "title: none\n";
  const ProgramRun run = folder.run("make -f " + makefile + " FOLDER=. help");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("Cases: plain swept-case_1\n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("tabulates the runs: swept-case_1\n"), std::string::npos) << run.out;
  EXPECT_NE(run.err.find("it's.yaml"), std::string::npos) << "the ignored files are named: " << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("pwned")));
}

TEST(HostileInputs, MeridiansOfBlocksWithoutCoursesAreLeftOut) {
  const ProgramFolder folder;
  std::ofstream(folder.file("two.obj")) << R"(o ground
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
o cube
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
v 0 0 2
v 1 0 2
v 1 1 2
v 0 1 2
f 12 11 10 9
f 13 14 15 16
f 9 10 14 13
f 10 11 15 14
f 11 12 16 15
f 12 9 13 16
)";
  std::ofstream(folder.file("two.yaml")) << "geometry:\n  import: {file: two.obj, supports: [ground]}\n"
                                            "joints: {compliance: {per: area}}\n"
                                            "postproc:\n  meridians: [{name: side, azimuth_deg: 0}]\n";
  const std::string outputs = " --assembly a.vtu ";
  ASSERT_EQ(folder.run("cupola-generate two.yaml --output a.vtu").code, 0);
  ASSERT_EQ(folder.run("cupola-solve two.yaml" + outputs + "--output results").code, 0);
  const ProgramRun post =
      folder.run("cupola-post analyse two.yaml" + outputs + "--results results --output post");
  EXPECT_EQ(post.code, 0) << post.err;
  EXPECT_NE(slurp(folder.file("post/report.html")).find("the blocks have no courses"), std::string::npos);
}

}  // namespace
}  // namespace cupola::hostile_inputs_test
