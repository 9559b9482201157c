#pragma once

#include <vector>

#include "assembly/case/analysis.hpp"
#include "solver/dynamics/contact_memory.hpp"
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

/// Puts islands to sleep, their velocities to zero, and wakes others. `radius`: m, of each free block: with
/// it a rotation counts as a speed.
void update_sleepers(const Sleep& sleep, const std::vector<int>& islands, const std::vector<double>& radius,
                     State* state, Sleepers* sleepers);

/// The part of a scene that is awake, as a scene of its own in which sleepers are fixed blocks.
struct AwakePart {
  Model model;
  State state;
  ContactSet contacts;
  ContactMemories memories;
  std::vector<int> contact_rows;  ///< row in the whole of each of its contacts
};
AwakePart awake_part(const Model& model, const State& state, const ContactSet& contacts,
                     const ContactMemories& memories, const Sleepers& sleepers);

/// Throws InputError where sleepers could be roused by something else than a neighbour: loads, friction or
/// supports that vary in time, and ties.
void require_sleepable(const Case& scene, const Model& model);

}  // namespace cupola
