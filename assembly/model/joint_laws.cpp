#include "assembly/model/joint_laws.hpp"

#include <algorithm>

namespace cupola {

bool Joints::have_strength() const {
  const auto has = [](const JointLawChange& law) {
    return law.tension.value_or(0.0) > 0.0 || law.cohesion.value_or(0.0) > 0.0 || law.compressive_strength;
  };
  return strength != JointStrength{} ||
         std::ranges::any_of(kinds(), [&](const auto& kind) { return has(*kind.second); }) ||
         std::ranges::any_of(rings, [&](const RingJoints& group) { return has(group.law); });
}

std::vector<std::pair<const char*, const JointLawChange*>> Joints::kinds() const {
  std::vector<std::pair<const char*, const JointLawChange*>> own;
  const auto add = [&](const char* key, const std::optional<JointLawChange>& law) {
    if (law) own.emplace_back(key, &*law);
  };
  add("bed", bed);
  add("head", head);
  add("herringbone", herringbone);
  add("base", base);
  add("wythe", wythe);
  add("pieces", pieces);
  return own;
}

}  // namespace cupola
