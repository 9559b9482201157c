#pragma once

#include <optional>
#include <string>
#include <utility>

#include "assembly/case/case.hpp"

namespace cupola {

/// The case at one value of the limit parameter. Loads and friction keep their values at time 0. For `spread`
/// the time is the factor on the support displacements.
Case case_at(const Case& scene, double value);

/// Unit vector along the pull of a tilt or an acceleration: the part of `analysis.limit.direction` at right
/// angles to gravity.
Vec3 direction_of_pull(const Case& scene);

/// True for a limit analysis of the weight of a lantern.
bool seeks_lantern(const Analysis& analysis);

/// " of the bed joints of course 1": those whose friction alone the limit varies; "" if of all, or another
/// parameter.
std::string varied_joints(const LimitSearch& limit);

/// "critical friction of the bed joints of course 1": what a limit analysis seeks.
std::string critical_quantity(const LimitSearch& limit);

/// Pa, the least and the greatest compressive strength that the case gives to any joints; infinity: unlimited.
std::pair<double, double> compressive_strengths(const Joints& joints);

/// The value that the case itself has of the limit parameter, of a peak stress its compressive strength. None
/// if it has none: joints that differ in friction or strength or of which only some are varied, a lantern
/// given in newtons; thickness, and friction of joints that bear tension, of which more is not always safer;
/// and none outside the bracket unless more friction, strength or larger joints bear whatever less bears.
std::optional<double> own_value(const Case& scene);

/// "the bracket leaves out the case itself, which has a friction of 0.6"; "" if it does not, or if the case
/// has no such value.
std::string case_outside_bracket(const Case& scene);

}  // namespace cupola
