#include "solver/dynamics/contact_memory.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// m. Faces drawn farther apart have no bond: above the rounding of positions, below what matters.
constexpr double kTouching = 1e-9;

ContactMemories first_memories(const ContactMemories& old, const std::vector<Contact>& contacts) {
  ContactMemories first;
  for (size_t i = 0; i < contacts.size(); ++i) {
    first.ids.push_back(contacts[i].id);
    if (contacts[i].gap <= kTouching) continue;
    first.values.resize(contacts.size());
    first.values[i].joint.damage = first.values[i].joint.step_damage = 1.0;
  }
  first.ties = old.ties;
  first.as_built = false;
  return first;
}

ContactId patch_of(ContactId id) {
  id.corner = 0;
  return id;
}

/// The contacts before, by identity.
class OldContacts {
 public:
  explicit OldContacts(const ContactMemories& memories) : memories_(memories) {
    for (size_t i = 0; i < memories.ids.size(); ++i) sorted_.emplace_back(memories.ids[i], i);
    std::sort(sorted_.begin(), sorted_.end());
  }
  /// Null for a new contact.
  const ContactMemory* find(const ContactId& id) const {
    const auto found = first_from(id);
    return found != sorted_.end() && found->first == id ? &memories_.of(found->second) : nullptr;
  }
  /// Of the point of the patch nearest to `place` (m, as ContactMemory::point_A); null if the patch is new.
  const ContactMemory* nearest(const ContactId& id, const Vec3& place) const {
    const ContactMemory* found = nullptr;
    const auto distance = [&](const ContactMemory& memory) { return (memory.point_A - place).norm(); };
    ContactId first = patch_of(id);
    first.corner = std::numeric_limits<int>::min();
    for (auto point = first_from(first); point != sorted_.end(); ++point) {
      if (patch_of(point->first) != patch_of(id)) break;
      const ContactMemory& memory = memories_.of(point->second);
      if (!found || distance(memory) < distance(*found)) found = &memory;
    }
    return found;
  }

 private:
  using Entry = std::pair<ContactId, size_t>;
  std::vector<Entry>::const_iterator first_from(const ContactId& id) const {
    return std::lower_bound(sorted_.begin(), sorted_.end(), Entry{id, 0});
  }

  const ContactMemories& memories_;
  std::vector<Entry> sorted_;
};

/// What a point without forces of its own remembers if it is where `old` was. An open one has no shear.
ContactMemory at_place_of(const ContactMemory& old, double gap) {
  ContactMemory memory = old;
  memory.impulse = memory.force_A = memory.filtered_A = Vec3::Zero();
  memory.loaded_steps = 0;
  if (gap > memory.rest_gap) memory.elastic_slip_A.setZero();
  return memory;
}

}  // namespace

const ContactMemory& ContactMemories::of(std::size_t contact) const {
  static const ContactMemory first;
  return values.empty() ? first : values[contact];
}

std::vector<ContactMemory>& ContactMemories::stored() {
  values.resize(ids.size());
  return values;
}

ContactMemories match_memories(ContactMemories old, const std::vector<Contact>& contacts,
                               std::span<const Pose> poses) {
  CUPOLA_ASSERT(old.values.empty() || old.ids.size() == old.values.size());
  if (old.as_built) return first_memories(old, contacts);
  const auto same_id = [](const ContactId& id, const Contact& contact) { return id == contact.id; };
  if (std::equal(old.ids.begin(), old.ids.end(), contacts.begin(), contacts.end(), same_id)) return old;
  ContactMemories matched;
  matched.ids.reserve(contacts.size());
  matched.values.resize(contacts.size());
  matched.ties = old.ties;
  matched.as_built = false;
  CUPOLA_ASSERT(!poses.empty());
  const OldContacts before(old);
  for (size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = contacts[i];
    const ContactId& id = contact.id;
    if (const ContactMemory* memory = before.find(id))
      matched.values[i] = *memory;
    else if (const ContactMemory* near = before.nearest(id, place_on(poses[contact.block_a], contact)))
      matched.values[i] = at_place_of(*near, contact.gap);
    else
      matched.values[i].joint.damage = 1.0;
    matched.ids.push_back(id);
  }
  return matched;
}

}  // namespace cupola
