#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assembly/base/named_enum.hpp"
#include "assembly/case/section.hpp"
#include "postproc/tables/run_files.hpp"

namespace cupola {

/// Selects rows of a table: the text of the column equals `is`, or its number lies in [from, to].
struct RowFilter {
  std::string column;
  std::string is;  ///< empty: the range applies
  std::optional<double> from, to;
};

/// Reduces several values to one.
enum class Take : std::uint8_t {
  only,    ///< requires exactly one value
  mean,    ///< arithmetic mean
  median,  ///< for an even count the mean of the two middle values
  largest,
  smallest,
  sum,
  spread,     ///< (largest - smallest) / |mean|
  variation,  ///< coefficient of variation: standard deviation / |mean|
  rms,        ///< root mean square
  linearity,  ///< squared correlation coefficient (R2) with the column `against`
  roughness,  ///< mean |second difference| / |mean|; 0 on a straight line with even spacing
  first,      ///< row of the table
  last,
  count,  ///< of the rows
};
constexpr auto enum_names(Take) {
  return std::array{"only",      "mean", "median",    "largest",   "smallest", "sum",  "spread",
                    "variation", "rms",  "linearity", "roughness", "first",    "last", "count"};
}

/// A number taken from the files of finished runs. It has exactly one of three sources:
///
///   key     an entry of results/summary.json or post/summary.json, or a key of the case in force:
///           `results.max_displacement_m`, `post.rings.0.cv_pressure`, `case.joints.friction`
///   status  the share of the runs that ended with this status, from 0 to 1
///   table   a CSV file of post/, or `results/NAME` of results/, and one of its columns, with the rows chosen
///           by `where`
///
/// With `reference`, the same column of that run is subtracted first, row by row. The values of all runs are
/// pooled in the order of `runs` and then reduced by `take`. The sum and the count of no rows are 0.
struct Quantity {
  std::vector<std::string> runs;  ///< names of cases or variants
  std::string key;
  std::string status;
  std::string table, column, against, reference;
  std::vector<RowFilter> where;
  Take take = Take::only;
};

/// Declares the keys of a quantity, of which `runs` is required.
void declare_quantity(Section& s, Quantity& quantity);
/// The same for a column of a table with one row per run: `runs` defaults to `{run}`, the run of the row.
void declare_row_quantity(Section& s, Quantity& quantity);

/// The words of a text, separated by spaces.
std::vector<std::string> words(const std::string& text);

/// The runs that a quantity reads, including its reference.
std::vector<std::string> runs_of(const Quantity& quantity);

/// The number. Throws InputError if a run lacks the key, table or column, if `where` selects no row, or if
/// several values are not reduced.
double evaluate(const Quantity& quantity, RunCache& cache);

/// Reduces `values` to one number; they must not be empty, except for sum and count. `against` is read by
/// Take::linearity only and has then the same size as `values`.
double reduce(Take take, const std::vector<double>& values, const std::vector<double>& against = {});

}  // namespace cupola
