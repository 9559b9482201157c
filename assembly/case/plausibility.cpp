#include "assembly/case/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "assembly/case/case_node.hpp"
#include "assembly/case/limit_parameter.hpp"

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

std::vector<std::string> undivided_joints(const Case& scene) {
  const CaseNode* contact = scene.keys->find("contact");
  const bool seeks_stress = scene.analysis.type == AnalysisType::limit &&
                            scene.analysis.limit.parameter == LimitSearch::Parameter::peak_stress &&
                            scene.joints.compliance.per == Compliance::Per::area;
  if ((contact && contact->find("subdivide")) ||
      (!seeks_stress && std::isinf(compressive_strengths(scene.joints).first)))
    return {};
  return {
      "contact.subdivide is not given: an undivided joint with compressive strength, or whose peak stress is "
      "sought, is 20 % too strong where a sixth of it bears, 85 % where a tenth does, and more below, "
      "because "
      "its edge never crushes, and a third too weak where half of it bears; write 8, and double it until the "
      "answer stays"};
}

}  // namespace cupola
