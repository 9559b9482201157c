#pragma once

#include <optional>

#include "solver/contact/problem/contact_problem.hpp"
#include "solver/dynamics/contact_memory.hpp"
#include "solver/dynamics/integrator.hpp"
#include "solver/dynamics/model.hpp"

namespace cupola {

/// Parameters of the time-stepping scheme (paper eq. 8-15).
struct StepOptions {
  double h = 0.01;  ///< s, > 0
  Integrator integrator = Integrator::euler();
  double damping = 0.0;         ///< alpha, s, >= 0
  double recovery_speed = 0.6;  ///< eps_u, m/s, > 0
  Recovery recovery = Recovery::compliant;
  TangentialSpring tangential = TangentialSpring::memory;
  /// Time by which loads, friction and supports advance, s; defaults to h. A static step has a large h and
  /// usually does not advance the time.
  std::optional<double> time_advance;

  double advance() const { return time_advance.value_or(h); }
  /// From the start of the step to the time at which loads are evaluated: its middle, or the end of a static
  /// step.
  double load_advance() const { return time_advance.value_or(0.5 * h); }
  /// Weight of the velocity at the end in the displacement, s, and the same with damping.
  double reach() const { return integrator.v_end * h; }
  double damped_reach() const { return reach() + damping; }
  /// s, between a gap and its b_n: damped_reach(), but reach() if the contact is open and not pulled. The
  /// force of a contact that closes in the step to the penetration d is then (1 + alpha / h) d / c, so that
  /// its damper acts across no gap.
  double reach_of(double gap, double elastic_gap) const {
    return gap > 0.0 && elastic_gap <= 0.0 ? reach() : damped_reach();
  }
};

/// The contact problem of one step. The rows of the contacts come first, followed by three rows per tie.
struct StepProblem {
  ContactProblem problem;
  /// m/s: D_s^T v_s, and the separation of heated faces and ends of ties over `reach`; included in problem.b
  /// (3 (nc + number of ties); empty: none)
  VecX support_velocity;
  double reach = 0.0;    ///< s, StepOptions::reach()
  VecX impulse_time;     ///< s: gamma over it is the force at the end of the step (nc + number of ties)
  VecX past_impulse;     ///< N s, p - gamma, included in problem.v_star (the same size; empty: none)
  VecX acceleration;     ///< m/s2, (f + D s) / M (6 nb; empty: none)
  int num_contacts = 0;  ///< nc, without the ties

  /// u + support_velocity (3 (nc + number of ties)).
  VecX with_supports(VecX u) const {
    if (support_velocity.size() > 0) u += support_velocity;
    return u;
  }
  /// support_velocity of one contact or tie.
  Vec3 support_velocity_of(int row) const {
    return support_velocity.size() > 0 ? Vec3(support_velocity.segment<3>(3 * row)) : Vec3::Zero();
  }
};

/// Axes of a contact with unit normal n: columns n, t1, t2, right-handed. The tangents depend only on n.
Mat3 contact_frame(const Vec3& normal);

/// The contact problem of one step from the state at its start:
///
///     v_star = v + h M^-1 f
///     b_n    = [elastic_gap + max(phi - elastic_gap, -eps_u (h + alpha))] / (h + alpha) + (D_s^T v_s)_n
///     b_t    = elastic_slip / (h + alpha) + (D_s^T v_s)_t
///     E      = c / (h (h + alpha))
///
/// with v_s the imposed velocity of the supports and c the compliance; b_n of an open contact is over h
/// (StepOptions::reach_of()). The gap phi of joints with strength is
/// measured from their inelastic displacements (joint_damage.hpp). A tie is a frictionless contact (ties.hpp)
/// whose yield force is a compressive strength. Differences from the paper:
///
/// - Eq. 14 limits all of phi / h by the recovery speed eps_u, which limits the force of a compliant contact
///   to eps_u h / c. Recovery::literal is that scheme; with Recovery::compliant the limit applies only to
///   penetration not caused by the compliance.
/// - Eq. 14 has no elastic_slip, so that a sticking contact under a tangential force T creeps at c T / h.
///   TangentialSpring::literal is that scheme, TangentialSpring::memory includes elastic_slip.
/// - Loads are evaluated in the middle of the step instead of at its start (eq. 10), so that their impulse is
///   accurate to second order; those of a static step at its end. Friction is evaluated at the end of the
///   step.
///
/// The generalized alpha method (integrator.hpp) has the same form, with the impulse h end r+ for gamma, the
/// displacement v_end h v+ for h v, and what is known of both in v_star and b. `state` has the configuration
/// at which contacts and loads are evaluated (middle_of_step()), the velocities and the time of the start.
StepProblem build_step_problem(const Model& model, const State& state, const ContactSet& contacts,
                               const ContactMemories& memories, const StepOptions& options);

/// The configuration at which a step evaluates contacts and loads; the state itself for implicit Euler.
State middle_of_step(const Model& model, const State& state, const StepOptions& options);

/// Mean velocity of the step, by which the blocks move (6 nb).
VecX mean_velocity(const StepProblem& step, const State& state, const ContactSolution& solution,
                   const StepOptions& options);

/// Updates the memories from the solution of the step problem:
///
///     u    = D^T v + D_s^T v_s             relative velocity
///     u_el = u - (D^T v + b + E gamma)     its elastic part, equal to u while the contact sticks
///
/// The gap and the slip of the springs change by reach() u_el, but the slip so that it follows from the force
/// and rate_of_spring() (joint_damage.hpp). The rest of the tangential motion is plastic slip, and the rest of
/// the motion of joints with strength adds to their damage.
void update_memories(const Model& model, const StepProblem& step, const ContactSolution& solution,
                     const State& state, const ContactSet& contacts, const StepOptions& options,
                     ContactMemories* memories);

/// m, >= 0: by which a tie, whose rows are those of `row`, yields in the step.
double plastic_elongation(const StepProblem& step, int row, const ContactSolution& solution);

/// What the generalized alpha method keeps of a contact that carries the force (N, world axes) in a structure
/// at rest.
void continue_from_rest(const Vec3& force, const Pose& pose_a, ContactMemory* memory);

/// The impulse of the last step in the present contact frame. contact_frame() changes its tangents where the
/// normal passes a tie between world axes, by 60 degrees or more. At a level bed rounding is enough for that.
Vec3 in_present_frame(const ContactMemory& memory, const Contact& contact, const State& state);

/// Warm start of the solve: velocities at the start of the step and impulses of the last step.
ContactSolution warm_start(const StepProblem& step, const State& state, const ContactSet& contacts,
                           const ContactMemories& memories);

/// Steps at whose end a contact must have been loaded before its force has a past. In the first the contact
/// may have closed; the force at its end is that of an impact, and at the end of the next that of a contact.
constexpr int kSmooth = 2;

/// Whether the impulse of a contact depends on its force at the start of the step: generalized alpha method
/// only.
inline bool has_past(const ContactMemory& memory, const StepOptions& options) {
  return !options.integrator.is_euler() && memory.loaded_steps >= kSmooth;
}

/// The part of the relative displacement of a contact in a step that is known at its start, m: up to the
/// configuration in the middle, where the gap is measured, and the rest, without reach v+. Zero for implicit
/// Euler.
struct KnownMotion {
  Vec3 to_middle = Vec3::Zero(), rest = Vec3::Zero();
};
/// `v`: velocities at the start of the step (6 nb).
KnownMotion known_motion(const StepProblem& step, int i, const VecX& v, const StepOptions& options);

}  // namespace cupola
