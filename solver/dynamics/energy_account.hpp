#pragma once

#include <vector>

#include "solver/dynamics/time_step.hpp"

namespace cupola {

/// What changes the energy of a scene in one step, J:
///
///     energy at the end - energy at the start = loads + supports + dilatancy - dissipated() + error
///
/// All but `scheme` have formulas of their own. What the forces do on the mean velocities beyond these is
/// `scheme`, which tends to zero with h if the others are right; but contacts that slide on under the
/// associated law do not part, and lose in it what dilatancy gives. The error that remains is that of the
/// contact solve and of rounding.
struct StepWork {
  double loads = 0.0;     ///< increase of the potential energy by loads that change in time
  double supports = 0.0;  ///< work of moving supports
  /// work of the opening that accompanies slip, sum (gamma_n z_n)+. The associated law returns in it what
  /// friction takes.
  double dilatancy = 0.0;
  double friction = 0.0;  ///< slip and breaking of joints (joint_work()), and ties that yield
  double damping = 0.0;   ///< >= 0: alpha h norm(u_el)^2 / c of compliant joints, and springs that part
  /// Of contacts that close, whose springs are compressed by less than they approach in the step: work on the
  /// mean velocity that springs, dampers and friction do not take up, (u - u_start) . gamma / 2 + b_n+ gamma_n
  double impact = 0.0;
  /// What the integrator takes, or gives if negative: work of the joints on the mean velocity that is neither
  /// stored nor dissipated above, the same of the loads, finite rotations, contacts that are detected anew,
  /// and blocks that fall asleep. The kinetic energy changes by the impulses times the mean velocity (v + v+)
  /// / 2, whatever the integrator.
  double scheme = 0.0;

  double dissipated() const { return friction + damping + impact + scheme; }
  double change() const { return loads + supports + dilatancy - dissipated(); }
  StepWork& operator+=(const StepWork& other);
};

/// What the account of a step needs from its start.
struct StepStart {
  State state;
  std::vector<double> springs;      ///< J, energy of the springs of each contact (nc)
  std::vector<double> elastic_gap;  ///< m, of each contact (nc)
  double ties = 0.0;                ///< J, stored in the ties
};
StepStart begin_account(const Model& model, const State& state, const StepProblem& step,
                        const ContactMemories& memories, const StepOptions& options);

/// The work of a step that moved the scene from `start` to `state` and `memories`.
StepWork work_of_step(const Model& model, const StepStart& start, const StepProblem& step,
                      const ContactSolution& solution, const State& state, const ContactMemories& memories,
                      const StepOptions& options);

/// J, >= 0 in exact arithmetic, of one contact in a step: work on its inelastic displacement
///
///     reach z,   z = D^T v + b + E gamma
///
/// against the force r+ at the end of the step.
struct JointWork {
  double slip = 0.0;       ///< - r_t . reach z_t, of friction and cohesion
  double breaking = 0.0;   ///< (- r_n reach z_n)+ of joints with strength: tension and crushing
  double dilatancy = 0.0;  ///< (r_n reach z_n)+, which slip gains
};
/// `gamma`: N s; `displacement`: m, reach z.
JointWork joint_work(const StepProblem& step, int i, const Vec3& gamma, const Vec3& displacement);

/// J, of the plastic elongation of a tie, by its row.
double yield_work(const StepProblem& step, int row, const ContactSolution& solution);

}  // namespace cupola
