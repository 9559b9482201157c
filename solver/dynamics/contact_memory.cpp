#include "solver/dynamics/contact_memory.hpp"

#include <algorithm>
#include <map>

#include "assembly/base/error.hpp"

namespace cupola {

ContactMemories match_memories(const ContactMemories& old, const std::vector<Contact>& contacts) {
  CUPOLA_ASSERT(old.ids.size() == old.values.size());
  const auto same_id = [](const ContactId& id, const Contact& contact) { return id == contact.id; };
  if (std::equal(old.ids.begin(), old.ids.end(), contacts.begin(), contacts.end(), same_id)) return old;
  ContactMemories matched;
  matched.ids.reserve(contacts.size());
  matched.values.resize(contacts.size());
  matched.tie_impulses = old.tie_impulses;
  std::map<ContactId, size_t> index;  // of the old contacts
  for (size_t i = 0; i < old.ids.size(); ++i) index.emplace(old.ids[i], i);
  for (size_t i = 0; i < contacts.size(); ++i) {
    const auto found = index.find(contacts[i].id);
    if (found != index.end()) matched.values[i] = old.values[found->second];
    matched.ids.push_back(contacts[i].id);
  }
  return matched;
}

}  // namespace cupola
