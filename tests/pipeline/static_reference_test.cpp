#include <map>

#include <gtest/gtest.h>

#include "generators/generate.hpp"
#include "solver/analysis/analysis.hpp"

namespace cupola::static_reference_test {
namespace {

struct Answer {
  Assembly assembly;
  Frame frame;
  Summary summary;
};

Answer solve(const Case& scene) {
  Answer answer{generate(scene), {}, {}};
  answer.summary = run_static(scene, answer.assembly,
                              {[&answer](const Frame& frame) { answer.frame = frame; },
                               [](const std::string&) {}, [](const std::string&) {}});
  return answer;
}

// Wall of 12 x 6 x 1 m, 1800 kg/m3, top load of ten weights. The settlement is a row of the verification
// manual.
TEST(Wall, CarriesItsLoadsInBedsOnly) {
  Case scene;
  scene.geometry.surface = WallSurface{12.0, 6.0, 1.0};
  scene.geometry.bond = RunningBond{.rings = 20, .blocks_per_ring = 10, .slices_per_block = 2};
  scene.material.unit_weight = 1800.0 * 9.81;
  scene.loads.top_load = TopLoad{10.0};
  const Answer answer = solve(scene);
  const double weight = 1271376.0;
  EXPECT_EQ(answer.summary.status, Status::stable) << answer.summary.message;
  EXPECT_EQ(answer.summary.free_blocks, 210);
  EXPECT_NEAR(answer.summary.weight_N / weight, 1.0, 1e-12);
  EXPECT_NEAR(answer.summary.support_reaction_N.z() / (11.0 * weight), 1.0, 1e-9);
  for (int i = 0; i < answer.frame.contacts.size(); ++i) {
    if (answer.frame.contacts.kind[i] != JointKind::head) continue;
    EXPECT_LT(answer.frame.contacts.force[i].norm(), 1e-6 * weight);
  }
}

TEST(DomeCircular, IsSymmetricAndCarriesTheWeightAboveInEveryRing) {
  const Answer answer = solve(Case{});  // 40 x 32 blocks, mu 0.4, 1e-8 m/N per point
  const Summary& summary = answer.summary;
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  EXPECT_EQ(summary.free_blocks, 1280);
  EXPECT_LE(summary.equilibrium_residual.value(), 1e-8);
  EXPECT_LE(summary.contact_law_residual.value(), 1e-8);
  EXPECT_LE(summary.friction_cone_violation, 1e-12);

  const std::vector<Block>& blocks = answer.assembly.blocks;
  const ContactTable& contacts = answer.frame.contacts;
  std::vector<double> weight_above(40, 0.0), carried(40, 0.0);
  std::map<int, Vec3> base;  // force on each block of the first ring
  for (const Block& block : blocks)
    for (int ring = 0; ring <= block.ring; ++ring) weight_above[ring] += 9.81 * block.mass;
  for (int i = 0; i < contacts.size(); ++i) {
    const int lower = blocks[contacts.block_a[i]].ring, upper = blocks[contacts.block_b[i]].ring;
    if (lower < upper) carried[upper] += contacts.force[i].z();
    if (lower > upper) carried[lower] -= contacts.force[i].z();
    if (contacts.kind[i] != JointKind::base) continue;
    const bool below_is_a = blocks[contacts.block_a[i]].fixed;
    const int block = below_is_a ? contacts.block_b[i] : contacts.block_a[i];
    base.try_emplace(block, Vec3::Zero()).first->second += (below_is_a ? 1.0 : -1.0) * contacts.force[i];
  }
  for (int ring = 0; ring < 40; ++ring)
    EXPECT_NEAR(carried[ring] / weight_above[ring], 1.0, 1e-7) << "ring " << ring;

  ASSERT_EQ(base.size(), 32u);
  const double mean = base.begin()->second.norm();
  for (const auto& [block, force] : base) EXPECT_NEAR(force.norm() / mean, 1.0, 1e-8) << "block " << block;
}

}  // namespace
}  // namespace cupola::static_reference_test
