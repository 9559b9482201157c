#pragma once

#include <optional>

#include "solver/contact/problem/contact_problem.hpp"
#include "solver/dynamics/contact_memory.hpp"
#include "solver/dynamics/model.hpp"

namespace cupola {

/// What the time-stepping scheme needs besides the scene (paper eq. 8-15).
struct StepOptions {
  double h = 0.01;              ///< s
  double damping = 0.0;         ///< alpha, s
  double recovery_speed = 0.6;  ///< eps_u, m/s
  TangentialSpring tangential = TangentialSpring::memory;
  /// s by which loads, friction and supports go on in this step; none: h. A static step has a large h and
  /// leaves the clock where it is.
  std::optional<double> time_advance;

  double advance() const { return time_advance.value_or(h); }
};

/// The contact problem of one step. Rows of the contacts first, then one contact row set per tie.
struct StepProblem {
  ContactProblem problem;
  VecX support_velocity;  ///< m/s, what the imposed motion of supports adds to u; contained in b (3 rows)
  int num_contacts = 0;   ///< the rest are ties
};

/// Axes of a contact: columns n, t1, t2, right-handed; the tangents depend on n alone.
Mat3 contact_frame(const Vec3& normal);

/// The contact problem of one step from the state at its start:
///
///     v_star = v + h M^-1 f
///     b_n = [elastic_gap + max(phi - elastic_gap, -eps_u (h + alpha))] / (h + alpha) + (D_s^T v_s)_n
///     b_t = elastic_slip / (h + alpha) + (D_s^T v_s)_t      (`memory`; without the slip in the paper's
///     `literal`) E   = c / (h (h + alpha))
///
/// Paper eq. 14 limits phi/h as a whole, which would limit the force of a compliant contact too, to
/// eps_u h / c. Here the limit acts only on penetration that the compliance does not explain. Without the
/// memory of b_t a sticking contact creeps for ever at c T / h. v_s is the imposed velocity of supports; a
/// tie is a frictionless contact with phi = L0 - L. Loads are those in the middle of the step (paper eq. 10:
/// at its start), which makes their impulse right to second order; friction is that at its end.
StepProblem build_step_problem(const Model& model, const State& state, const ContactSet& contacts,
                               const ContactMemories& memories, const StepOptions& options);

/// Updates the memories from the answer of that problem. With u = D^T v + D_s^T v_s and the elastic rate
/// u_el = u - (D^T v + b + E gamma), which is u while sticking: slip and gap of the spring advance by h u_el,
/// the rest of the tangential motion is plastic.
void update_memories(const StepProblem& step, const ContactSolution& solution, const State& state,
                     const ContactSet& contacts, const StepOptions& options, ContactMemories* memories);

/// The guess that warm-starts a solve: velocities at the start of the step and remembered impulses.
ContactSolution warm_start(const StepProblem& step, const State& state, const ContactMemories& memories);

}  // namespace cupola
