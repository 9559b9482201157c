#pragma once

#include <optional>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/figures/gnuplot.hpp"
#include "postproc/tables/csv_file.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// What a staged analysis found ring by ring (results/stages.csv), with the rings' heights.
Table stage_table(const Evaluation& evaluation, const CsvFile& csv);

/// The fresh friction below which each ring slides off the one below, over the height; none where the case
/// did not ask for it.
std::optional<Figure> stage_figure(const Table& stages);

}  // namespace cupola
