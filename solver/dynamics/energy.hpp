#pragma once

#include "solver/dynamics/time_step.hpp"

namespace cupola {

/// Energies at one time, J. Potential energy is relative to the assembly as generated, under the loads at
/// that time.
struct Energy {
  double kinetic = 0.0;
  double potential = 0.0;  ///< of gravity and applied loads
  double elastic = 0.0;    ///< stored in the compliance of joints and ties
  double total() const { return kinetic + potential + elastic; }
};

Energy compute_energy(const Model& model, const State& state, const ContactSet& contacts,
                      const ContactMemories& memories);

/// Work dissipated in the joints in one step, J, >= 0 in exact arithmetic. Of friction:
///
///     - sum gamma_t . z_t,   z = D^T v + b + E gamma
///
/// Joints with strength add the work of tension and crushing, sum (- gamma_n z_n)+. A dilating joint stores the work
/// gamma_n z_n > 0 as potential energy.
double joint_dissipation(const StepProblem& step, const ContactSolution& solution);

}  // namespace cupola
