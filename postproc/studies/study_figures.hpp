#pragma once

#include <vector>

#include "postproc/figures/gnuplot.hpp"
#include "postproc/studies/study.hpp"

namespace cupola {

/// Processor time against wrench error, both logarithmic: one figure for all knobs, with the front that no
/// run beats, and one per knob. Runs that did not reach what they asked for are drawn hollow.
std::vector<Figure> study_figures(const std::vector<StudyRow>& rows);

}  // namespace cupola
