#pragma once

#include <optional>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/figures/gnuplot.hpp"
#include "postproc/tables/csv_file.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// Result of a staged analysis ring by ring (results/stages.csv), with the heights of the rings.
Table stage_table(const Evaluation& evaluation, const CsvFile& csv);

/// Critical fresh friction of each stage over the height of its ring; none if no stage has one.
std::optional<Figure> stage_figure(const Table& stages);

}  // namespace cupola
