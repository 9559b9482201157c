#include "solver/dynamics/joint_laws.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// Of a law with strengths in Pa. Friction leaves no tension beyond cohesion / friction, so that less opening
/// dissipates the energy.
CrackLengths crack_lengths(const JointLaw& law, const FractureEnergy& energy, JointFailure failure) {
  if (failure == JointFailure::brittle) return {0.0, 0.0};
  if (failure == JointFailure::plastic) return {};
  const auto& [tension, cohesion, compression] = law.strength;
  const double pull = law.mu > 0.0 ? std::min(tension, cohesion / law.mu) : tension;
  return {2.0 * energy.tension / pull, 2.0 * energy.shear / cohesion};
}

JointTable::ClassLaw apply_change(JointTable::ClassLaw joint, const JointLawChange& change) {
  JointLaw& law = joint.law;
  law.mu = change.friction.value_or(law.mu);
  law.compliance_normal = change.normal.value_or(law.compliance_normal);
  law.compliance_tangential = change.tangential.value_or(law.compliance_tangential);
  law.strength.tension = change.tension.value_or(law.strength.tension);
  law.strength.cohesion = change.cohesion.value_or(law.strength.cohesion);
  law.strength.compression = change.compressive_strength.value_or(law.strength.compression);
  joint.energy = change.fracture_energy.value_or(joint.energy);
  return joint;
}

const std::optional<JointLawChange>& change_of(const Joints& joints, JointClass kind) {
  static const std::optional<JointLawChange> none;
  switch (kind) {
    case JointClass::bed:
      return joints.bed;
    case JointClass::head:
      return joints.head;
    case JointClass::herringbone_bed:
    case JointClass::herringbone_other:
      return joints.herringbone;
    case JointClass::base:
      return joints.base;
    case JointClass::pieces:
      return joints.pieces;
    case JointClass::wythe:
      return joints.wythe;
    case JointClass::other:
      break;
  }
  return none;
}

/// A joint that gives way only across, or only along, gives way the other way by a ten-thousandth of that.
/// A rigid contact is judged and regularised by the inertia of its blocks, which in the long steps of statics
/// hides errors as large as the displacements of the spring beside it.
void soften_half_rigid(JointLaw* law) {
  constexpr double kShare = 1e-4;
  double &normal = law->compliance_normal, &tangential = law->compliance_tangential;
  if (normal == 0.0)
    normal = kShare * tangential;
  else if (tangential == 0.0)
    tangential = kShare * normal;
}

JointStrength times(const JointStrength& strength, double area) {
  return {area * strength.tension, area * strength.cohesion, area * strength.compression};
}

bool applies_to(RingJoints::Sort group, JointClass kind) {
  switch (group) {
    case RingJoints::Sort::all:
      return true;
    case RingJoints::Sort::bed:
      return kind == JointClass::bed;
    case RingJoints::Sort::head:
      return kind == JointClass::head;
    case RingJoints::Sort::herringbone:
      return kind == JointClass::herringbone_bed || kind == JointClass::herringbone_other;
    case RingJoints::Sort::base:
      return kind == JointClass::base;
    case RingJoints::Sort::wythe:
      return kind == JointClass::wythe;
    case RingJoints::Sort::pieces:
      return kind == JointClass::pieces;
    case RingJoints::Sort::other:
      return kind == JointClass::other;
    case RingJoints::Sort::laid_bed:
      return kind == JointClass::bed || kind == JointClass::herringbone_bed || kind == JointClass::base;
    case RingJoints::Sort::laid_head:
      return kind == JointClass::head || kind == JointClass::herringbone_other;
  }
  return false;
}

bool are_pieces_of_one_block(const std::string& a, const std::string& b) {
  const size_t end = a.rfind('#');
  return end != std::string::npos && end == b.rfind('#') && a.compare(0, end, b, 0, end) == 0;
}

}  // namespace

JointClass joint_class(const Assembly& assembly, const Patch& patch, bool of_pieces) {
  if (patch.kind == JointKind::base) return JointClass::base;
  const bool is_piece =
      are_pieces_of_one_block(assembly.blocks[patch.block_a].name, assembly.blocks[patch.block_b].name);
  if (is_piece && of_pieces) return JointClass::pieces;
  const auto is_herringbone = [&](int block) {
    return assembly.blocks[block].kind == BlockKind::herringbone;
  };
  const bool is_bed = patch.kind == JointKind::bed;
  if (is_herringbone(patch.block_a) || is_herringbone(patch.block_b))
    return is_bed ? JointClass::herringbone_bed : JointClass::herringbone_other;
  if (is_bed) return JointClass::bed;
  if (patch.kind == JointKind::wythe) return JointClass::wythe;
  if (patch.kind == JointKind::head) return JointClass::head;
  return is_piece ? JointClass::pieces : JointClass::other;
}

bool selects(const RingJoints& group, JointClass kind, int ring) {
  return group.from <= ring && ring <= group.to && applies_to(group.sort, kind);
}

bool have_law_of_pieces(const Joints& joints) {
  return joints.pieces ||
         std::ranges::find(joints.rings, RingJoints::Sort::pieces, &RingJoints::sort) != joints.rings.end();
}

JointTable::JointTable(const Joints& joints, int num_rings)
    : has_pieces_(have_law_of_pieces(joints)),
      failure_(joints.failure),
      per_area_(joints.compliance.per == Compliance::Per::area),
      has_strength_(joints.have_strength()) {
  if (const auto& field = joints.field) {
    const auto make = [&field](const char* quantity, double variation) {
      return RandomField(field->seed, quantity, field->correlation_length, variation);
    };
    friction_ = make("friction", field->friction);
    strength_ = make("strength", field->strength);
    compliance_ = make("compliance", field->compliance);
  }
  const ClassLaw general{
      {joints.friction, joints.compliance.normal, joints.compliance.tangential, joints.strength},
      joints.fracture_energy.value_or(FractureEnergy{})};
  for (int k = 0; k < kNumJointClasses; ++k) {
    const auto kind = static_cast<JointClass>(k);
    const auto& change = change_of(joints, kind);
    std::vector<ClassLaw> rings(std::max(1, num_rings), change ? apply_change(general, *change) : general);
    for (const RingJoints& group : joints.rings)
      for (int ring = 0; ring < num_rings; ++ring)
        if (selects(group, kind, ring)) rings[ring] = apply_change(rings[ring], group.law);
    laws_[k] = std::move(rings);
  }
}

void JointTable::set_mortar(std::vector<RingJoints> by_course) {
  Joints fresh;
  fresh.rings = by_course;
  has_strength_ = has_strength_ || fresh.have_strength();
  mortar_ = std::move(by_course);
}

JointLaw JointTable::law(const Assembly& assembly, const Patch& patch, double area, int multiplicity,
                         double closed_share) const {
  const JointClass kind = joint_class(assembly, patch, has_pieces_);
  const std::vector<ClassLaw>& rings = laws_[static_cast<int>(kind)];
  CUPOLA_ASSERT(!rings.empty() && multiplicity >= 1);
  ClassLaw of_class = rings[std::clamp(patch.ring, 0, static_cast<int>(rings.size()) - 1)];
  for (const RingJoints& group : mortar_)
    if (selects(group, kind, patch.course)) of_class = apply_change(of_class, group.law);
  JointLaw law = of_class.law;
  soften_half_rigid(&law);
  CUPOLA_ASSERT(!per_area_ || area > 0.0);
  const double share = per_area_ ? area : multiplicity;
  law.compliance_normal /= share;
  law.compliance_tangential /= share;
  if (!friction_.is_constant()) law.mu *= friction_.mean_over(patch.polygon);
  if (!compliance_.is_constant()) {
    const double factor = compliance_.mean_over(patch.polygon);
    law.compliance_normal *= factor;
    law.compliance_tangential *= factor;
  }
  if (!strength_.is_constant()) law.strength = times(law.strength, strength_.mean_over(patch.polygon));
  law.crack = crack_lengths(law, of_class.energy, failure_);
  const double bearing = patch.area > 0.0 ? closed_share * area : 0.0;
  if (has_strength_) law.strength = bearing > 0.0 ? times(law.strength, bearing) : JointStrength{};
  return law;
}

}  // namespace cupola
