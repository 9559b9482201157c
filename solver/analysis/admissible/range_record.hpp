#pragma once

#include <string>
#include <vector>

#include "assembly/model/results.hpp"

namespace cupola {

/// The table ranges.csv.
std::string ranges_csv(const std::vector<ForceRange>& ranges);

/// The sentence that leads: the first quantity, and what was not found.
std::string describe(const std::vector<ForceRange>& ranges);

}  // namespace cupola
