#pragma once

#include "assembly/case/case.hpp"

namespace cupola {

/// The case at one value of the searched parameter; loads and friction stay as they are at time 0. For
/// `spread` the clock is the factor on the support moves.
Case case_at(const Case& scene, double value);

}  // namespace cupola
