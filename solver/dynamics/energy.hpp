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

/// J, of gravity and applied loads with their values at `time`.
double potential_energy(const Model& model, const std::vector<Pose>& poses, double time);

/// J, stored in the ties.
double tie_energy(const Model& model, const State& state, const ContactMemories& memories);

}  // namespace cupola
