#include "solver/dynamics/joint_damage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace cupola {
namespace {

/// Of the fracture energy: error of a solve whose step damage is wrong by this.
constexpr double kDamageError = 5e-4;

/// m. Smaller displacements are left for the next step, whose inelastic displacement includes them.
constexpr double kRounding = 1e-12;

/// m. A brittle joint breaks beyond it: above the rounding of positions, below what matters.
constexpr double kBreaks = 1e-9;

double over_length(double displacement, double length) {
  if (length == 0.0) return displacement > kBreaks ? std::numeric_limits<double>::infinity() : 0.0;
  return displacement / length;
}

/// Increase of the damage, not limited to what is left.
double added_damage(const JointLaw& law, const Vec3& displacement, const Vec3& gamma,
                    const JointDamage& joint) {
  if (law.strength.tension == 0.0 && law.strength.cohesion == 0.0) return 0.0;
  const StepBond bond = bond_in_step(law, joint);
  const bool no_tension = law.strength.tension == 0.0;  // open joints lose their cohesion if they are brittle
  const bool opens =
      displacement[0] > 0.0 && (bond.strength.tension > 0.0 ? gamma[0] < 0.0 : no_tension && gamma[0] <= 0.0);
  const double opening = opens ? over_length(displacement[0], law.crack.opening) : 0.0;
  const double slip = over_length(displacement.tail<2>().norm(), law.crack.slip);
  return std::hypot(opening, slip);
}

/// Mean of min(1, damage + s added) over s from 0 to 1.
double mean_damage(double damage, double added) {
  if (damage + added <= 1.0) return damage + 0.5 * added;
  return 1.0 - 0.5 * (1.0 - damage) * (1.0 - damage) / added;
}

}  // namespace

StepBond bond_in_step(const JointLaw& law, const JointDamage& joint) {
  const double left = 1.0 - joint.step_damage;
  StepBond bond{{left * law.strength.tension, left * law.strength.cohesion, law.strength.compression},
                -joint.crushing};
  if (joint.opening == 0.0 || bond.strength.tension == 0.0) return bond;
  if (joint.bears) {
    bond.strength.tension = 0.0;
  } else {
    bond.strength.compression = kNoPush;
    bond.zero_gap += joint.opening;
  }
  return bond;
}

void begin_step(const ContactSet& contacts, ContactMemories* memories) {
  for (size_t i = 0; i < contacts.points.size(); ++i) {
    JointDamage& joint = memories->stored()[i].joint;
    joint.step_damage = joint.damage;
    joint.bears = contacts.points[i].gap + joint.crushing < joint.opening;
  }
}

Vec3 inelastic_velocity(const ContactProblem& problem, int i, const ContactSolution& solution) {
  return relative_velocity(problem, i, solution.v) + problem.b.segment<3>(3 * i) +
         problem.E.segment<3>(3 * i).cwiseProduct(solution.gamma.segment<3>(3 * i));
}

Eigen::Vector2d rate_of_spring(const StepProblem& step, int i, const Eigen::Vector2d& u,
                               const Eigen::Vector2d& z, const VecX& v, const StepOptions& options) {
  const bool past = step.impulse_time[i] < options.h;
  if (!past) return u - z;
  const double h_alpha = options.h + options.damping;
  const Eigen::Vector2d slip = options.damped_reach() / h_alpha * z, rate = u - slip;
  if (slip.norm() <= rate.norm()) return rate;
  const KnownMotion known = known_motion(step, i, v, options);
  const Eigen::Vector2d expected = (options.h - options.reach()) * u;  // at a constant velocity
  return rate + ((known.to_middle + known.rest).tail<2>() - expected) / h_alpha;
}

namespace {

/// True if the joint cracked and has a strength left: it then either bears or pulls.
bool has_role(const JointDamage& joint) {
  return joint.opening > 0.0 && joint.step_damage < 1.0;
}

/// Gives the joint the role that it has at a gap (m, from where its faces touch); true if that is a new one.
/// Between the two gaps it carries nothing in either role.
bool take_role(double gap, JointDamage* joint) {
  if (!has_role(*joint)) return false;
  const bool bears = joint->bears ? gap <= joint->opening + kRounding : gap < 0.0;
  return std::exchange(joint->bears, bears) != bears;
}

}  // namespace

bool refine_step(const Model& model, const State& state, const ContactSet& contacts, const StepProblem& step,
                 const ContactSolution& solution, const StepOptions& options, ContactMemories* memories) {
  const double end = state.time + options.advance();
  std::vector<JointDamage> refined, revised;  // with another damage, and with another role
  bool refines = false, revises = false;
  for (int i = 0; i < step.num_contacts; ++i) {
    JointDamage joint = memories->of(i).joint;
    const Contact& contact = contacts.points[i];
    const JointLaw law = joint_law(model, contacts, contact, end);
    const Vec3 gamma = solution.gamma.segment<3>(3 * i);
    const Vec3 displacement = options.h * inelastic_velocity(step.problem, i, solution);
    const double mean = mean_damage(joint.damage, added_damage(law, displacement, gamma, joint));
    const double u_n = relative_velocity(step.problem, i, solution.v)[0] + step.support_velocity_of(i)[0];
    revised.push_back(joint);
    revises |= take_role(contact.gap + joint.crushing + options.h * u_n, &revised.back());
    refines |= mean > joint.step_damage + kDamageError;
    joint.step_damage = std::max(joint.step_damage, mean);
    refined.push_back(joint);
  }
  if (!revises && !refines) return false;
  // What a joint loses in another role is no loss.
  for (size_t i = 0; i < refined.size(); ++i) memories->stored()[i].joint = revises ? revised[i] : refined[i];
  return true;
}

bool follow_motion(const StepProblem& step, const ContactSolution& motion, double h,
                   ContactMemories* memories) {
  bool any = false;
  for (int i = 0; i < step.num_contacts; ++i) {
    JointDamage& joint = memories->stored()[i].joint;
    const double u_n = relative_velocity(step.problem, i, motion.v)[0] + step.support_velocity_of(i)[0];
    if (!has_role(joint) || std::abs(h * u_n) <= kRounding) continue;
    const bool bears = u_n < 0.0;
    any |= std::exchange(joint.bears, bears) != bears;
  }
  return any;
}

void begin_to_pull(double gap, JointDamage* joint) {
  const double opening = gap + joint->crushing;
  joint->opening = opening > kRounding ? opening : 0.0;
}

bool let_joints_bear_and_pull(ContactMemories* memories) {
  bool any = false;
  for (ContactMemory& memory : memories->stored()) {
    any |= has_role(memory.joint);
    memory.joint.opening = 0.0;
  }
  return any;
}

void add_inelastic_displacement(const JointLaw& law, const Vec3& displacement, const Vec3& gamma,
                                JointDamage* joint) {
  const double added = added_damage(law, displacement, gamma, *joint);
  if (gamma[0] < 0.0 && displacement[0] > kRounding) joint->opening += displacement[0];
  const bool pushes = bond_in_step(law, *joint).strength.compression == law.strength.compression;
  if (pushes && gamma[0] > 0.0 && displacement[0] < -kRounding) joint->crushing -= displacement[0];
  joint->damage = joint->step_damage == 1.0 ? 1.0 : std::min(1.0, joint->damage + added);
}

}  // namespace cupola
