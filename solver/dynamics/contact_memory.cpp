#include "solver/dynamics/contact_memory.hpp"

#include <tuple>

namespace cupola {

ContactMemories match_memories(const ContactMemories& old, const std::vector<Contact>& contacts) {
  ContactMemories matched;
  matched.ids.reserve(contacts.size());
  matched.blocks.reserve(contacts.size());
  matched.values.resize(contacts.size());
  size_t j = 0;
  for (size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = contacts[i];
    const auto key = std::make_tuple(contact.block_a, contact.block_b, contact.id);
    const auto old_key = [&old](size_t k) {
      return std::make_tuple(old.blocks[k].first, old.blocks[k].second, old.ids[k]);
    };
    while (j < old.ids.size() && old_key(j) < key) ++j;
    if (j < old.ids.size() && old_key(j) == key) matched.values[i] = old.values[j];
    matched.ids.push_back(contact.id);
    matched.blocks.emplace_back(contact.block_a, contact.block_b);
  }
  return matched;
}

}  // namespace cupola
