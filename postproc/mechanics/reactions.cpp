#include "postproc/mechanics/reactions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "assembly/base/disjoint_sets.hpp"
#include "postproc/mechanics/ring_sums.hpp"

namespace cupola {

namespace {

/// m: area over the thickness of the shell along the joint, which leans by the angle between its line through
/// the thickness and the normal of the shell.
double length_of(const PlanarHull& joint, const ShellAxes& shell) {
  if (!shell.exists || !(shell.thickness > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  const Vec3 through = shell.t.cross(joint.plane.normal).normalized();
  return joint.area * std::abs(through.dot(shell.n)) / shell.thickness;
}

}  // namespace

std::vector<Reaction> support_reactions(const Assembly& assembly, const JointWrenches& joints,
                                        const std::vector<ShellAxes>& axes) {
  std::map<int, Reaction> found;
  for (const JointWrench& joint : joints.wrenches) {
    const bool a_fixed = assembly.blocks[joint.block_a].fixed;
    if (a_fixed == assembly.blocks[joint.block_b].fixed) continue;
    const int support = a_fixed ? joint.block_a : joint.block_b;
    const int carried = a_fixed ? joint.block_b : joint.block_a;
    const ShellAxes& shell = axes[carried];
    const Vec3 force = wrench_on(joint, support).force;
    const int ring = ring_above_support(assembly.blocks[carried]);
    const bool is_new = !found.contains(support);
    Reaction& reaction = found[support];
    reaction.block = support;
    reaction.ring = is_new ? ring : std::min(reaction.ring, ring);
    reaction.force += force;
    reaction.outward += force.dot(assembly.outward(ring, joint.centroid));
    reaction.length += length_of(joint.patch, shell);
  }
  std::vector<Reaction> reactions;
  for (const auto& [block, reaction] : found) reactions.push_back(reaction);
  return reactions;
}

std::vector<int> connected_parts(const Assembly& assembly, const JointWrenches& joints) {
  const int num_blocks = static_cast<int>(assembly.blocks.size());
  DisjointSets connected(assembly.blocks.size());
  const auto fixed = [&assembly](int b) { return assembly.blocks[b].fixed; };
  for (const JointWrench& joint : joints.wrenches)
    if (!fixed(joint.block_a) && !fixed(joint.block_b)) connected.join(joint.block_a, joint.block_b);
  std::map<int, int> sizes;
  for (int b = 0; b < num_blocks; ++b)
    if (!fixed(b)) ++sizes[connected.root(b)];
  std::vector<int> order;  // roots, the largest part first, then by number
  for (const auto& [first, size] : sizes) order.push_back(first);
  std::stable_sort(order.begin(), order.end(), [&sizes](int a, int b) { return sizes[a] > sizes[b]; });
  std::map<int, int> number;
  for (size_t i = 0; i < order.size(); ++i) number[order[i]] = static_cast<int>(i);
  std::vector<int> parts(num_blocks, -1);
  for (int b = 0; b < num_blocks; ++b)
    if (!fixed(b)) parts[b] = number[connected.root(b)];
  return parts;
}

}  // namespace cupola
