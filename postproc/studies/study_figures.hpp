#pragma once

#include <vector>

#include "postproc/figures/gnuplot.hpp"
#include "postproc/studies/study.hpp"

namespace cupola {

/// Error over processor time, both logarithmic: one figure for all knobs, with the Pareto front of the
/// methods, and one figure per knob. Runs that did not reach their requested accuracy are drawn hollow.
std::vector<Figure> study_figures(const std::vector<StudyRow>& rows);

}  // namespace cupola
