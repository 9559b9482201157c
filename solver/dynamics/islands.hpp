#pragma once

#include <vector>

#include "assembly/case/analysis.hpp"
#include "solver/dynamics/contact_memory.hpp"
#include "solver/dynamics/equilibrium.hpp"
#include "solver/dynamics/model.hpp"

namespace cupola {

/// Island of each free block (num_free): a set of free blocks connected by ties, also slack ones, and by
/// contacts, whether closed or open within the margin. An island is numbered by its first block.
std::vector<int> islands_of(const Model& model, const ContactSet& contacts);

/// Which free blocks sleep. An island falls asleep when all its blocks have been slower than Sleep::speed for
/// Sleep::time. A block that comes within the margin of a sleeping island becomes part of it and wakes it.
struct SleepState {
  std::vector<double> calm_since;  ///< s, last time at which the block was faster (num_free)
  std::vector<char> asleep;        ///< 1 or 0 (num_free)
  int num_asleep() const;
};

/// Puts calm islands to sleep, setting their velocities to zero, and wakes the others. Returns true if the
/// state of any block changed. The speed of a block is |v| + radius |omega|, with `radius` in m (num_free).
bool update_sleep(const Sleep& sleep, const std::vector<int>& islands, const std::vector<double>& radius,
                  State* state, SleepState* sleep_state);

/// Some islands of a scene as a separate scene, in which all other blocks are fixed.
struct ScenePart {
  Model model;
  State state;
  /// Points are updated in each step. Patch polygons are not: use those of the whole scene.
  ContactSet contacts;
  ContactMemories memories;
  std::vector<int> contact_rows;  ///< index of each contact in the whole scene
};

/// The part of a scene whose free blocks have chosen == which (num_free), all of which form whole islands.
ScenePart part_of(const Model& model, const State& state, const ContactSet& contacts,
                  const ContactMemories& memories, const std::vector<char>& chosen, char which);

/// A scene in which some islands sleep. It is valid until a block falls asleep or wakes, or until contacts
/// are detected again. Until then a sleeping block costs only the detection of approaching blocks.
struct ReducedScene {
  ScenePart awake;
  JointForces forces;   ///< of the whole scene; sleeping joints keep the forces of their last step
  Equilibrium balance;  ///< of the sleeping blocks under those forces
};
/// `h`: s, duration of the step that gave the impulses in `memories`.
ReducedScene reduce_to_awake(const Model& model, const State& state, const ContactSet& contacts,
                             const ContactMemories& memories, const SleepState& sleep_state, double h);

/// Throws InputError if anything but a neighbour could wake a sleeping block: loads, friction or supports
/// that vary in time, or ties.
void require_sleepable(const Case& scene, const Model& model);

}  // namespace cupola
