// Symmetries that the program finds by itself, and the ends of ranges that follow from others by them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/base/counted.hpp"
#include "assembly/case/case_reader.hpp"
#include "generators/generate.hpp"
#include "solver/analysis/admissible/range_end.hpp"
#include "solver/analysis/admissible/range_objectives.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/statics/model_symmetry.hpp"

namespace cupola::symmetry_test {
namespace {

const std::string kCases = CUPOLA_SOURCE_DIR "/cases/";

Case dome(std::vector<std::string> more = {}) {
  std::vector<std::string> all{"geometry.bond.rings=2", "geometry.bond.blocks_per_ring=8",
                               "geometry.bond.slices_per_block=2", "analysis.type=range",
                               "analysis.range.quantities=[{type: all_joints}]"};
  all.insert(all.end(), more.begin(), more.end());
  return read_case(kCases + "dome_circular.yaml", all);
}

RigidScene rigid(const Case& scene, const Assembly& assembly) {
  return rigid_scene(scene, std::shared_ptr<const Assembly>(&assembly, [](const Assembly*) {}));
}

std::vector<ModelSymmetry> symmetries_of(const RigidScene& scene) {
  return find_symmetries(scene.model, scene.start, scene.contacts);
}

TEST(Symmetries, AreThoseOfTheModelAndItsLoads) {
  const Assembly shell = generate(dome());
  EXPECT_EQ(symmetries_of(rigid(dome(), shell)).size(), 2u * 8 - 1);
  const Case pushed = dome({"loads.forces=[{block: 3, force: [0, 0, -1000]}]"});
  EXPECT_EQ(symmetries_of(rigid(pushed, shell)).size(), 1u) << "the plane through the load";
  const Case arch = read_case(kCases + "arch.yaml");
  const Assembly stones = generate(arch);
  EXPECT_EQ(symmetries_of(rigid(arch, stones)).size(), 3u) << "two planes and half a turn";
}

// A motion and forces do the same work after both were mapped, whatever they are: the equilibrium of mapped
// forces and the proof of a mapped motion follow from it.
TEST(Symmetries, KeepThePowerOfForcesOnMotions) {
  const Assembly shell = generate(dome());
  const RigidScene scene = rigid(dome(), shell);
  const ContactProblem& p = scene.problem.contacts;
  const VecX v = VecX::LinSpaced(6 * p.num_blocks(), -1.0, 2.0).array().sin();
  const VecX gamma = VecX::LinSpaced(3 * p.num_contacts(), 3.0, -70.0).array().cos();
  const double power = gamma.dot(relative_velocity(p, v)), load = scene.problem.load.dot(v);
  for (const ModelSymmetry& symmetry : symmetries_of(scene)) {
    const VecX image = symmetry.velocities(v);
    constexpr double kRounding = 1e-10;  // of coordinates of 1e-14 over blocks of a few metres, 1e3 contacts
    EXPECT_NEAR(symmetry.forces(p, gamma).dot(relative_velocity(p, image)), power, kRounding * gamma.norm());
    EXPECT_NEAR(scene.problem.load.dot(image), load, kRounding * scene.problem.load.norm());
  }
}

/// The ranges against a solve of every end.
void expect_ends_of_own_solves(const Case& of_case, const Assembly& assembly, int images) {
  const Summary summary = run_range(of_case, assembly, {}).value();
  const RigidScene scene = rigid(of_case, assembly);
  const auto objectives =
      range_objectives(of_case.analysis.range.quantities.at(0), of_case, scene.model, scene.contacts);
  ASSERT_EQ(summary.ranges.size(), objectives.size());
  const std::string follow = images > 0 ? fmt::format("; {} from others", counted(images, "end")) : "";
  EXPECT_EQ(summary.message.find("by symmetry") != std::string::npos, images > 0) << summary.message;
  EXPECT_NE(summary.message.find(follow), std::string::npos) << summary.message;
  const double slack = 1e-8 * scene.model.block_weight;  // ten times the tolerance of a solve
  for (size_t i = 0; i < objectives.size(); ++i) {
    EXPECT_EQ(summary.ranges[i].max.outcome, RangeOutcome::bounded);
    EXPECT_NEAR(*summary.ranges[i].max.value, *range_end(scene, objectives[i], -1.0).end.value, slack) << i;
    EXPECT_NEAR(*summary.ranges[i].min.value, *range_end(scene, objectives[i], 1.0).end.value, slack) << i;
  }
}

// Two rings of eight blocks have 8 joints on the base, 16 beds between them and two times 8 heads. One of
// each kind is solved; the least forces of the 16 beds vanish in states of other ends.
TEST(RangesBySymmetry, AreThoseOfOwnSolves) {
  const Case scene = dome();
  expect_ends_of_own_solves(scene, generate(scene), (7 + 15 + 2 * 7) + (7 + 2 * 7));
}

// The finder accepts it, for coordinates of files have few digits, but no end of another joint proves its
// own.
TEST(RangesBySymmetry, AreSolvedWhereCoordinatesAreNearlySymmetric) {
  const Case scene = dome();
  Assembly assembly = generate(scene);
  assembly.vertices[assembly.face(assembly.parts[5].face_start)[0]].z() += 1e-7;
  expect_ends_of_own_solves(scene, assembly, 0);
}

}  // namespace
}  // namespace cupola::symmetry_test
