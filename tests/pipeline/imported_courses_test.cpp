// A vault that comes back from a file without courses and kinds of faces has the results of the generated
// one.
#include <gtest/gtest.h>

#include "assembly/case/case_reader.hpp"
#include "assembly/export/export.hpp"
#include "generators/generate.hpp"
#include "postproc/mechanics/ring_sums.hpp"
#include "postproc/mechanics/thrust_line.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/fresh_folder.hpp"

namespace cupola::imported_courses_test {
namespace {

/// The octagonal vault of the repository in fewer blocks. Per area, because the support has other parts and
/// so other points.
Case octagon(std::vector<std::string> more) {
  for (const char* set :
       {"geometry.bond.rings=10", "geometry.bond.blocks_per_ring=16", "analysis.tolerance=1e-13",
        "joints.compliance={normal: 1e-9, tangential: 1e-9, per: area}"})
    more.emplace_back(set);
  return read_case(CUPOLA_SOURCE_DIR "/cases/octagon_circular.yaml", more);
}

/// The case with its blocks from a file instead, in which they have numbers only.
Case imported(Case scene) {
  const std::string path = test::fresh_folder("imported_courses") + "/model.obj";
  write_export(path, {cut_assembly(scene), {}, {}});
  scene.geometry = Geometry{};
  scene.geometry.imported.emplace();
  scene.geometry.imported->path = path;
  scene.geometry.imported->fixed_by = ImportedBlocks::SupportRule::lowest;
  return scene;
}

struct Results {
  std::vector<RingSum> rings;
  std::vector<ThrustLine> lines;
  double weight = 0.0;  // N
};

Results results_of(const Case& scene, const std::vector<std::optional<double>>& azimuths) {
  const Assembly assembly = generate(scene);
  Frame frame;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& f) { frame = f; };
  const Summary summary = run_static(scene, assembly, sinks);
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  const Shell shell = shell_of(assembly, Vec3::UnitZ());
  const JointWrenches joints = joint_wrenches(assembly, frame.contacts, shell, 0.0);
  const std::vector<Wrench> from_below = wrenches_from_below(assembly, joints);
  Results results;
  results.weight = summary.weight_N;
  results.rings = ring_sums(assembly, shell, joints, from_below, scene.loads.gravity, {});
  const ThrustInput input{&assembly, &shell, &frame.contacts, &joints, from_below, scene.loads.gravity};
  for (const std::optional<double>& azimuth : azimuths)
    results.lines.push_back(thrust_line(input, "line", azimuth));
  return results;
}

// The coordinates of the file have 17 digits. Forces differ by the rounding of sums over the contacts in
// another order.
void expect_same_results(const Case& scene, const std::vector<std::optional<double>>& azimuths) {
  constexpr double kSame = 1e-9;
  const Results expected = results_of(scene, azimuths), found = results_of(imported(scene), azimuths);
  ASSERT_EQ(found.rings.size(), expected.rings.size());
  for (size_t k = 0; k < found.rings.size(); ++k) {
    EXPECT_EQ(found.rings[k].blocks, expected.rings[k].blocks);
    EXPECT_NEAR(found.rings[k].radial_thrust, expected.rings[k].radial_thrust, kSame * expected.weight) << k;
    EXPECT_NEAR((found.rings[k].joint_force - expected.rings[k].joint_force).norm(), 0.0,
                kSame * expected.weight);
    EXPECT_NEAR(found.rings[k].height, expected.rings[k].height, kSame) << k;
  }
  for (size_t i = 0; i < found.lines.size(); ++i) {
    const ThrustLine &a = expected.lines[i], &b = found.lines[i];
    ASSERT_EQ(b.points.size(), a.points.size());
    ASSERT_GT(a.points.size(), 8u);
    for (size_t p = 0; p < a.points.size(); ++p) {
      EXPECT_NEAR((b.points[p].point - a.points[p].point).norm(), 0.0, kSame) << i << " " << p;
      EXPECT_NEAR(b.points[p].position, a.points[p].position, kSame) << i << " " << p;
      EXPECT_NEAR(b.points[p].r, a.points[p].r, kSame * expected.weight) << i << " " << p;
    }
  }
}

TEST(ImportedCourses, GiveTheRingsAndThrustLinesOfTheGeneratedVault) {
  expect_same_results(octagon({}), {0.0, 22.5, 100.0});
}

TEST(ImportedCourses, GiveTheThrustLineOfTheGeneratedArch) {
  expect_same_results(
      read_case(CUPOLA_SOURCE_DIR "/cases/arch.yaml", {"analysis={type: static, tolerance: 1e-13}"}),
      {std::nullopt});
}

TEST(ImportedCourses, GiveTheRangeOfTheThrustOfTheGeneratedVault) {
  const Case scene =
      octagon({"analysis.type=range", "analysis.range.quantities=[thrust]", "analysis.tolerance=1e-9"});
  const auto range = [](const Case& one) {
    const Summary summary = run_range(one, generate(one), {}).value();
    EXPECT_EQ(summary.status, Status::stable) << summary.message;
    return summary.ranges.at(0);
  };
  const ForceRange expected = range(scene), found = range(imported(scene));
  // Both programmes see the same contact points to the rounding of their coordinates.
  EXPECT_NEAR(*found.min.value, *expected.min.value, 1e-9 * std::abs(*expected.min.value));
  EXPECT_NEAR(*found.max.value, *expected.max.value, 1e-9 * std::abs(*expected.max.value));
}

}  // namespace
}  // namespace cupola::imported_courses_test
