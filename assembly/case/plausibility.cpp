#include "assembly/case/plausibility.hpp"

#include <optional>

#include <fmt/format.h>

namespace cupola {
namespace {

/// Tension that joints never reach, because friction is exhausted before. `key` ends in a dot.
std::optional<std::string> unused_tension(const std::string& key, double friction, double cohesion,
                                          double tension) {
  if (friction == 0.0 || tension <= cohesion / friction) return std::nullopt;
  return fmt::format(
      "{}tension = {:g} Pa exceeds cohesion / friction = {:g} Pa, at which a joint has no shear "
      "strength left; the smaller value applies",
      key, tension, cohesion / friction);
}

}  // namespace

std::vector<std::string> unused_tensions(const Joints& joints) {
  const JointStrength& all = joints.strength;
  std::vector<std::string> found;
  const auto add = [&](const std::string& key, const JointLawChange& law) {
    const bool own = law.friction || law.cohesion || law.tension;
    const auto unused =
        unused_tension(key, law.friction.value_or(joints.friction), law.cohesion.value_or(all.cohesion),
                       law.tension.value_or(all.tension));
    if (own && unused) found.push_back(*unused);
  };
  if (const auto unused = unused_tension("joints.", joints.friction, all.cohesion, all.tension))
    found.push_back(*unused);
  for (const auto& [key, law] : joints.kinds()) add(fmt::format("joints.{}.", key), *law);
  for (size_t i = 0; i < joints.rings.size(); ++i)
    add(fmt::format("joints.rings[{}].", i), joints.rings[i].law);
  return found;
}

}  // namespace cupola
