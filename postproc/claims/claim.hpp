#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assembly/base/named_enum.hpp"

namespace cupola {

/// Rows of a table that count: a column's text equals `is`, or its number lies in [from, to].
struct RowFilter {
  std::string column;
  std::string is;  ///< empty: the range counts
  std::optional<double> from, to;
};

/// How several values become one.
enum class Take : std::uint8_t {
  only,    ///< there must be exactly one value
  mean,    ///< arithmetic mean
  median,  ///< of an even number: mean of the middle two
  largest,
  smallest,
  sum,
  spread,     ///< largest - smallest over the mean's magnitude
  variation,  ///< standard deviation over mean
  rms,        ///< root of the mean square
  linearity,  ///< squared correlation (R2) with the column `against`
  roughness,  ///< mean |second difference| over the mean's magnitude: how wiggly a curve is
};
constexpr auto enum_names(Take) {
  return std::array{"only",   "mean",      "median", "largest",   "smallest", "sum",
                    "spread", "variation", "rms",    "linearity", "roughness"};
}

/// A number drawn from the files of finished runs. One of three sources:
///   key     of results/summary.json or post/summary.json: `results.max_displacement_m`,
///   `post.rings.0.cv_pressure` status  the share of the runs that ended so: 1 when all did table   a CSV of
///   post/ and one of its columns, rows chosen by `where`
/// With `reference` the table's column of that run is subtracted first, row by row. The values of all runs
/// are pooled, in the order given, before `take`.
struct Quantity {
  std::vector<std::string> runs;  ///< names of cases or variants
  std::string key;
  std::string status;
  std::string table, column, against, reference;
  std::vector<RowFilter> where;
  Take take = Take::only;
};

/// A sentence of a publication, with the number that tests it: value, divided by `over` and less `minus`
/// where given, must lie in [at_least, at_most].
struct Claim {
  std::string source;  ///< section and figure
  std::string says;    ///< the sentence
  std::string number;  ///< what the number is, in words
  std::string unit;
  std::string open;  ///< why the text leaves it open: shown, and no verdict is given
  std::string note;  ///< what else a reader should know
  Quantity value;
  std::optional<Quantity> over, minus;
  std::optional<double> at_least, at_most;
};

/// A figure of the publication and the picture of a run that stands for it.
struct ClaimFigure {
  std::string source;   ///< "Fig. 7b"
  std::string shows;    ///< what to look at, in words
  std::string run;      ///< name of a case or variant
  std::string picture;  ///< below the run's folder post/
};

struct ClaimsFile {
  std::string title;  ///< of the publication
  std::vector<Claim> claims;
  std::vector<ClaimFigure> figures;
};

/// Reads a claims file as strictly as a case file.
ClaimsFile read_claims(const std::string& path);

}  // namespace cupola
