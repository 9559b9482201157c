#pragma once

#include <optional>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// The uppermost sheets of the stacks that push outwards, the last first: walls have no outside.
std::vector<const Sheet*> pushing_sheets(const Evaluation& evaluation);

/// The cut under the lowest course of the stack of a sheet. Its radial_thrust is the thrust of the stack, of
/// an arch at x > 0 in its own frame.
const RingSum& base_of(const Evaluation& evaluation, const Sheet& sheet);

/// N, the outward thrust of a model: that of the last stack that pushes outwards. None without one, and where
/// a construction has not laid its lowest course.
std::optional<double> outward_thrust(const Evaluation& evaluation);

/// N, the outward thrust of an arch at its other springing; none of other shells and of a half arch.
std::optional<double> thrust_of_other_side(const Evaluation& evaluation, const Sheet& sheet);

}  // namespace cupola
