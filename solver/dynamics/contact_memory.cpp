#include "solver/dynamics/contact_memory.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

ContactMemories first_memories(const ContactMemories& old, const std::vector<Contact>& contacts) {
  ContactMemories first;
  for (const Contact& contact : contacts) first.ids.push_back(contact.id);
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
  /// Mean damage of the points of the patch; 1 if it is new.
  double damage_of_patch(const ContactId& id) const {
    double sum = 0.0;
    int count = 0;
    for (auto point = first_from(patch_of(id)); point != sorted_.end(); ++point, ++count) {
      if (patch_of(point->first) != patch_of(id)) break;
      sum += memories_.of(point->second).joint.damage;
    }
    return count > 0 ? sum / count : 1.0;
  }

 private:
  using Entry = std::pair<ContactId, size_t>;
  std::vector<Entry>::const_iterator first_from(const ContactId& id) const {
    return std::lower_bound(sorted_.begin(), sorted_.end(), Entry{id, 0});
  }

  const ContactMemories& memories_;
  std::vector<Entry> sorted_;
};

}  // namespace

const ContactMemory& ContactMemories::of(std::size_t contact) const {
  static const ContactMemory first;
  return values.empty() ? first : values[contact];
}

std::vector<ContactMemory>& ContactMemories::stored() {
  values.resize(ids.size());
  return values;
}

ContactMemories match_memories(ContactMemories old, const std::vector<Contact>& contacts) {
  CUPOLA_ASSERT(old.values.empty() || old.ids.size() == old.values.size());
  if (old.as_built) return first_memories(old, contacts);
  const auto same_id = [](const ContactId& id, const Contact& contact) { return id == contact.id; };
  if (std::equal(old.ids.begin(), old.ids.end(), contacts.begin(), contacts.end(), same_id)) return old;
  ContactMemories matched;
  matched.ids.reserve(contacts.size());
  matched.values.resize(contacts.size());
  matched.ties = old.ties;
  matched.as_built = false;
  const OldContacts before(old);
  for (size_t i = 0; i < contacts.size(); ++i) {
    const ContactId& id = contacts[i].id;
    if (const ContactMemory* memory = before.find(id))
      matched.values[i] = *memory;
    else
      matched.values[i].joint.damage = before.damage_of_patch(id);
    matched.ids.push_back(id);
  }
  return matched;
}

}  // namespace cupola
