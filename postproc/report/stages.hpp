#pragma once

#include <optional>
#include <string>

#include "postproc/figures/gnuplot.hpp"
#include "postproc/output/table.hpp"
#include "postproc/wrenches/evaluation.hpp"

namespace cupola {

/// What a staged analysis found ring by ring (results/stages.csv), with the rings' heights; none for other
/// runs.
std::optional<Table> stage_table(const Evaluation& evaluation, const std::string& results_folder);

/// The fresh friction below which each ring slides off the one below, over the height.
Figure stage_figure(const Table& stages);

}  // namespace cupola
