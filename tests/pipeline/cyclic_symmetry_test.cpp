// The solution of one sector with cyclic boundary conditions equals that of the whole model.

#include <map>
#include <ostream>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "generators/generate.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/pipeline/static_run.hpp"

namespace cupola::cyclic_symmetry_test {
namespace {

struct Answer {
  std::map<std::pair<int, int>, Vec3> forces;  // on each joint, N
  Summary summary;
  std::vector<Vec3> displacement;
};

Answer solve(const Case& scene, const Assembly& assembly) {
  Answer answer;
  const Frame last = solve_to_rest(scene, assembly, &answer.summary);
  for (int i = 0; i < last.contacts.size(); ++i)
    answer.forces.try_emplace({last.contacts.block_a[i], last.contacts.block_b[i]}, Vec3::Zero())
        .first->second += last.contacts.force[i];
  for (const auto& displacement : last.blocks.displacement) answer.displacement.push_back(displacement);
  return answer;
}

/// Largest difference of a joint force, over the largest joint force.
double worst_difference(const Answer& whole, const Answer& sector) {
  EXPECT_EQ(whole.forces.size(), sector.forces.size());
  double worst = 0.0, largest = 0.0;
  for (const auto& [joint, force] : whole.forces) {
    worst = std::max(worst, (sector.forces.at(joint) - force).norm());
    largest = std::max(largest, force.norm());
  }
  return worst / largest;
}

Case dome(int blocks_per_ring) {
  Case scene;
  RunningBond bond;
  bond.rings = 10;
  bond.blocks_per_ring = blocks_per_ring;
  bond.slices_per_block = 2;
  scene.geometry.bond = bond;
  scene.loads.lantern = TopLoad{0.02};
  scene.analysis.tolerance = 1e-10;
  return scene;
}

struct Model {
  const char* name;
  Case scene;
  int sectors;
  friend void PrintTo(const Model& model, std::ostream* out) { *out << model.name; }
};

std::vector<Model> models() {
  std::vector<Model> models{
      {"dome_4", dome(16), 4}, {"dome_column", dome(12), 12}, {"dome_halves", dome(12), 2}};
  Case herringbone = dome(16);
  HerringboneBond bond;
  bond.rings = 12;
  bond.blocks_per_ring = 32;
  herringbone.geometry.bond = bond;
  models.push_back({"herringbone", herringbone, 8});
  Case octagon = dome(16);
  octagon.geometry.surface = OctagonalVault{};
  octagon.joints.friction = 0.6;
  models.push_back({"octagon", octagon, 8});
  octagon.joints.compliance = {1e-8, 1e-8, Compliance::Per::area};
  models.push_back({"octagon_per_area", octagon, 8});
  return models;
}

class CyclicSymmetry : public ::testing::TestWithParam<Model> {};

TEST_P(CyclicSymmetry, OneSectorGivesTheWholeModelsForces) {
  Case scene = GetParam().scene;
  const Assembly assembly = generate(scene);
  const Answer whole = solve(scene, assembly);
  scene.analysis.cyclic_sectors = GetParam().sectors;
  const Answer sector = solve(scene, assembly);
  EXPECT_EQ(sector.summary.unknowns * GetParam().sectors, whole.summary.unknowns);
  // Both equilibrium residuals are below 1e-10 of a block weight; the joints carry up to ten block weights.
  EXPECT_LE(worst_difference(whole, sector), 1e-8);
  // Residuals are computed from the contacts of the whole model.
  EXPECT_LE(sector.summary.equilibrium_residual.value(), 1e-10);
  double highest = 0.0, difference = 0.0;
  for (size_t i = 0; i < whole.displacement.size(); ++i) {
    highest = std::max(highest, whole.displacement[i].norm());
    difference = std::max(difference, (whole.displacement[i] - sector.displacement[i]).norm());
  }
  EXPECT_LE(difference, 1e-6 * highest);
}

INSTANTIATE_TEST_SUITE_P(Models, CyclicSymmetry, ::testing::ValuesIn(models()),
                         [](const auto& test) { return std::string(test.param.name); });

std::string refusal(Case scene, int sectors) {
  const Assembly assembly = generate(scene);
  scene.analysis.cyclic_sectors = sectors;
  try {
    run_static(scene, assembly, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CyclicSymmetryRefusal, NamesTheCause) {
  EXPECT_NE(refusal(dome(12), 5).find("where there is no block"), std::string::npos) << refusal(dome(12), 5);

  Case pushed = dome(12);
  pushed.loads.forces.push_back({5, std::nullopt, Vec3(1000.0, 0.0, 0.0), {}});
  EXPECT_TRUE(refusal(pushed, 12)
                  .starts_with("error: analysis.cyclic_sectors = 12: the model does not have "
                               "this symmetry: the loads on blocks "))
      << refusal(pushed, 12);

  Case open = dome(12);
  open.geometry.imperfections = Imperfections{1e-3, 0.0, 1};
  EXPECT_NE(refusal(open, 12), "accepted");

  Case leaning = dome(12);
  leaning.loads.gravity = Vec3(0.5, 0.0, -9.8);
  EXPECT_NE(refusal(leaning, 4).find("loads on blocks"), std::string::npos);
}

}  // namespace
}  // namespace cupola::cyclic_symmetry_test
