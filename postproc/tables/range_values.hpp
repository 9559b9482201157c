#pragma once

#include <string>
#include <vector>

#include "assembly/model/results.hpp"
#include "postproc/mechanics/joint_wrenches.hpp"
#include "postproc/tables/csv_file.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// Ends of a range as the states found attain them: infinite if unbounded, NaN if no state was found.
double least(const ForceRange& range);
double greatest(const ForceRange& range);

/// True if the compliances chose one of the states.
bool has_chosen(const std::vector<ForceRange>& ranges);

/// Largest size of the finite values of a range, in its unit; 0 without any.
double size_of(const ForceRange& range);

/// Width of a range over the magnitude of its mean: 0 for a certain value, 2 for one between 0 and a maximum.
/// Infinite if unbounded; NaN if an end was not found or both are zero.
double relative_range(const ForceRange& range);

/// Distance of the chosen value from the nearer end, over the width: 0 at an end, 0.5 in the middle. NaN
/// without a chosen value or two bounded ends.
double margin_of(const ForceRange& range);

/// relative_range() of the normal force of each joint; NaN for joints without a range; empty if none has one.
std::vector<double> relative_ranges(const std::vector<ForceRange>& ranges,
                                    const std::vector<JointWrench>& joints);

/// The range of a quantity; null if there is none.
const ForceRange* range_named(const std::string& quantity, const std::vector<ForceRange>& ranges);

/// The ranges in results/ranges.csv or post/ranges.csv.
std::vector<ForceRange> read_ranges(const CsvFile& csv);

/// The first range of each quantity that any of several runs has, in the order of their appearance.
std::vector<ForceRange> quantities_of(const std::vector<std::vector<ForceRange>>& runs);

/// Appends minimum, chosen value and maximum of each quantity to a table with one row per run, in SI units:
/// columns such as "thrust_min_N" and "share_of_the_ribs_chosen".
void add_range_columns(const std::vector<std::vector<ForceRange>>& runs, Table* table);

}  // namespace cupola
