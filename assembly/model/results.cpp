#include "assembly/model/results.hpp"

#include <algorithm>

#include <fmt/format.h>

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

std::string limit_unit(const std::string& parameter) {
  if (parameter == "tilt") return "degrees";
  if (parameter == "acceleration") return "g";
  return parameter.ends_with("friction") ? "" : "factor";  // load, thickness, spread, joint_extent
}

std::string phrase(const std::string& parameter, double value) {
  const std::string unit = limit_unit(parameter);
  if (unit == "factor") {
    std::string name = parameter;
    std::replace(name.begin(), name.end(), '_', ' ');
    return fmt::format("a {} factor of {:.5g}", name, value);
  }
  return fmt::format("a{} {} of {:.5g}{}{}", parameter.starts_with('a') ? "n" : "", parameter, value,
                     unit.empty() ? "" : " ", unit);
}

}  // namespace cupola
