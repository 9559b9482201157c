#include "solver/analysis/record/record.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "assembly/base/error.hpp"
#include "solver/dynamics/joint_damage.hpp"
#include "solver/dynamics/law_violation.hpp"

namespace cupola {
namespace {

constexpr double kSlipping = 1.0 - 1e-6;  // friction use from which a contact counts as slipping

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// True if there is tension or cohesion to lose.
bool bonds(const JointLaw& law) {
  return law.strength.tension > 0.0 || law.strength.cohesion > 0.0;
}

/// Share of the compressive strength that a push uses, or of the tensile strength that a pull uses, which
/// friction ends at cohesion / mu.
double strength_use(const JointStrength& strength, double mu, double normal_force) {
  if (normal_force >= 0.0) return normal_force / strength.compression;
  const double tension = mu > 0.0 ? std::min(strength.tension, strength.cohesion / mu) : strength.tension;
  return tension > 0.0 ? -normal_force / tension : 0.0;
}

void add_strength(const JointLaw& law, const ContactMemory& memory, double gap, double normal_force,
                  ContactTable* table) {
  JointStrength strength = bond_in_step(law, memory.joint).strength;
  strength.compression = law.strength.compression;
  const bool dry = law.strength == JointStrength{};
  table->strength_use.push_back(dry ? kNone : strength_use(strength, law.mu, normal_force));
  table->damage.push_back(bonds(law) ? memory.joint.damage : kNone);
  table->crack_opening.push_back(crack_opening(gap, memory));
}

}  // namespace

double crack_opening(double gap, const ContactMemory& memory) {
  return std::max(0.0, gap + memory.joint.crushing - std::max(0.0, memory.elastic_gap));
}

JointNumbers number_joints(const ContactSet& contacts) {
  JointNumbers numbers;
  numbers.of_contact.resize(contacts.points.size());
  std::map<std::tuple<int, int, JointKind>, int> known;
  for (size_t i = 0; i < contacts.points.size(); ++i) {
    const Contact& contact = contacts.points[i];
    const auto [entry, inserted] = known.try_emplace(
        {contact.block_a, contact.block_b, contacts.patches[contact.patch].kind}, numbers.count);
    if (inserted) ++numbers.count;
    numbers.of_contact[i] = entry->second;
  }
  return numbers;
}

std::optional<LawViolation> largest_violation(const Frame& frame) {
  const ContactTable& contacts = frame.contacts;
  std::optional<LawViolation> worst;
  for (int i = 0; i < contacts.size(); ++i) {
    const double value = contacts.law_violation[i];
    if (std::isnan(value) || (worst && value <= worst->value)) continue;
    worst = LawViolation{value, contacts.joint[i], contacts.block_a[i], contacts.block_b[i], frame.time};
  }
  return worst;
}

void WorstOfRun::include(const Residuals& of_step, const std::optional<ForceCertificate>& certificate_of_step,
                         const ForcesUnique& unique_in_step,
                         const std::optional<LawViolation>& violation_of_step,
                         const std::optional<RunStep>& step) {
  const auto raise = [](double value, double* largest) {
    const bool raised = !(value <= *largest);  // NaN included
    if (raised) *largest = value;
    return raised;
  };
  if (step && !steps) steps.emplace();
  if (raise(of_step.momentum, &residuals.momentum) && step) steps->momentum_residual = step;
  if (raise(of_step.contact_law, &residuals.contact_law) && step) steps->contact_law_residual = step;
  raise(of_step.rigid_contact_speed, &residuals.rigid_contact_speed);
  raise(of_step.contact_law_rounding, &residuals.contact_law_rounding);
  raise(of_step.cone_violation, &residuals.cone_violation);
  const auto is_worse = [](const ForceCertificate& a, const ForceCertificate& b) {
    return b.value && (!a.value || *a.value > *b.value);
  };
  if (certificate_of_step && (!certificate || is_worse(*certificate_of_step, *certificate))) {
    certificate = certificate_of_step;
    if (step) steps->certified_force_error = step;
  }
  if (!unique_in_step.value || unique.reason.empty()) unique = unique_in_step;
  if (violation_of_step && (!violation || violation_of_step->value > violation->value))
    violation = violation_of_step;
}

void WorstOfRun::summarize(Summary* summary) const {
  summary->momentum_residual = residuals.momentum;
  summary->contact_law_residual = residuals.contact_law;
  summary->friction_cone_violation = residuals.cone_violation;
  summary->certified_force_error = certificate.value_or(ForceCertificate{{}, "no contact is loaded"});
  summary->forces_unique = unique;
  summary->largest_law_violation = violation;
  summary->worst_steps = steps;
}

namespace {

Eigen::Vector4d wxyz(const Pose& pose) {
  return {pose.q_WB.w(), pose.q_WB.x(), pose.q_WB.y(), pose.q_WB.z()};
}

TieTable tie_table(const Model& model, const State& state, const std::vector<double>& forces,
                   const ContactMemories& memories) {
  TieTable table;
  for (size_t k = 0; k < model.ties.size(); ++k) {
    const Tie& tie = model.ties[k];
    const TieGeometry now = tie_geometry(tie, state.poses, state.ground);
    table.chain.push_back(tie.chain);
    table.block_a.push_back(tie.block_a);
    table.block_b.push_back(tie.block_b);
    table.point_a.push_back(now.point_a);
    table.point_b.push_back(now.point_b);
    table.force.push_back(forces.empty() ? 0.0 : forces[k]);
    table.yield_force.push_back(tie.yield_force);
    table.yielded.push_back(memories.ties.empty() ? 0.0 : memories.ties[k].yielded);
    table.strut.push_back(tie.strut ? 1 : 0);
  }
  return table;
}

}  // namespace

Frame make_frame(const Model& model, const State& state, const ContactSet& contacts,
                 const JointForces& forces, const std::vector<double>& violations,
                 const ContactMemories& memories, const std::vector<Vec3>& displacement) {
  CUPOLA_ASSERT(forces.contacts.size() == contacts.points.size());
  CUPOLA_ASSERT(violations.size() == contacts.points.size());
  CUPOLA_ASSERT(memories.ids.size() == contacts.points.size());
  CUPOLA_ASSERT(displacement.size() == state.poses.size());
  Frame frame;
  frame.time = state.time;
  ContactTable& table = frame.contacts;
  table.joint = number_joints(contacts).of_contact;
  table.reserve(contacts.points.size());
  table.law_violation = violations;
  for (size_t i = 0; i < contacts.points.size(); ++i) {
    const Contact& contact = contacts.points[i];
    const Patch& patch = contacts.patches[contact.patch];
    Vec3 force = forces.contacts[i];
    double normal_force = contact.normal.dot(force);
    const double tangential_force = (force - normal_force * contact.normal).norm();
    if (std::abs(normal_force) <= 2.0 * kNoPush) {  // rounding included
      force -= normal_force * contact.normal;
      normal_force = 0.0;
    }
    const JointLaw law = joint_law(model, contacts, contact, state.time);
    const double cohesion = (1.0 - memories.of(i).joint.step_damage) * law.strength.cohesion;
    const double limit = cohesion + law.mu * normal_force;
    table.block_a.push_back(contact.block_a);
    table.block_b.push_back(contact.block_b);
    table.kind.push_back(patch.kind);
    table.ring.push_back(patch.ring);
    table.point.push_back(0.5 * (contact.point_a + contact.point_b));
    table.normal.push_back(contact.normal);
    table.gap.push_back(contact.gap);
    table.force.push_back(force);
    table.normal_force.push_back(normal_force);
    table.friction_use.push_back(limit > 0.0 ? tangential_force / limit : 0.0);
    table.area.push_back(bearing_area(contact, patch));
    table.slip.push_back(memories.of(i).plastic_slip);
    if (!model.joints.has_strength()) continue;
    table.friction_limit.push_back(std::max(0.0, limit));
    add_strength(law, memories.of(i), contact.gap, normal_force, &table);
  }

  BlockTable& blocks = frame.blocks;
  for (size_t block = 0; block < state.poses.size(); ++block) {
    const Pose& pose = state.poses[block];
    const int i = model.free_index[block];
    const bool is_free = i != ContactProblem::kFixed;
    blocks.position.push_back(pose.p_WB);
    blocks.quaternion_wxyz.push_back(wxyz(pose));
    blocks.velocity.push_back(is_free ? Vec3(state.v.segment<3>(6 * i)) : Vec3::Zero());
    blocks.angular_velocity.push_back(is_free ? Vec3(state.v.segment<3>(6 * i + 3)) : Vec3::Zero());
    blocks.displacement.push_back(displacement[block]);
  }
  frame.ties = tie_table(model, state, forces.ties, memories);
  return frame;
}

void set_tie_ends(const Model& model, const State& found, Frame* frame) {
  for (size_t k = 0; k < model.ties.size(); ++k) {
    const TieGeometry then = tie_geometry(model.ties[k], found.poses, found.ground);
    frame->ties.point_a[k] = then.point_a;
    frame->ties.point_b[k] = then.point_b;
  }
}

void set_contact_poses(const Model& model, const State& found, Frame* frame) {
  for (const Pose& pose : found.poses) {
    frame->blocks.contact_position.push_back(pose.p_WB);
    frame->blocks.contact_quaternion_wxyz.push_back(wxyz(pose));
  }
  set_tie_ends(model, found, frame);
}

void set_contact_poses_if_moved(const Model& model, const State& found, Frame* frame) {
  const std::vector<Pose> built = initial_poses(*model.assembly);
  const auto stands = [](const Pose& a, const Pose& b) {
    return a.p_WB == b.p_WB && a.q_WB.coeffs() == b.q_WB.coeffs();
  };
  if (!std::ranges::equal(found.poses, built, stands)) set_contact_poses(model, found, frame);
}

void append_parted(const Model& model, const ContactSet& built, const ContactSet& found, double margin,
                   Frame* frame) {
  ContactTable* table = &frame->contacts;
  std::set<ContactId> held;
  for (const Contact& contact : found.points) held.insert(contact.id);
  std::map<std::tuple<int, int, JointKind>, int> joints;
  int count = 0;
  for (int i = 0; i < table->size(); ++i) {
    joints[{table->block_a[i], table->block_b[i], table->kind[i]}] = table->joint[i];
    count = std::max(count, table->joint[i] + 1);
  }
  const bool has_strength = !table->damage.empty();
  for (const Contact& contact : built.points) {
    if (contact.gap <= margin || held.contains(contact.id)) continue;
    const Patch& patch = built.patches[contact.patch];
    const auto [joint, is_new] = joints.try_emplace({contact.block_a, contact.block_b, patch.kind}, count);
    count += is_new;
    table->joint.push_back(joint->second);
    table->block_a.push_back(contact.block_a);
    table->block_b.push_back(contact.block_b);
    table->kind.push_back(patch.kind);
    table->ring.push_back(patch.ring);
    table->point.push_back(0.5 * (contact.point_a + contact.point_b));
    table->normal.push_back(contact.normal);
    table->gap.push_back(contact.gap);
    table->force.push_back(Vec3::Zero());
    table->area.push_back(bearing_area(contact, patch));
    for (std::vector<double>* zero : {&table->normal_force, &table->friction_use, &table->law_violation})
      zero->push_back(0.0);
    table->slip.push_back(kNone);
    if (!has_strength) continue;
    table->friction_limit.push_back(0.0);
    const JointLaw law = joint_law(model, built, contact, frame->time);
    table->strength_use.push_back(law.strength == JointStrength{} ? kNone : 0.0);
    table->damage.push_back(bonds(law) ? 1.0 : kNone);
    table->crack_opening.push_back(contact.gap);
  }
}

void summarize_frame(const Frame& frame, const Model& model, Summary* summary) {
  const ContactTable& contacts = frame.contacts;
  summary->blocks = frame.blocks.size();
  summary->free_blocks = model.num_free();
  summary->unknowns = model.num_unknowns();
  summary->contacts = contacts.size();
  summary->joints = 0;
  summary->slipping_contacts = 0;
  summary->max_penetration_m = 0.0;
  double largest_force = 0.0;
  for (const Vec3& force : contacts.force) largest_force = std::max(largest_force, force.norm());
  for (int i = 0; i < contacts.size(); ++i) {
    summary->joints = std::max(summary->joints, contacts.joint[i] + 1);
    summary->max_penetration_m = std::max(summary->max_penetration_m, -contacts.gap[i]);
    if (contacts.friction_use[i] >= kSlipping && contacts.force[i].norm() > kNegligibleShare * largest_force)
      ++summary->slipping_contacts;
  }
  summary->weight_N = model.free_weight;
}

double largest_displacement(const Frame& frame) {
  double largest = 0.0;
  for (const Vec3& d : frame.blocks.displacement) largest = std::max(largest, d.norm());
  return largest;
}

void summarize_balance(const Equilibrium& balance, Summary* summary) {
  summary->applied_load_N = balance.applied_load;
  summary->support_reaction_N = balance.support_reaction;
  summary->inertia_share = balance.inertia_share;
  summary->equilibrium_residual = balance.residual;
}

}  // namespace cupola
