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

std::pair<double, double> Joints::friction_range() const {
  std::pair range{friction, friction};
  const auto include = [&range](const JointLawChange& law) {
    range.first = std::min(range.first, law.friction.value_or(range.first));
    range.second = std::max(range.second, law.friction.value_or(range.second));
  };
  for (const auto& kind : kinds()) include(*kind.second);
  for (const RingJoints& group : rings) include(group.law);
  return range;
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
