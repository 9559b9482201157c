#pragma once

#include <optional>
#include <string>

#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// The joint nearest to sliding, and the one that is nearest to a hinge, as indices into the joints
/// of the frame evaluated. None without loaded joints.
struct WorstJoints {
  std::optional<size_t>
      sliding;  ///< largest friction use; of those that use all of it, the largest normal force
  std::optional<size_t> edge;  ///< largest kern utilisation; a line is all edge
};
WorstJoints worst_joints(const JointWrenches& joints);

/// True if a contact point of a joint bears a force across its normal, even if others balance it.
bool uses_friction(const Evaluation& evaluation, const JointWrench& joint);

/// The joints that slide and open the fastest in a mechanism, or the farthest in a motion in time.
struct MovingJoints {
  struct Joint {
    size_t index = 0;
    double motion = 0.0;  ///< share of the speed of the fastest block; in time: m
  };
  Joint sliding, opening;
};
/// None of a run at rest or without a verdict, and of a mechanism without joints.
std::optional<MovingJoints> moving_joints(const Evaluation& evaluation);

/// The worst joints as an HTML list with links into the 3-D view; "" if there are none.
std::string worst_joints_html(const Evaluation& evaluation);

}  // namespace cupola
