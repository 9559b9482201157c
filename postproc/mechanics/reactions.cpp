#include "postproc/mechanics/reactions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "assembly/base/disjoint_sets.hpp"
#include "assembly/model/thrust_joint.hpp"
#include "postproc/mechanics/chain_forces.hpp"
#include "postproc/mechanics/ring_sums.hpp"

namespace cupola {

namespace {

Vec3 middle_of(const BedFacet& f) {
  return 0.25 * (f.intrados_a + f.intrados_b + f.extrados_a + f.extrados_b);
}

/// Share of the thickness of the whole shell that a facet and those of a bed cover where its middle is: less
/// than 1 beside a cavity.
double share_covered(const std::vector<BedFacet>& bed, const BedFacet& at) {
  const Vec3 middle = middle_of(at);
  const Vec3 along = at.intrados_b + at.extrados_b - at.intrados_a - at.extrados_a;
  const Vec3 through = 0.5 * (at.extrados_a + at.extrados_b - at.intrados_a - at.intrados_b);
  const double farthest = through.squaredNorm() / (at.to - at.from);  // beyond the shell
  std::vector<std::pair<double, double>> beside{{at.from, at.to}};
  for (const BedFacet& f : bed) {
    const double a = along.dot(0.5 * (f.intrados_a + f.extrados_a) - middle);
    const double b = along.dot(0.5 * (f.intrados_b + f.extrados_b) - middle);
    if (a * b <= 0.0 && std::abs(through.dot(middle_of(f) - middle)) < farthest)
      beside.emplace_back(f.from, f.to);
  }
  std::ranges::sort(beside);
  double covered = 0.0, end = 0.0;
  for (const auto& [from, to] : beside) {
    covered += std::max(0.0, to - std::max(from, end));
    end = std::max(end, to);
  }
  return covered;
}

}  // namespace

double support_length(const JointWrench& joint, const Assembly& assembly, int carried, const Shell& shell) {
  const Block& block = assembly.blocks[carried];
  double length = std::numeric_limits<double>::quiet_NaN(), least = std::numeric_limits<double>::infinity();
  for (const int bed : {block.ring, shell.bed_above(block.ring + block.num_rings - 1)}) {
    if (bed < 0 || bed >= static_cast<int>(shell.beds.size())) continue;
    const BedFacet* nearest = nullptr;
    for (const BedFacet& f : shell.beds[bed]) {
      const double distance = (middle_of(f) - joint.centroid).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      nearest = &f;
    }
    if (!nearest) continue;
    const BedFacet& f = *nearest;
    const double area = polygon_area(std::array{f.intrados_a, f.intrados_b, f.extrados_b, f.extrados_a});
    const double edges = 0.5 * ((f.intrados_b - f.intrados_a).norm() + (f.extrados_b - f.extrados_a).norm());
    length = joint.area * (f.to - f.from) / share_covered(shell.beds[bed], f) * edges / area;
  }
  return length;
}

std::vector<Reaction> support_reactions(const Assembly& assembly, const JointWrenches& joints,
                                        const Shell& shell, const TieTable& ties, int num_ties) {
  const ThrustJoints thrust(assembly);
  std::map<int, Reaction> found;
  for (const JointWrench& joint : joints.wrenches) {
    const bool a_fixed = assembly.blocks[joint.block_a].fixed;
    if (a_fixed == assembly.blocks[joint.block_b].fixed) continue;
    const int support = a_fixed ? joint.block_a : joint.block_b;
    const int carried = a_fixed ? joint.block_b : joint.block_a;
    const Vec3 force = wrench_on(joint, support).force;
    const int ring = ring_above_support(assembly.blocks[carried]);
    Reaction& reaction = found.try_emplace(support, Reaction{support, ring}).first->second;
    reaction.ring = std::min(reaction.ring, ring);
    reaction.force += force;
    reaction.outward += force.dot(thrust.outward(ring, joint.centroid));
    reaction.length += support_length(joint, assembly, carried, shell);
  }
  for (int i = 0; i < num_ties; ++i) {
    const int a = ties.block_a[i], b = ties.block_b[i];
    const bool a_fixed = assembly.blocks[a].fixed;
    if (a_fixed == assembly.blocks[b].fixed) continue;
    const int support = a_fixed ? a : b, ring = ring_above_support(assembly.blocks[a_fixed ? b : a]);
    Reaction& reaction = found.try_emplace(support, Reaction{support, ring}).first->second;
    reaction.force += a_fixed ? Vec3(-tie_force_on_b(ties, i)) : tie_force_on_b(ties, i);
  }
  std::vector<Reaction> reactions;
  for (auto& [block, reaction] : found) {
    reaction.outward = above(reaction.outward, joints.floor.force);
    reactions.push_back(reaction);
  }
  return reactions;
}

std::vector<int> connected_parts(const Assembly& assembly, const JointWrenches& joints,
                                 const TieTable& ties) {
  const int num_blocks = static_cast<int>(assembly.blocks.size());
  DisjointSets connected(assembly.blocks.size());
  const auto fixed = [&assembly](int b) { return assembly.blocks[b].fixed; };
  const auto join = [&](int a, int b) {
    if (!fixed(a) && !fixed(b)) connected.join(a, b);
  };
  for (const JointWrench& joint : joints.wrenches)
    if (joint.touches) join(joint.block_a, joint.block_b);
  for (int i = 0; i < ties.size(); ++i) join(ties.block_a[i], ties.block_b[i]);
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
