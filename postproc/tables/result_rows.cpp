#include <fmt/format.h>

#include "postproc/mechanics/stage_blocks.hpp"
#include "postproc/tables/result_columns.hpp"

namespace cupola {
namespace {

/// Per block, 1 for a block laid flat that has a head joint with a herringbone block.
std::vector<int> beside_spiral(const Assembly& assembly, const JointWrenches& joints) {
  std::vector<int> beside(assembly.blocks.size(), 0);
  const auto upright = [&](int b) { return assembly.blocks[b].kind == BlockKind::herringbone; };
  for (const JointWrench& joint : joints.wrenches) {
    if (joint.kind != JointKind::head) continue;
    const int a = joint.block_a, b = joint.block_b;
    if (upright(b) && !upright(a)) beside[a] = 1;
    if (upright(a) && !upright(b)) beside[b] = 1;
  }
  return beside;
}

}  // namespace

std::vector<BlockRow> block_rows(const Evaluation& e, const FrameEvaluation& frame) {
  const double g = e.scene.loads.gravity.norm();
  const std::vector<int> beside = beside_spiral(e.assembly, frame.joints);
  const bool mechanism = is_mechanism(frame.frame.role);  // drawn with an amplitude that it does not have
  std::vector<bool> laid(e.assembly.blocks.size(), true);
  if (is_stage(frame.frame.role)) laid = laid_blocks(e.assembly, frame.frame);
  std::vector<BlockRow> rows;
  rows.reserve(e.assembly.blocks.size());
  for (size_t b = 0; b < e.assembly.blocks.size(); ++b) {
    const Block& block = e.assembly.blocks[b];
    rows.push_back({.block = block,
                    .fields = frame.fields[b],
                    .from_below = frame.from_below[b],
                    .axis = central_axis(frame.from_below[b]),
                    .displacement = mechanism ? Vec3::Zero() : frame.frame.blocks.displacement[b],
                    .weight = block.mass * g,
                    .index = static_cast<int>(b),
                    .ring = block.ring,
                    .beside_spiral = beside[b],
                    .mechanism_group = frame.groups[b],
                    .laid = laid[b]});
  }
  return rows;
}

std::vector<MemberRow> member_rows(const Evaluation& e) {
  std::vector<MemberRow> rows;
  for (const MemberSum& sum : e.members)
    rows.push_back({sum, e.assembly.members[sum.member], e.rings[sum.ring].height});
  return rows;
}

std::vector<WytheRow> wythe_rows(const Evaluation& e) {
  std::vector<WytheRow> rows;
  const std::vector<std::string>& names = e.assembly.members;
  for (const WytheSum& sum : e.wythes) {
    const std::string &first = names[sum.wythes.from], &last = names[sum.wythes.to - 1];
    rows.push_back({sum, sum.wythes.count() > 1 ? fmt::format("{} to {}", first, last) : first,
                    e.rings[sum.ring].height});
  }
  return rows;
}

std::vector<PlaneJoint> plane_joints(const Evaluation& e, const PlaneCut& cut) {
  std::vector<PlaneJoint> rows;
  for (const int j : cut.joints) {
    const JointWrench& joint = e.last.joints.wrenches[j];
    const Vec3 force = force_beyond(cut, e.assembly, joint);
    const double through = force.dot(cut.normal);
    rows.push_back({joint, force, through, (force - through * cut.normal).norm()});
  }
  return rows;
}

std::vector<CrackRow> crack_rows(const Evaluation& e) {
  std::vector<CrackRow> rows;
  for (const ShellCrack& crack : e.cracks) rows.push_back({crack, static_cast<int>(rows.size())});
  return rows;
}

std::vector<TieRow> tie_rows(const Evaluation& e) {
  std::vector<TieRow> rows;
  const TieTable& ties = e.last.frame.ties;
  for (int i = 0; i < ties.size(); ++i)
    rows.push_back({ties, i, ties.chain[i] < 0 ? "" : e.assembly.chains.at(ties.chain[i]).name});
  return rows;
}

}  // namespace cupola
