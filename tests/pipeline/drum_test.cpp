// A vault on a drum with windows, and what it does when its supports settle.

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "generators/generate.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/generators/models.hpp"
#include "tests/pipeline/static_run.hpp"

namespace cupola::drum_test {
namespace {

struct Answer {
  Summary summary;
  std::map<int, double> reaction;  // N, vertical, of each fixed block
  double weight = 0.0;             // N
};

Case vault_on_drum() {
  Case scene;
  OctagonalVault vault;
  vault.span = 10.0;
  vault.radius_ratio = 0.6;
  vault.thickness = 0.6;
  scene.geometry.surface = vault;
  scene.geometry.bond = RunningBond{5, 24, 2};
  Member drum = octagonal_drum(10.0, 3.0, 1.0, RunningBond{6, 24, 2});
  drum.openings.emplace_back();
  drum.openings[0].width = 1.2;
  drum.openings[0].height = 1.0;
  drum.openings[0].sill = 1.0;
  scene.geometry.members = {drum};
  scene.geometry.on = "drum";
  scene.geometry.base_blocks = 8;
  scene.joints.friction = 0.6;
  scene.joints.compliance = Compliance::default_per(Compliance::Per::area);
  scene.analysis.tolerance = 1e-10;
  return scene;
}

Answer solve(const Case& scene) {
  const Assembly assembly = generate(scene);
  Answer answer;
  const Frame last = solve_to_rest(scene, assembly, &answer.summary);
  for (int i = 0; i < last.contacts.size(); ++i)  // a fixed block has the lower number; forces act on block b
    if (assembly.blocks[last.contacts.block_a[i]].fixed)
      answer.reaction[last.contacts.block_a[i]] += last.contacts.force[i].z();
  for (const Block& block : assembly.blocks)
    if (!block.fixed) answer.weight -= block.mass * scene.loads.gravity.z();
  return answer;
}

double sum(const std::map<int, double>& reactions) {
  double total = 0.0;
  for (const auto& [block, force] : reactions) total += force;
  return total;
}

SupportMove settlement(std::vector<BlockRef> blocks) {
  SupportMove move;
  move.region.blocks = std::move(blocks);
  move.displacement = Vec3(0.0, 0.0, -0.005);
  return move;
}

constexpr double kBalance =
    1e-8;  // 100 times the tolerance of the balance of each block, of which 300 are summed

// Three blocks per side, so that a turn by 45 degrees changes nothing.
TEST(VaultOnADrum, RestsEquallyOnItsEightPiers) {
  const Answer answer = solve(vault_on_drum());
  ASSERT_EQ(answer.reaction.size(), 8u);
  for (const auto& [block, force] : answer.reaction) {
    EXPECT_LT(block, 8);
    EXPECT_NEAR(force / (answer.weight / 8), 1.0, kBalance);
  }
}

TEST(VaultOnADrum, DoesNotFeelASettlementOfAllPiers) {
  const Answer at_rest = solve(vault_on_drum());
  Case settled = vault_on_drum();
  settled.supports.moves = {settlement({})};
  const Answer answer = solve(settled);
  for (const auto& [block, force] : answer.reaction)
    EXPECT_NEAR(force / at_rest.reaction.at(block), 1.0, kBalance);
}

// The drum bridges the settled pier, which unloads, and its neighbours take over.
TEST(VaultOnADrum, UnloadsAPierThatSettles) {
  Case settled = vault_on_drum();
  settled.supports.moves = {settlement({0})};
  const Answer answer = solve(settled);
  EXPECT_NEAR(sum(answer.reaction) / answer.weight, 1.0, kBalance);
  const double share = answer.weight / 8;
  const auto reaction = [&](int block) {
    const auto found = answer.reaction.find(block);
    return found == answer.reaction.end() ? 0.0 : found->second;
  };
  EXPECT_LT(reaction(0), 0.5 * share);
  EXPECT_GT(reaction(1) + reaction(7), 2.2 * share);
}

}  // namespace
}  // namespace cupola::drum_test
