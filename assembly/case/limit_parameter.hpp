#pragma once

#include "assembly/case/case.hpp"

namespace cupola {

/// The case at one value of the limit parameter. Loads and friction keep their values at time 0. For `spread`
/// the time is the factor on the support displacements.
Case case_at(const Case& scene, double value);

}  // namespace cupola
