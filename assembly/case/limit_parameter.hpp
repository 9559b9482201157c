#pragma once

#include <optional>
#include <string>

#include "assembly/case/case.hpp"

namespace cupola {

/// The case at one value of the limit parameter. Loads and friction keep their values at time 0. For `spread`
/// the time is the factor on the support displacements.
Case case_at(const Case& scene, double value);

/// " of the bed joints of course 1": those whose friction alone the limit varies; "" if of all, or another
/// Unit vector along the pull of a tilt or an acceleration: the part of `analysis.limit.direction` at right
/// angles to gravity.
Vec3 direction_of_pull(const Case& scene);

/// True for a limit analysis of the weight of a lantern.
bool seeks_lantern(const Analysis& analysis);

/// parameter.
std::string varied_joints(const LimitSearch& limit);

/// The value that the case itself has of the limit parameter. None if it has none: joints that differ in
/// friction or of which only some are varied, a lantern given in newtons; thickness, peak stress, and friction
/// of joints that bear tension, of which more is not always safer; and none outside the bracket unless more
/// friction or larger joints bear whatever less bears.
std::optional<double> own_value(const Case& scene);

}  // namespace cupola
