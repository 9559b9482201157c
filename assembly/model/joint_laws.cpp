#include "assembly/model/joint_laws.hpp"

#include <algorithm>

namespace cupola {

bool Joints::have_strength() const {
  const auto has = [](const JointLawChange& law) {
    return law.tension.value_or(0.0) > 0.0 || law.cohesion.value_or(0.0) > 0.0 || law.compressive_strength;
  };
  const auto has_own = [&](const std::optional<JointLawChange>& law) { return law && has(*law); };
  return strength != JointStrength{} || has_own(bed) || has_own(head) || has_own(herringbone) ||
         has_own(base) || std::ranges::any_of(rings, [&](const RingJoints& group) { return has(group.law); });
}

}  // namespace cupola
