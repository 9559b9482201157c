#pragma once

#include <vector>

#include "assembly/case/analysis.hpp"
#include "solver/dynamics/contact_memory.hpp"
#include "solver/dynamics/equilibrium.hpp"
#include "solver/dynamics/model.hpp"

namespace cupola {

/// Island of each free block: blocks that contacts (closed or within the margin) join, fixed ones not
/// counted. Numbered by their first block (num_free).
std::vector<int> islands_of(const Model& model, const ContactSet& contacts);

/// Who sleeps. An island does when none of its blocks has been faster than the speed asked for the time
/// asked; a block that comes within the margin of another joins its island and wakes it.
struct Sleepers {
  std::vector<double> calm_since;  ///< s, per free block: last time at which it was faster
  std::vector<char> asleep;        ///< per free block
  int num_asleep() const;
};

/// Puts islands to sleep, their velocities to zero, and wakes others; true where anyone did either. `radius`:
/// m, of each free block: with it a rotation counts as a speed.
bool update_sleepers(const Sleep& sleep, const std::vector<int>& islands, const std::vector<double>& radius,
                     State* state, Sleepers* sleepers);

/// Some islands of a scene, as a scene of its own in which the blocks of the others are fixed.
struct ScenePart {
  Model model;
  State state;
  /// Patches as they were when the part was made: who reads their polygons asks the whole.
  ContactSet contacts;
  ContactMemories memories;
  std::vector<int> contact_rows;  ///< row in the whole of each of its contacts
};

/// The scene while some of it sleeps. It lasts until someone falls asleep or wakes, or contacts are found
/// anew; until then a step costs nothing for a sleeper but the watch over who wakes.
struct SleepingScene {
  ScenePart awake;
  JointForces forces;   ///< of the whole: sleepers go on carrying what they carried in their last step
  Equilibrium balance;  ///< of the sleepers under those forces
};
/// `h`: s, the step in which the memories' impulses were found.
SleepingScene put_to_sleep(const Model& model, const State& state, const ContactSet& contacts,
                           const ContactMemories& memories, const Sleepers& sleepers, double h);

/// Throws InputError where sleepers could be roused by something else than a neighbour: loads, friction or
/// supports that vary in time, and ties.
void require_sleepable(const Case& scene, const Model& model);

}  // namespace cupola
