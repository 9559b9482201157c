#pragma once

#include "assembly/case/sweep.hpp"
#include "postproc/figures/gnuplot.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// The results of a sweep over its first key: one panel per number that varies, at most four, and one curve
/// per combination of the values of the other keys. Filled points: the case stands. Without commands if the
/// values of that key are not numbers, or no result varies. The table as a page shows it: lengths below one
/// metre in mm, forces in kN or MN, and of status and verdict the verdict.
Table in_readable_units(Table table);

Figure sweep_figure(const std::vector<SweptKey>& sweep, const Table& table);

}  // namespace cupola
