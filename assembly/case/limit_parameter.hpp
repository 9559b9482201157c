#pragma once

#include <optional>

#include "assembly/case/case.hpp"

namespace cupola {

/// The case at one value of the limit parameter. Loads and friction keep their values at time 0. For `spread`
/// the time is the factor on the support displacements.
Case case_at(const Case& scene, double value);

/// The value that the case itself has of the limit parameter. None if it has none: joints that differ in
/// friction, a lantern given in newtons, thickness and peak stress, of which more is not always safer; and
/// none outside the bracket unless more friction or larger joints bear whatever less bears.
std::optional<double> own_value(const Case& scene);

}  // namespace cupola
