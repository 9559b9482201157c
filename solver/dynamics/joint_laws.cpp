#include "solver/dynamics/joint_laws.hpp"

#include <algorithm>

namespace cupola {
namespace {

JointLaw changed(JointLaw law, const JointLawChange& change) {
  law.mu = change.friction.value_or(law.mu);
  law.compliance_normal = change.normal.value_or(law.compliance_normal);
  law.compliance_tangential = change.tangential.value_or(law.compliance_tangential);
  return law;
}

const std::optional<JointLawChange>& change_of(const Joints& joints, JointSort sort) {
  static const std::optional<JointLawChange> none;
  switch (sort) {
    case JointSort::bed:
      return joints.bed;
    case JointSort::head:
      return joints.head;
    case JointSort::herringbone_bed:
    case JointSort::herringbone_other:
      return joints.herringbone;
    case JointSort::base:
      return joints.base;
    case JointSort::other:
      break;
  }
  return none;
}

bool is_meant(RingJoints::Sort group, JointSort sort) {
  switch (group) {
    case RingJoints::Sort::all:
      return true;
    case RingJoints::Sort::bed:
      return sort == JointSort::bed;
    case RingJoints::Sort::head:
      return sort == JointSort::head;
    case RingJoints::Sort::herringbone:
      return sort == JointSort::herringbone_bed || sort == JointSort::herringbone_other;
    case RingJoints::Sort::base:
      return sort == JointSort::base;
    case RingJoints::Sort::laid_bed:
      return sort == JointSort::bed || sort == JointSort::herringbone_bed || sort == JointSort::base;
  }
  return false;
}

}  // namespace

JointSort joint_sort(const Assembly& assembly, const Patch& patch) {
  if (patch.kind == JointKind::base) return JointSort::base;
  const auto is_herringbone = [&](int block) {
    return assembly.blocks[block].kind == BlockKind::herringbone;
  };
  const bool is_bed = patch.kind == JointKind::bed;
  if (is_herringbone(patch.block_a) || is_herringbone(patch.block_b))
    return is_bed ? JointSort::herringbone_bed : JointSort::herringbone_other;
  if (is_bed) return JointSort::bed;
  return patch.kind == JointKind::head ? JointSort::head : JointSort::other;
}

JointTable::JointTable(const Joints& joints, int num_rings)
    : per_area_(joints.compliance.per == Compliance::Per::area) {
  const JointLaw general{joints.friction, joints.compliance.normal, joints.compliance.tangential};
  for (int s = 0; s < kJointSorts; ++s) {
    const auto sort = static_cast<JointSort>(s);
    const auto& change = change_of(joints, sort);
    laws_[s].assign(std::max(1, num_rings), change ? changed(general, *change) : general);
    for (const RingJoints& group : joints.rings) {
      if (!is_meant(group.sort, sort)) continue;
      for (int ring = std::max(0, group.from); ring <= std::min(group.to, num_rings - 1); ++ring)
        laws_[s][ring] = changed(laws_[s][ring], group.law);
    }
  }
}

JointLaw JointTable::law(const Assembly& assembly, const Patch& patch, double area, int points) const {
  const std::vector<JointLaw>& rings = laws_[static_cast<int>(joint_sort(assembly, patch))];
  JointLaw law = rings[std::clamp(patch.ring, 0, static_cast<int>(rings.size()) - 1)];
  const double share = per_area_ ? area : points;
  law.compliance_normal /= share;
  law.compliance_tangential /= share;
  return law;
}

}  // namespace cupola
