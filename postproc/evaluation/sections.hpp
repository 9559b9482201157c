#pragma once

#include <string>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// The sections of the case. `placed`: the blocks where the forces balance; `left_out`: those that a frame of
/// a construction does not hold, empty without one.
std::vector<SectionEvaluation> evaluate_sections(const Evaluation& evaluation, const Assembly& placed,
                                                 const std::vector<bool>& left_out);

/// The courses above the beds of a section: "ring 3", "courses 3, 40", "none".
std::string beds_text(const Shell& shell, const SectionEvaluation& section, const std::string& course);

}  // namespace cupola
