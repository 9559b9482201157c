#pragma once

#include "solver/dynamics/time_step.hpp"

namespace cupola {

/// Energies of one instant, J. Potential energy counts from the assembly's own configuration, under the loads
/// of that instant.
struct Energy {
  double kinetic = 0.0;
  double potential = 0.0;  ///< of gravity and of loads of constant direction
  double elastic = 0.0;    ///< stored in the joints' compliance and in ties
  double total() const { return kinetic + potential + elastic; }
};

Energy compute_energy(const Model& model, const State& state, const ContactSet& contacts,
                      const ContactMemories& memories);

/// Work lost to sliding in one step: - sum gamma_t . u_plastic, J, >= 0 in exact arithmetic. Taken from the
/// contact problem, where u_plastic = D^T v + b + E gamma, tangential part.
double friction_dissipation(const StepProblem& step, const ContactSolution& solution);

}  // namespace cupola
