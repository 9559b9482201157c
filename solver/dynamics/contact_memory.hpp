#pragma once

#include <vector>

#include "solver/collision/contact_set.hpp"

namespace cupola {

/// What a contact remembers from the last step.
struct ContactMemory {
  Vec3 impulse = Vec3::Zero();         ///< N s, gamma of the last step in the contact frame: warm start
  double elastic_gap = 0.0;            ///< m, <= 0: penetration that the compliance explains
  Vec3 elastic_slip_A = Vec3::Zero();  ///< m, tangential spring, in the axes of block a
  double plastic_slip = 0.0;           ///< m, accumulated sliding
};

/// Memories of the contacts of one step, in their order.
struct ContactMemories {
  std::vector<ContactId> ids;  ///< each names one pair of parts, and so one pair of blocks
  std::vector<ContactMemory> values;
  std::vector<double> tie_impulses;  ///< N s, of the last step, one per tie of the model
};

/// Carries memories over to a new set of contacts: a contact keeps its own by its identity, a new one
/// starts with none.
ContactMemories match_memories(const ContactMemories& old, const std::vector<Contact>& contacts);

}  // namespace cupola
