#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assembly/base/named_enum.hpp"

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
};
constexpr auto enum_names(Take) {
  return std::array{"only",   "mean",      "median", "largest",   "smallest", "sum",
                    "spread", "variation", "rms",    "linearity", "roughness"};
}

/// A number taken from the files of finished runs. It has exactly one of three sources:
///
///   key     an entry of results/summary.json or post/summary.json: `results.max_displacement_m`,
///           `post.rings.0.cv_pressure`
///   status  the share of the runs that ended with this status, from 0 to 1
///   table   a CSV file of post/ and one of its columns, with the rows chosen by `where`
///
/// With `reference`, the same column of that run is subtracted first, row by row. The values of all runs are
/// pooled in the order of `runs` and then reduced by `take`.
struct Quantity {
  std::vector<std::string> runs;  ///< names of cases or variants
  std::string key;
  std::string status;
  std::string table, column, against, reference;
  std::vector<RowFilter> where;
  Take take = Take::only;
};

/// A statement of a publication and the number that tests it. The statement holds if
///
///   at_least <= value / over - minus <= at_most
///
/// where `over`, `minus` and either limit may be absent.
struct Claim {
  std::string source;  ///< section and figure
  std::string says;    ///< the statement
  std::string number;  ///< the number in words
  std::string unit;
  std::string open;  ///< replaces the verdict: why there are no limits, or what the number means
  std::string note;  ///< remark for the reader
  Quantity value;
  std::optional<Quantity> over, minus;
  std::optional<double> at_least, at_most;
};

/// A figure of the publication and the corresponding picture of a run.
struct ClaimFigure {
  std::string source;   ///< "Fig. 7b"
  std::string shows;    ///< caption
  std::string run;      ///< name of a case or variant
  std::string picture;  ///< path below the run's folder post/
};

struct ClaimsFile {
  std::string title;  ///< of the publication
  std::vector<Claim> claims;
  std::vector<ClaimFigure> figures;
};

/// Reads a claims file with the strict reader of case files; throws InputError with line and key.
ClaimsFile read_claims(const std::string& path);

}  // namespace cupola
