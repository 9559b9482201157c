#pragma once

#include <vector>

#include "solver/collision/contact_set.hpp"

namespace cupola {

/// State of a contact that is carried from step to step.
struct ContactMemory {
  Vec3 impulse = Vec3::Zero();  ///< N s, gamma of the last step in the contact frame, for the warm start
  double elastic_gap = 0.0;     ///< m, <= 0: penetration caused by the compliance
  Vec3 elastic_slip_A = Vec3::Zero();  ///< m, elongation of the tangential spring, axes of block a
  double plastic_slip = 0.0;           ///< m, >= 0: accumulated sliding distance
};

/// Memories of the contacts of one step, in the order of the contacts.
struct ContactMemories {
  std::vector<ContactId> ids;         ///< (nc)
  std::vector<ContactMemory> values;  ///< (nc)
  std::vector<double> tie_impulses;   ///< N s, of the last step (number of ties)
};

/// Transfers memories to a new set of contacts by identity. A contact without an old memory starts unloaded.
ContactMemories match_memories(const ContactMemories& old, const std::vector<Contact>& contacts);

}  // namespace cupola
