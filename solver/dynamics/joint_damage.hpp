#pragma once

#include "solver/contact/problem/contact_problem.hpp"
#include "solver/dynamics/contact_memory.hpp"
#include "solver/dynamics/joint_laws.hpp"
#include "solver/dynamics/time_step.hpp"

namespace cupola {

// Joints with strength that move. The elastic gap of a contact point is measured from its inelastic
// displacements:
//
//     bonded   never opened: pull and push, both from the gap -crushing
//     pulled   opened before, no closer than that: pull from the gap -crushing + opening, no push
//     bearing  opened before and closing: push from the gap -crushing, no pull
//
// A crack thus closes without force and takes up pull again where it stopped opening. The inelastic velocity
// of a step is z = D^T v + b + E gamma, and
//
//     opening  += h z_n           under pull
//     crushing += - h z_n         under push
//     damage   += sqrt((h z_n / opening length)^2 + (h |z_t| / slip length)^2)      with z_n only under pull
//
// up to 1: linear softening in either mode, mixed by the quadratic rule (P. B. Lourenco, J. G. Rots 1997,
// "Multisurface interface model for analysis of masonry structures", couple the modes of an interface in a
// similar way). Friction and compressive strength do not depend on the damage. The strength of a step is the
// mean over its inelastic displacement, so that a joint that breaks dissipates its fracture energy whatever
// the number of steps; because that displacement depends on the strength, the step is solved again until the
// mean damage is right.

/// N, the most that a pulled joint pushes. Not zero: a contact without any push would not be a contact.
constexpr double kNoPush = 1e-200;

/// What a contact point bears in one step.
struct StepBond {
  JointStrength strength;  ///< N
  double zero_gap = 0.0;   ///< m: gap at which it carries no normal force
};
StepBond bond_in_step(const JointLaw& law, const JointDamage& joint);

/// Before the first solve of a step: its damage is that at the end of the last step.
void begin_step(const ContactSet& contacts, ContactMemories* memories);

/// After a solve: true if cracks end the step in another role than was solved for, or else its mean damage is
/// another, so that the step has to be solved again. Then `memories` has the new values; no damage heals.
bool refine_step(const Model& model, const State& state, const ContactSet& contacts, const StepProblem& step,
                 const ContactSolution& solution, const StepOptions& options, ContactMemories* memories);

/// After a solve that found a motion: true if it closes joints that pulled or opens joints that bore, which
/// may stop it. They have their new role in `memories`, and the step has to be solved again.
bool follow_motion(const StepProblem& step, const ContactSolution& motion, double h,
                   ContactMemories* memories);

/// A joint that could not pull gets a law that can: it is cracked as far as it is open, or else bonded.
/// `gap`: m.
void begin_to_pull(double gap, JointDamage* joint);

/// Makes cracked joints bonded, for a proof that forces do not balance the loads whichever of them bear or
/// pull. True if there are any.
bool let_joints_bear_and_pull(ContactMemories* memories);

/// Inelastic velocity z of contact i, m/s.
Vec3 inelastic_velocity(const ContactProblem& problem, int i, const ContactSolution& solution);

/// m/s, tangential: the rate of the spring of contact i at the end of a step, whose damper has the rest of the
/// force, alpha rate / c. b contains what is known of the motion of a contact with a past as if it stretched
/// the spring, which a damper would then keep stretched. While the contact sticks the rate is u; the known
/// motion of one that slips faster than that is slip, and its spring follows the force:
///
///     (h + alpha) rate = - (elastic_slip + c r_t)
///
/// `u`: with the motion of supports; `z`: tangential part of inelastic_velocity(); `v`: as of known_motion().
Eigen::Vector2d rate_of_spring(const StepProblem& step, int i, const Eigen::Vector2d& u,
                               const Eigen::Vector2d& z, const VecX& v, const StepOptions& options);

/// At the end of a step: adds its inelastic displacement h z (m) under the impulse gamma (N s).
void add_inelastic_displacement(const JointLaw& law, const Vec3& displacement, const Vec3& gamma,
                                JointDamage* joint);

}  // namespace cupola
