#pragma once

#include <vector>

#include "postproc/figures/gnuplot.hpp"
#include "postproc/tables/csv_file.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// The equilibria of a path (results/path.csv), and their columns.
std::vector<Table::Column> path_columns();
Table path_table(const CsvFile& csv);

/// The times of the equilibria, s: those of a path by a length may fall.
std::vector<double> path_times(const CsvFile& csv);

/// Force against displacement of the control block, and the work dissipated in joints and ties.
Figure path_figure(const Table& path);

}  // namespace cupola
