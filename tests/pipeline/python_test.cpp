// The Python of docs/python.md, run as it stands there, with Debian's pandas and VTK. Continuous integration
// sets CUPOLA_REQUIRE_PYTHON, so that the tests run there in any case.

#include <cstdlib>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/pipeline/program_run.hpp"

namespace cupola::python_test {
namespace {

/// The n-th block of Python of the page.
std::string python_of_page(int n) {
  const std::string page = slurp(CUPOLA_SOURCE_DIR "/docs/python.md"), fence = "```python\n";
  size_t start = 0;
  for (int i = 0; i <= n; ++i) start = page.find(fence, start) + fence.size();
  return page.substr(start, page.find("```", start) - start);
}

bool has_python(const std::string& needs) {
  return std::getenv("CUPOLA_REQUIRE_PYTHON") != nullptr ||
         std::system((needs + " >/dev/null 2>&1").c_str()) == 0;
}

void write_script(const ProgramFolder& folder, const std::string& text) {
  std::ofstream(folder.file("script.py")) << text;
}

const std::string kWall = CUPOLA_SOURCE_DIR "/cases/wall_large.yaml";

void solve_wall(const ProgramFolder& folder) {
  ASSERT_EQ(folder.run("cupola-generate " + kWall + " --output assembly.vtu --quiet").code, 0);
  ASSERT_EQ(folder.run("cupola-solve " + kWall + " --assembly assembly.vtu --output results --quiet").code,
            0);
}

// The printed table has one row per course, and its sums are those of the file.
TEST(Python, ReadsTheTablesWithPandas) {
  if (!has_python("/usr/bin/python3 -c 'import pandas'")) GTEST_SKIP() << "python3-pandas is not installed";
  const ProgramFolder folder;
  solve_wall(folder);
  ASSERT_EQ(folder
                .run("cupola-post analyse " + kWall +
                     " --assembly assembly.vtu --results results --tables --quiet"
                     " --output out/dome_circular/post")
                .code,
            0);
  write_script(
      folder,
      python_of_page(0) +
          "import csv\n"
          "rows = list(csv.DictReader(open('out/dome_circular/post/joints.csv')))\n"
          "total = sum(float(r['normal_force_N']) for r in rows if r['kind'] in ('base', 'bed'))\n"
          "assert abs((by_course['mean'] * by_course['count']).sum() - total) < 1e-9 * total\n"
          "assert set(by_course.index) == {int(r['ring']) for r in rows if r['kind'] in ('base', 'bed')}\n");
  const ProgramRun run = folder.run("/usr/bin/python3 script.py");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("count"), std::string::npos) << run.out;
}

// Every block is an actor of the scene, and the picture is not empty.
TEST(Python, DrawsTheSceneWithVtk) {
  if (!has_python("/usr/bin/python3 -c 'import vtkmodules.all' && command -v xvfb-run"))
    GTEST_SKIP() << "python3-vtk9 or xvfb is not installed";
  const ProgramFolder folder;
  solve_wall(folder);
  const ProgramRun exported = folder.run("cupola-post export " + kWall +
                                         " --assembly assembly.vtu --results results --output dome.gltf");
  ASSERT_EQ(exported.code, 0) << exported.err;
  write_script(folder, python_of_page(1) + python_of_page(2) +
                           "print(importer.GetRenderer().GetActors().GetNumberOfItems())\n"
                           "low, high = grab.GetOutput().GetPointData().GetScalars().GetRange(1)\n"
                           "assert high - low > 50, (low, high)\n");
  const ProgramRun run = folder.run("xvfb-run -a /usr/bin/python3 script.py");
  ASSERT_EQ(run.code, 0) << run.err;
  int blocks = 0;
  const ProgramRun listed =
      folder.run("cupola-generate " + kWall + " --output again.vtu --export blocks.csv --quiet");
  ASSERT_EQ(listed.code, 0) << listed.err;
  const std::string table = slurp(folder.file("blocks.csv"));
  blocks = static_cast<int>(std::count(table.begin(), table.end(), '\n')) - 1;
  EXPECT_EQ(run.out, fmt::format("{}\n", blocks + 1)) << "one actor per block and one for the forces";
}

}  // namespace
}  // namespace cupola::python_test
