#include "postproc/mechanics/wythe_sums.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "postproc/mechanics/bed_blocks.hpp"
#include "postproc/mechanics/ring_sums.hpp"

namespace cupola {
namespace {

/// A sum and what its means are computed from.
struct Collected {
  WytheSum sum;
  double bed_force = 0.0;         // N, normal forces of its bed joints
  Bearing bearing;                // of those that are not negligible
  std::vector<double> pressures;  // Pa
};

using Sums = std::map<std::pair<int, WytheRange>, Collected>;  // by ring and wythes

/// Adds a joint to the cuts below all rings of the upper stack that it crosses.
void add_forces(const Assembly& assembly, const JointWrench& joint, const WytheRange& wythes, Sums* sums) {
  const int a = ring_above_support(assembly.blocks[joint.block_a]);
  const int b = ring_above_support(assembly.blocks[joint.block_b]);
  if (a == b) return;
  const Vec3 force = wrench_on(joint, a > b ? joint.block_a : joint.block_b).force;
  const int top = std::max(a, b);
  for (int k = std::max(std::min(a, b) + 1, assembly.stack_of(top).first); k <= top; ++k) {
    WytheSum& sum = (*sums)[{k, wythes}].sum;
    sum.vertical_force += force.z();
    sum.outward_force -= force.dot(assembly.outward(k, joint.centroid));
  }
}

/// Adds what a bed joint tells about the ring of its upper block.
void add_bed(const JointWrench& joint, Collected* at) {
  ++at->sum.joints;
  at->sum.area += joint.area;
  at->bed_force += joint.normal_force;
  at->sum.largest_friction_use = std::fmax(at->sum.largest_friction_use, joint.friction_use);  // skips NaN
  at->sum.largest_kern = std::fmax(at->sum.largest_kern, joint.kern);
  if (joint.area > 0.0) at->pressures.push_back(joint.negligible ? 0.0 : joint.normal_force / joint.area);
}

/// The sum with its means.
WytheSum finished(const Collected& at, const Shell& shell, double total, const Floor& floor) {
  WytheSum sum = at.sum;
  sum.share = std::abs(total) > floor.force ? sum.vertical_force / total : 0.0;
  const std::optional<Layers> layers = layers_of(shell, sum.ring, sum.wythes);
  sum.position = layers && at.bearing.normal_force > floor.force ? layers->position(at.bearing.share())
                                                                 : std::numeric_limits<double>::quiet_NaN();
  sum.pressure = sum.area > 0.0 ? at.bed_force / sum.area : 0.0;
  sum.cv_pressure = above(coefficient_of_variation(at.pressures), floor.share);
  return sum;
}

}  // namespace

std::vector<WytheSum> wythe_sums(const Assembly& assembly, const Shell& shell, const JointWrenches& joints,
                                 const ContactTable& contacts, const Poses& poses) {
  std::vector<WytheSum> out;
  if (assembly.members.empty() || shell.num_rings() == 0) return out;
  Sums sums;
  for (const JointWrench& joint : joints.wrenches) {
    const WytheRange wythes = wythes_of(assembly, shell, joint);
    add_forces(assembly, joint, wythes, &sums);
    const int carried = joint.carried;
    if (carried < 0 || assembly.blocks[carried].fixed) continue;
    const int ring = ring_above_support(assembly.blocks[carried]);
    Collected& at = sums[{ring, wythes}];
    add_bed(joint, &at);
    const std::vector<BlockBed>& blocks = shell.blocks[ring];
    const auto block = std::ranges::lower_bound(blocks, carried, {}, &BlockBed::block);
    if (!joint.negligible && block != blocks.end() && block->block == carried)
      add_bearing(joint, joints, contacts, shell.beds[ring], *block, poses, &at.bearing);
  }
  std::map<int, double> totals;  // N, by ring
  for (auto& [key, at] : sums) {
    std::tie(at.sum.ring, at.sum.wythes) = key;
    totals[key.first] += at.sum.vertical_force;
  }
  for (const auto& [key, at] : sums) out.push_back(finished(at, shell, totals[key.first], joints.floor));
  return out;
}

}  // namespace cupola
