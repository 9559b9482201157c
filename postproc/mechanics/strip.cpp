#include "postproc/mechanics/strip.hpp"

#include <algorithm>
#include <numbers>

namespace cupola {
namespace {

/// Share of a block's width that lies in the strip.
double overlap(const BlockBed& block, double center, double width) {
  const double middle = 0.5 * (block.from + block.to);
  const double offset = wrapped(center - middle);
  const double half = 0.5 * (block.to - block.from);
  const double common = std::min(half, offset + width / 2) - std::max(-half, offset - width / 2);
  return common > kCornerRounding * 2.0 * half ? common / (2.0 * half) : 0.0;
}

/// True where a block or joint lies on all sides of the axis.
bool goes_round(const BlockBed& block) {
  return block.to - block.from > (1.0 + kCornerRounding) * std::numbers::pi;
}

/// A block on a bed with the range of azimuths, as built, of one of its joints.
BlockBed within(const ThrustInput& in, const Route& route, BlockBed block, const JointWrench& joint) {
  const auto azimuth_of = [&](const Vec3& at) {
    return azimuth(route.axis.own(in.poses.as_built(block.block, at)));
  };
  const double middle = azimuth_of(joint.patch.centroid);
  block.from = block.to = middle;
  for (int i = joint.contact_start; i < joint.contact_start + joint.num_contacts; ++i) {
    const double angle = middle + wrapped(azimuth_of(in.contacts->point[in.joints->contacts[i]]) - middle);
    block.from = std::min(block.from, angle);
    block.to = std::max(block.to, angle);
  }
  return block;
}

}  // namespace

bool stands_on(const ThrustInput& in, int block, int bed) {
  return in.shell->closes(bed) || in.assembly->blocks[block].ring == bed;
}

std::vector<const JointWrench*> joints_on(const ThrustInput& in, int block, int bed) {
  const bool over = in.shell->closes(bed);
  std::vector<const JointWrench*> joints;
  for (const int i : in.joints->of_block[block]) {
    const JointWrench& joint = in.joints->wrenches[i];
    if ((over ? joint.lower : joint.carried) == block) joints.push_back(&joint);
  }
  return joints;
}

std::vector<Strand> strands_on(const ThrustInput& in, int bed, const Route& route) {
  std::vector<Strand> strands;
  for (const BlockBed& block : in.shell->blocks[bed]) {
    const bool by_joint = route.meridian && goes_round(block) && stands_on(in, block.block, bed);
    const double share = route.meridian && !by_joint ? overlap(block, *route.meridian, route.width) : 1.0;
    if (share <= 0.0) continue;
    std::vector<const JointWrench*> joints = joints_on(in, block.block, bed);
    if (route.wythe)
      std::erase_if(joints, [&](const JointWrench* joint) {
        return !wythes_of(*in.assembly, *in.shell, *joint).contains(*route.wythe);
      });
    if (!by_joint) {
      strands.push_back({block, false, share, std::move(joints)});
      continue;
    }
    for (const JointWrench* joint : joints) {
      BlockBed part = within(in, route, block, *joint);
      const double of_part = goes_round(part) ? 0.0 : overlap(part, *route.meridian, route.width);
      if (of_part > 0.0) strands.push_back({std::move(part), true, of_part, {joint}});
    }
  }
  return strands;
}

}  // namespace cupola
