#pragma once

#include "solver/analysis/statics/static_solve.hpp"

namespace cupola {

/// A static solve from `start`, repeated where joints with strength break until their damage is right
/// (joint_damage.hpp). Unconverged where what they bear comes back to an earlier state. `memories` has that
/// damage. Sets the number of solves.
StaticSolution solve_breaking(const Model& model, const State& start, const ContactSet& contacts,
                              const StaticOptions& options, ContactMemories* memories, int* solves);

/// True if no forces balance the loads whichever cracks bear or pull. `motion` (6 nb), if not empty, is tried
/// as a proof first.
bool moves_with_bonded_joints(const Model& model, const State& start, const ContactSet& contacts,
                              const ContactMemories& bonded, const StaticOptions& options,
                              const VecX& motion = {});

}  // namespace cupola
