#include "solver/dynamics/joint_laws.hpp"

#include <algorithm>

namespace cupola {
namespace {

using Sort = RingJoints::Sort;

JointLaw changed(JointLaw law, const JointLawChange& change) {
  law.mu = change.friction.value_or(law.mu);
  law.compliance_normal = change.normal.value_or(law.compliance_normal);
  law.compliance_tangential = change.tangential.value_or(law.compliance_tangential);
  return law;
}

const std::optional<JointLawChange>& change_of(const Joints& joints, Sort sort) {
  static const std::optional<JointLawChange> none;
  switch (sort) {
    case Sort::bed:
      return joints.bed;
    case Sort::head:
      return joints.head;
    case Sort::herringbone:
      return joints.herringbone;
    case Sort::base:
      return joints.base;
    case Sort::all:
      break;
  }
  return none;
}

}  // namespace

RingJoints::Sort joint_sort(const Assembly& assembly, const Patch& patch) {
  if (patch.kind == JointKind::base) return Sort::base;
  const auto is_herringbone = [&](int block) {
    return assembly.blocks[block].kind == BlockKind::herringbone;
  };
  if (is_herringbone(patch.block_a) || is_herringbone(patch.block_b)) return Sort::herringbone;
  if (patch.kind == JointKind::bed) return Sort::bed;
  if (patch.kind == JointKind::head) return Sort::head;
  return Sort::all;
}

JointTable::JointTable(const Joints& joints, int num_rings)
    : per_area_(joints.compliance.per == Compliance::Per::area) {
  const JointLaw general{joints.friction, joints.compliance.normal, joints.compliance.tangential};
  for (int sort = 0; sort < kSorts; ++sort) {
    const auto& change = change_of(joints, static_cast<Sort>(sort));
    laws_[sort].assign(std::max(1, num_rings), change ? changed(general, *change) : general);
    for (const RingJoints& group : joints.rings) {
      if (group.sort != Sort::all && group.sort != static_cast<Sort>(sort)) continue;
      for (int ring = std::max(0, group.from); ring <= std::min(group.to, num_rings - 1); ++ring)
        laws_[sort][ring] = changed(laws_[sort][ring], group.law);
    }
  }
}

JointLaw JointTable::law(const Assembly& assembly, const Patch& patch, double area) const {
  const std::vector<JointLaw>& rings = laws_[static_cast<int>(joint_sort(assembly, patch))];
  JointLaw law = rings[std::clamp(patch.ring, 0, static_cast<int>(rings.size()) - 1)];
  if (per_area_) {
    law.compliance_normal /= area;
    law.compliance_tangential /= area;
  }
  return law;
}

double JointTable::largest_normal_compliance() const {
  double largest = 0.0;
  for (const auto& rings : laws_)
    for (const JointLaw& law : rings) largest = std::max(largest, law.compliance_normal);
  return largest;
}

}  // namespace cupola
