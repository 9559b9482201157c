#include "postproc/mechanics/member_sums.hpp"

#include <algorithm>
#include <cmath>

#include "postproc/mechanics/ring_sums.hpp"
#include "postproc/mechanics/stage_blocks.hpp"

namespace cupola {

std::vector<MemberSum> member_sums(const Assembly& assembly, const JointWrenches& joints, const Vec3& gravity,
                                   const std::vector<bool>& left_out) {
  const size_t M = assembly.members.size();
  if (M == 0) return {};
  const double g = gravity.norm();
  int num_rings = 0;
  for (const Block& block : assembly.blocks) num_rings = std::max(num_rings, ring_above_support(block) + 1);
  std::vector<MemberSum> sums(M * static_cast<size_t>(num_rings));
  const auto at = [&](int ring, int member) -> MemberSum& {
    return sums[static_cast<size_t>(ring) * M + static_cast<size_t>(member)];
  };
  for (size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Block& block = assembly.blocks[i];
    if (!takes_part(assembly, static_cast<int>(i), left_out)) continue;
    MemberSum& sum = at(block.ring, block.member);
    ++sum.blocks;
    sum.weight += block.mass * g;
  }
  for (const JointWrench& joint : joints.wrenches) {
    const int ring_a = ring_above_support(assembly, joint.block_a, left_out);
    const int ring_b = ring_above_support(assembly, joint.block_b, left_out);
    if (ring_a == ring_b) continue;
    const int upper = ring_a > ring_b ? joint.block_a : joint.block_b;
    const Vec3 force = wrench_on(joint, upper).force;
    const int top = std::max(ring_a, ring_b), base = assembly.stack_of(top).first;
    for (int k = std::max(std::min(ring_a, ring_b) + 1, base); k <= top; ++k) {
      MemberSum& sum = at(k, assembly.blocks[upper].member);
      sum.vertical_force += force.z();
      sum.outward_force -= force.dot(assembly.outward(k, joint.centroid));
    }
  }
  for (int k = 0; k < num_rings; ++k) {
    double total = 0.0;
    for (int m = 0; m < static_cast<int>(M); ++m) total += at(k, m).vertical_force;
    for (int m = 0; m < static_cast<int>(M); ++m) {
      MemberSum& sum = at(k, m);
      sum.ring = k;
      sum.member = m;
      if (std::abs(total) > joints.floor.force) sum.share = sum.vertical_force / total;
    }
  }
  std::erase_if(sums, [](const MemberSum& sum) { return sum.blocks == 0 && sum.vertical_force == 0.0; });
  return sums;
}

}  // namespace cupola
