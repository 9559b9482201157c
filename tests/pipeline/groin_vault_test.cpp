// The groin vault of cases/groin_vault.yaml against the slicing technique, and against itself as imported
// blocks.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>

#include "assembly/files/summary_file.hpp"
#include "postproc/tables/shell_map.hpp"
#include "tests/pipeline/program_run.hpp"

namespace cupola::groin_vault_test {
namespace {

const std::string kCase = CUPOLA_SOURCE_DIR "/cases/groin_vault.yaml";
// Fewer stones than the case, for speed.
const std::string kCoarse = " --set geometry.bond.rings=13 --set geometry.bond.blocks_per_ring=3";

Summary solve(const ProgramFolder& folder, const std::string& path, const std::string& options) {
  const ProgramRun run = folder.run("cupola-solve " + path + " --assembly a.vtu --output results " + options);
  EXPECT_EQ(run.code, 0) << run.err;
  const std::string file = folder.file("results/summary.json");
  return summary_from_json(slurp(file), file);
}

/// N: the sum over the four corners of the thrust along the diagonals. Each web is sliced into arches
/// parallel to its side, which run from the crown to the groin. The thrust of a slice acts in the middle of
/// the thickness at the crown and at the groin.
double thrust_by_slicing(double side, double thickness, double unit_weight) {
  const double inner = 0.5 * side, outer = inner + thickness, middle = inner + 0.5 * thickness;
  const double foot = std::acos((inner - 0.5 * thickness) /
                                outer);  // the back of the first bed is half as long as the shell is thick
  constexpr int kSlices = 1000;
  double sum = 0.0;
  for (int i = 0; i < kSlices; ++i) {
    const double y = inner * (i + 0.5) / kSlices;                             // m, from the axis to the side
    const double end = std::max(std::acos(std::min(y / middle, 1.0)), foot);  // angle from the springing
    const double area = 0.5 * (outer * outer - inner * inner) * (0.5 * std::numbers::pi - end);
    const double moment = (std::pow(outer, 3) - std::pow(inner, 3)) / 3.0 * (1.0 - std::sin(end));
    const double arm = middle * std::cos(end) - moment / area, rise = middle * (1.0 - std::sin(end));
    sum += unit_weight * area * arm / rise * inner / kSlices;
  }
  return 4.0 * std::numbers::sqrt2 * sum;
}

// The state of the slices is one of many. Facets take 1 % off the weight.
TEST(GroinVaultRuns, SlicingLiesInsideTheRangeOfTheThrust) {
  const ProgramFolder folder;
  ASSERT_EQ(folder.run("cupola-generate " + kCase + " --output a.vtu" + kCoarse).code, 0);
  const Summary summary =
      solve(folder, kCase, kCoarse + " --set analysis.type=range --set analysis.range.quantities=[thrust]");
  ASSERT_EQ(summary.ranges.size(), 1u);
  const double sliced = thrust_by_slicing(6.0, 0.3, 20000.0);
  ASSERT_TRUE(summary.ranges[0].min.value && summary.ranges[0].max.value);
  EXPECT_LT(*summary.ranges[0].min.value, 0.98 * sliced);
  EXPECT_GT(*summary.ranges[0].max.value, 1.02 * sliced);
}

// An OBJ file has 17 digits; the direct limit is as wide as asked, 1e-4.
TEST(GroinVaultRuns, TheSameVaultImportedHasTheSameVerdicts) {
  const ProgramFolder folder;
  const std::string limit =
      " --set analysis.type=limit --set analysis.limit.parameter=friction --set analysis.limit.low=0.1 "
      "--set analysis.limit.high=1 --set analysis.friction_law=associated";
  ASSERT_EQ(folder.run("cupola-generate " + kCase + " --output a.vtu --export vault.obj" + kCoarse).code, 0);
  const Summary drawn = solve(folder, kCase, kCoarse), drawn_limit = solve(folder, kCase, kCoarse + limit);
  std::ofstream(folder.file("imported.yaml"))
      << "geometry: {import: {file: vault.obj, fixed_below: 1.4}}\nmaterial: {unit_weight: 20000}\n"
         "joints: {friction: 0.7, compliance: {per: area}}\nanalysis: {type: static}\n";
  const ProgramRun import = folder.run("cupola-generate imported.yaml --output a.vtu");
  ASSERT_EQ(import.code, 0) << import.err;
  const Summary imported = solve(folder, "imported.yaml", ""),
                imported_limit = solve(folder, "imported.yaml", limit);
  EXPECT_EQ(imported.status, drawn.status);
  EXPECT_EQ(drawn.status, Status::stable);
  EXPECT_NEAR(imported.weight_N, drawn.weight_N, 1e-9 * drawn.weight_N);
  ASSERT_TRUE(drawn_limit.critical && imported_limit.critical);
  EXPECT_NEAR(imported_limit.critical->value, drawn_limit.critical->value,
              2e-4 * drawn_limit.critical->value);
}

// Associated friction holds it by dilatancy, up to 1.03 times this acceleration; under Coulomb's law it
// slides. That took 28,000 iterations when the search from the associated equilibrium went on although this
// equilibrium carried nothing.
TEST(GroinVaultRuns, SlidesUnderCoulombsLawAfterFewIterations) {
  const ProgramFolder folder;
  const std::string vault =
      " --set geometry.bond.rings=7 --set geometry.bond.blocks_per_ring=3 --set "
      "geometry.surface.thickness=0.5";
  ASSERT_EQ(folder.run("cupola-generate " + kCase + " --output a.vtu" + vault).code, 0);
  const std::string pushed = vault + " --set joints.friction=0.277 --set loads.gravity=[4.39,0,-9.81]";
  const Summary associated = solve(folder, kCase, pushed),
                coulomb = solve(folder, kCase, pushed + " --set analysis.friction_law=coulomb");
  EXPECT_EQ(associated.status, Status::stable) << associated.message;
  EXPECT_EQ(coulomb.status, Status::moving_unproven) << coulomb.message;
  EXPECT_LT(coulomb.iterations, 2000);
}

// Its map was "the wall from the front": each box hid the one of the web behind it.
TEST(GroinVaultRuns, TheMapShowsItsWebsBesideEachOther) {
  const ProgramFolder folder;
  ASSERT_EQ(folder.run("cupola-generate " + kCase + " --output a.vtu" + kCoarse).code, 0);
  solve(folder, kCase, kCoarse);
  const ProgramRun post = folder.run("cupola-post analyse " + kCase + kCoarse +
                                     " --assembly a.vtu --results results --output post --tables");
  ASSERT_EQ(post.code, 0) << post.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("post/wall.csv")));
  const std::vector<ShellMap> maps = read_shell_maps(folder.file("post"));
  ASSERT_EQ(maps.size(), 1u);
  EXPECT_TRUE(maps[0].vault);
  const std::vector<ShellBox>& boxes = maps[0].boxes;
  ASSERT_GT(boxes.size(), 40u);
  for (const ShellBox& a : boxes)
    for (const ShellBox& b : boxes) {
      if (a.ring != b.ring || a.block >= b.block) continue;
      EXPECT_LT(std::min(a.to, b.to) - std::max(a.from, b.from), 1e-6)  // deg; the table has twelve digits
          << a.block << " and " << b.block;
    }
}

}  // namespace
}  // namespace cupola::groin_vault_test
