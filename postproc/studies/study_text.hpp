#pragma once

#include <string>
#include <vector>

#include "postproc/studies/study.hpp"

namespace cupola {

/// What each knob costs and buys, a paragraph per knob, made from the rows alone.
std::vector<std::string> study_text(const std::vector<StudyRow>& rows);

}  // namespace cupola
