#pragma once

#include <string>

#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// "gives way by sliding (60 % ...) and hinging (40 %): hinges form at 4 joints, 12 joints slide; 90 % of the
/// motion is at ...": of a run with a mechanism, in which members and courses, the largest first; else "".
std::string how_it_gives_way(const Evaluation& evaluation);

}  // namespace cupola
