#pragma once

#include "solver/dynamics/contact_memory.hpp"
#include "solver/dynamics/model.hpp"

namespace cupola {

/// Energies of one instant, J. Potential energy counts from the assembly's own configuration.
struct Energy {
  double kinetic = 0.0;
  double potential = 0.0;  ///< of gravity and of loads of constant direction
  double elastic = 0.0;    ///< stored in the joints' compliance
  double total() const { return kinetic + potential + elastic; }
};

Energy compute_energy(const Model& model, const State& state, const ContactSet& contacts,
                      const ContactMemories& memories);

/// Work lost to sliding in one step: - sum gamma_t . u_plastic, J, >= 0 in exact arithmetic. Taken from the
/// contact problem, where u_plastic = u + b_t + E gamma_t.
double friction_dissipation(const ContactProblem& problem, const ContactSolution& solution);

}  // namespace cupola
