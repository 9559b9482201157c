#pragma once

#include <string>

#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// "fill of 1.25 MN and forces of 328 kN, 4.22 MN in all": what acts downwards besides the weight of the free
/// blocks, at the time shown, and the sum with it; "" if nothing does.
std::string loads_text(const Evaluation& evaluation);

}  // namespace cupola
