#pragma once

#include <string>

#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// What acts downwards: "110 kN", or "64 kN of 110 kN" where `loads.dead_load_time` or a tilt lets a part act.
std::string weight_text(const Evaluation& evaluation);

/// "fill of 1.25 MN and forces of 328 kN, 4.22 MN in all; horizontal loads of 42 kN, 0.014 of the weight":
/// what acts besides the weight of the free blocks at the time shown, the sum of the first with it; "" if
/// nothing does. `shown`: has the loads of that time.
std::string loads_text(const Evaluation& evaluation, const FrameEvaluation& shown);
inline std::string loads_text(const Evaluation& evaluation) {
  return loads_text(evaluation, evaluation.last);
}

/// "ties and restraints": which of them carry forces; "" if none does.
std::string acting_ties(const Evaluation& evaluation);

/// What carries the blocks: "joint forces, ties and restraints".
std::string carriers_text(const Evaluation& evaluation);

/// What a verdict assumes of them: "the ties and their yield forces, the restraints"; "" without any.
std::string assumed_ties(const Evaluation& evaluation);

/// "pulled towards +x; other directions are not computed": of the limit of a tilt or an acceleration; else "".
std::string direction_of_limit(const Case& scene);

/// "a coefficient of friction of 0.7", "coefficients of friction of 0.4 to 0.7".
std::string friction_text(const Joints& joints);

}  // namespace cupola
