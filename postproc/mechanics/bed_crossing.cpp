#include "postproc/mechanics/bed_crossing.hpp"

#include <vector>

#include "postproc/mechanics/block_pieces.hpp"

namespace cupola {
namespace {

/// Course of the piece of a block on which a contact point lies.
int ring_at(const ThrustInput& in, int block, int row) {
  return ring_of_piece(*in.assembly, block, in.poses.as_built(block, in.contacts->point[row]),
                       in.contacts->ring[row]);
}

/// The beds of a section in the stack of a course: none, one, or those of the two flights of an arch.
std::vector<int> beds_of_stack(const ThrustInput& in, std::span<const int> beds, int ring) {
  const auto stack = in.assembly->stack_of(ring);
  std::vector<int> own;
  for (const int bed : beds)
    if (const int on = in.shell->number_of(bed);
        in.assembly->stack_of(in.shell->closes(bed) ? on - 1 : on) == stack)
      own.push_back(on);
  return own;
}

/// True if the piece of a block at a contact point lies above the beds of its stack; down the second flight
/// of an arch what follows lies below.
bool is_above(const ThrustInput& in, const std::vector<int>& beds, int block, int row) {
  const int ring = ring_at(in, block, row);
  return ring >= beds.front() && (beds.size() == 1 || ring < beds.back());
}

/// True if the force at a contact point of a joint acts on a block from below a bed of the section.
bool crosses(const ThrustInput& in, const JointWrench& joint, int block, int row, int bed,
             std::span<const int> section) {
  const int other = joint.block_a == block ? joint.block_b : joint.block_a;
  const Block &upper = in.assembly->blocks[block], &lower = in.assembly->blocks[other];
  const auto [first, end] = in.assembly->stack_of(upper.ring);
  if (!lower.fixed && lower.ring >= first && lower.ring < end)
    return lower.ring < bed && ring_at(in, other, row) < bed && ring_at(in, block, row) >= bed;
  if (!lower.fixed)
    if (const auto others = beds_of_stack(in, section, lower.ring); !others.empty()) {
      const auto own = beds_of_stack(in, section, upper.ring);
      return bed == own.front() && is_above(in, own, block, row) && !is_above(in, others, other, row);
    }
  const bool runs_through = upper.ring < bed && is_divided(*in.assembly, block);
  return joint.carried == block && upper.ring <= bed && !runs_through;
}

}  // namespace

std::map<int, Wrench> wrenches_across(const ThrustInput& in, int bed, std::span<const int> section) {
  const bool closing = in.shell->closes(bed);
  const auto [first, end] = in.assembly->stack_of(closing ? in.shell->number_of(bed) - 1 : bed);
  std::map<int, Wrench> wrenches;
  for (int b = 0; b < static_cast<int>(in.assembly->blocks.size()); ++b) {
    const Block& block = in.assembly->blocks[b];
    const int last = block.ring + block.num_rings - 1;
    if (block.fixed || block.ring < first || block.ring >= end) continue;
    if (closing) {
      if (last + 1 == in.shell->number_of(bed)) wrenches[b] = wrench_at_bed(in, b, bed);
      continue;
    }
    if (last < bed) continue;
    Wrench& w = wrenches[b];
    w.point = in.assembly->blocks[b].centroid;
    if (block.ring < bed && is_divided(*in.assembly, b)) w = wrench_at_bed(in, b, bed);
    for (const int j : in.joints->of_block[b]) {
      const JointWrench& joint = in.joints->wrenches[j];
      const double sign = joint.block_b == b ? 1.0 : -1.0;
      for (int i = joint.contact_start; i < joint.contact_start + joint.num_contacts; ++i) {
        const int row = in.joints->contacts[i];
        if (crosses(in, joint, b, row, bed, section))
          w.add_force(in.contacts->point[row], sign * in.contacts->force[row]);
      }
    }
  }
  return wrenches;
}

}  // namespace cupola
