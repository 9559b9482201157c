#pragma once

#include <string>
#include <vector>

#include "postproc/studies/study.hpp"

namespace cupola {

/// The exchange of time for accuracy in words: runs that are missing, one paragraph per reference, one per
/// knob.
std::vector<std::string> study_text(const std::vector<StudyRow>& rows);

}  // namespace cupola
