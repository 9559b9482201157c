#pragma once

#include <string>

#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// "hinges form at 4 joints, 12 joints slide": of the mechanism of a limit, else "".
std::string joints_that_give_way(const Evaluation& evaluation);

/// Of a run that shows a mechanism: by sliding, hinging or parting, with the share of each in the motion of
/// the joints (MechanismMotion), and at which courses most; "" without one.
std::string how_it_gives_way(const Evaluation& evaluation);

}  // namespace cupola
