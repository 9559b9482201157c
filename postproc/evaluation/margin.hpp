#pragma once

#include <optional>

#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// The value that the case itself has of `parameter`, of a limit (CriticalValue) or of fresh mortar; none if
/// it has none.
std::optional<double> value_of_case(const Case& scene, const std::string& parameter);

/// How far the case is from the critical value of the run, as a factor: 2 if half the friction or twice the
/// load is still borne. None without a limit, and where the case has no value to compare.
std::optional<double> factor_of_safety(const Case& scene, const Summary& summary);

}  // namespace cupola
