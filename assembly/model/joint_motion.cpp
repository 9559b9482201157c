#include "assembly/model/joint_motion.hpp"

#include <algorithm>

namespace cupola {

void JointSpeeds::add(double normal, double tangential) {
  opening = std::max(opening, normal);
  least_opening = std::min(least_opening, normal);
  if (normal > std::max(kStopped, tangential)) return;
  stays_closed = true;
  sliding = std::max(sliding, tangential);
}

JointMotion JointSpeeds::motion() const {
  if (sliding > kStopped && sliding >= opening) return JointMotion::sliding;
  if (opening <= kStopped) return JointMotion::closed;
  return stays_closed ? JointMotion::hinging : JointMotion::opening;
}

double JointSpeeds::turning() const {
  return stays_closed ? opening - std::clamp(least_opening, 0.0, opening) : opening;
}

}  // namespace cupola
