#include "solver/dynamics/contact_memory.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

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

/// Mean damage of the points of each patch.
class PatchDamage {
 public:
  explicit PatchDamage(const ContactMemories& memories) {
    for (size_t i = 0; i < memories.ids.size(); ++i) {
      auto& [sum, count] = patches_[patch_of(memories.ids[i])];
      sum += memories.of(i).joint.damage;
      ++count;
    }
  }
  /// 1 if the patch is new.
  double at(const ContactId& id) const {
    const auto found = patches_.find(patch_of(id));
    return found == patches_.end() ? 1.0 : found->second.first / found->second.second;
  }

 private:
  std::map<ContactId, std::pair<double, int>> patches_;
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
  std::map<ContactId, size_t> index;  // of the old contacts
  for (size_t i = 0; i < old.ids.size(); ++i) index.emplace(old.ids[i], i);
  std::optional<PatchDamage> damage;
  for (size_t i = 0; i < contacts.size(); ++i) {
    const auto found = index.find(contacts[i].id);
    if (found != index.end()) {
      matched.values[i] = old.of(found->second);
    } else {
      if (!damage) damage.emplace(old);
      matched.values[i].joint.damage = damage->at(contacts[i].id);
    }
    matched.ids.push_back(contacts[i].id);
  }
  return matched;
}

}  // namespace cupola
