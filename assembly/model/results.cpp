#include "assembly/model/results.hpp"

#include <algorithm>

namespace cupola {
std::vector<Joint> joints_of(const ContactTable& contacts) {
  const int num_joints =
      contacts.joint.empty() ? 0 : 1 + *std::max_element(contacts.joint.begin(), contacts.joint.end());
  std::vector<Joint> joints(static_cast<size_t>(num_joints));
  for (int i = 0; i < contacts.size(); ++i) {
    CUPOLA_ASSERT(contacts.joint[i] >= 0 && contacts.block_a[i] < contacts.block_b[i]);
    joints[contacts.joint[i]] = {contacts.block_a[i], contacts.block_b[i], contacts.kind[i],
                                 contacts.ring[i]};
  }
  return joints;
}

}  // namespace cupola
