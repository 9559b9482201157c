#pragma once

#include <optional>

#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// The value of the limit parameter that the case itself has; none if it has none.
std::optional<double> value_of_case(const Case& scene);

/// How far the case of a limit analysis is from its limit, as a factor: 2 if half the friction or twice the load is still
/// borne. None without a limit, and where the case has no value to compare.
std::optional<double> factor_of_safety(const Case& scene, const Summary& summary);

}  // namespace cupola
