// The scripts for ParaView against the files of a run: every file, array and code that they name exists. They
// run in Python with a stand-in for ParaView (paraview_double/) that reads the files with VTK; Debian
// installs Python's VTK with its headers. The slow test ParaViewSlow runs them in ParaView itself.

#include "tests/pipeline/program_run.hpp"

namespace cupola::paraview_test {
namespace {

constexpr const char* kDome = R"(
geometry:
  surface: {type: dome, span: 45, radius_ratio: 0.8, thickness: 2.2, crown_angle_deg: 60}
  bond: {type: running, rings: 6, blocks_per_ring: 8, slices_per_block: 2}
material: {unit_weight: 18000}
joints: {friction: 0.4, compliance: {normal: 1e-8, tangential: 1e-8, per: point}}
postproc:
  meridians: [{name: east, azimuth_deg: 0}]
  sections: [10]
)";

/// Runs a dome through the three programs, into post/.
void run_dome(const ProgramFolder& folder, const std::string& set) {
  std::ofstream(folder.file("dome.yaml")) << kDome;
  for (const std::string& stage :
       {"cupola-generate dome.yaml --quiet --output dome.vtu" + set,
        "cupola-solve dome.yaml --quiet --assembly dome.vtu --output results" + set,
        "cupola-post analyse dome.yaml --quiet --assembly dome.vtu --results results --output post" + set}) {
    const ProgramRun run = folder.run(stage);
    ASSERT_EQ(run.code, 0) << stage << "\n" << run.err;
  }
}

bool has_vtk(const ProgramFolder& folder) {
  return folder.run("/usr/bin/python3 -c 'import vtkmodules.vtkIOXML'").code == 0;
}

/// Runs a script of the folder post/ in the stand-in. Its output names what it read and coloured.
ProgramRun run_script(const ProgramFolder& folder, const std::string& script) {
  return folder.run("env CUPOLA_POST=post PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=" CUPOLA_SOURCE_DIR
                    "/tests/pipeline/paraview_double /usr/bin/python3 " +
                    script);
}

TEST(ParaViewScripts, NameTheFilesAndArraysOfARun) {
  const ProgramFolder folder;
  if (!has_vtk(folder)) GTEST_SKIP() << "the VTK module of Python is not installed";
  run_dome(folder, "");
  const ProgramRun opened = run_script(folder, "post/open_in_paraview.py");
  EXPECT_EQ(opened.code, 0) << opened.err;
  EXPECT_EQ(opened.out,
            "array force_magnitude_N of joint_forces.vtp\narray hoop_force_N_per_m of blocks_0000.vtu\n"
            "array resultant_N of wrenches.vtp\nfile blocks.pvd\nfile cracks.vtp\nfile joint_forces.vtp\n"
            "file sections.vtp\nfile thrust_lines.vtp\nfile wrenches.vtp\n");
  // The stand-in refuses what a run does not have.
  for (const std::string wrong :
       {"s/force_magnitude_N/force_magnitude/ post/open_in_paraview.py",
        "s/left, .hoop_force_N_per_m./left, \"hoop_force\"/ post/open_in_paraview.py"}) {
    EXPECT_EQ(
        folder
            .run("sed '" + wrong.substr(0, wrong.find(" post")) + "' " + wrong.substr(wrong.find("post/")) +
                 " > wrong.py; cmp -s wrong.py " + wrong.substr(wrong.find("post/")))
            .code,
        1)
        << wrong << " changes nothing";
    EXPECT_EQ(run_script(folder, "wrong.py").code, 1) << wrong;
  }
}

TEST(ParaViewScripts, ShowTheBodiesOfAMechanism) {
  const ProgramFolder folder;
  if (!has_vtk(folder)) GTEST_SKIP() << "the VTK module of Python is not installed";
  run_dome(folder, " --set joints.friction=0.01");
  const ProgramRun opened = run_script(folder, "post/open_in_paraview.py");
  EXPECT_EQ(opened.code, 0) << opened.err;
  EXPECT_NE(opened.out.find("array mechanism_group of blocks_0000.vtu"), std::string::npos) << opened.out;
  EXPECT_EQ(opened.out.find("hoop_force"), std::string::npos) << opened.out;
}

}  // namespace
}  // namespace cupola::paraview_test
