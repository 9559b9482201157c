#pragma once

#include <span>
#include <vector>

#include "solver/collision/contact_set.hpp"

namespace cupola {

/// What a contact with strength has suffered (joint_damage.hpp).
struct JointDamage {
  double damage = 0.0;    ///< in [0, 1]: share of tension and cohesion that is lost; never falls
  double opening = 0.0;   ///< m, >= 0: inelastic opening under pull
  double crushing = 0.0;  ///< m, >= 0: inelastic closing under pressure
  // Of the present step:
  double step_damage = 0.0;  ///< mean over the step
  bool bears = false;        ///< an open joint that pushes when its faces meet, instead of pulling
};

/// State of a contact that is carried from step to step.
struct ContactMemory {
  Vec3 impulse = Vec3::Zero();    ///< N s, gamma of the last step in its contact frame, for the warm start
  Vec3 tangent_A = Vec3::Zero();  ///< first tangent of that frame, axes of block a; zero: unknown
  Vec3 point_A = Vec3::Zero();    ///< m, where the contact was, from the centroid of block a in its axes
  double elastic_gap =
      0.0;  ///< m: penetration caused by the compliance (< 0), or elongation under pull (> 0)
  Vec3 elastic_slip_A = Vec3::Zero();  ///< m, elongation of the tangential spring, axes of block a
  double plastic_slip = 0.0;           ///< m, >= 0: accumulated sliding distance
  // Of the generalized alpha method (integrator.hpp), axes of block a:
  Vec3 force_A = Vec3::Zero();     ///< N, r at the end of the last step
  Vec3 filtered_A = Vec3::Zero();  ///< N, s
  int loaded_steps = 0;            ///< steps in succession at whose end the contact was loaded
  /// m, from which the gap is measured: < 0 the penetration that an impact has left, > 0 what sliding under
  /// pressure has opened on a path (see keep_dilatancy())
  double rest_gap = 0.0;
  JointDamage joint;
};

/// ContactMemory::point_A of a contact whose block a has this pose.
inline Vec3 place_on(const Pose& pose_a, const Contact& contact) {
  return pose_a.q_WB.conjugate() * (contact.point_a - pose_a.p_WB);
}

/// State of a tie that is carried from step to step.
struct TieMemory {
  double impulse = 0.0;  ///< N s, of the last step, for the warm start
  double yielded = 0.0;  ///< m, >= 0, plastic elongation
};

/// Memories of the contacts of one step, in the order of the contacts.
struct ContactMemories {
  std::vector<ContactId> ids;         ///< (nc)
  std::vector<ContactMemory> values;  ///< (nc), or empty: nothing has happened to any contact
  std::vector<TieMemory> ties;        ///< (number of ties), or empty before the first step
  bool as_built = true;               ///< no contacts were matched yet

  const ContactMemory& of(std::size_t contact) const;
  std::vector<ContactMemory>& stored();  ///< values of all contacts
};

/// Transfers memories to a new set of contacts by identity. A new point of an old patch takes over what its
/// nearest old point remembers of the joint, whose points change in number as it moves; `poses` of all blocks.
/// Any other new contact starts unloaded. It is bonded if it exists as built and its faces touch.
ContactMemories match_memories(ContactMemories old, const std::vector<Contact>& contacts,
                               std::span<const Pose> poses = {});

}  // namespace cupola
