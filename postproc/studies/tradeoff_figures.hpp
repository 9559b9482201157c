#pragma once

#include <vector>

#include "postproc/figures/gnuplot.hpp"
#include "postproc/studies/tradeoff.hpp"

namespace cupola {

/// Error over processor time, both logarithmic: one figure for all knobs, with the Pareto front of the
/// methods, and one figure per knob. Runs that did not reach their requested accuracy are drawn hollow.
std::vector<Figure> tradeoff_figures(const std::vector<TradeoffRow>& rows);

}  // namespace cupola
