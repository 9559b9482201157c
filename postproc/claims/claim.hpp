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

/// Limits of a claim, from the publication or chosen here.
struct ClaimLimits {
  std::optional<double> at_least, at_most;
  std::string reason;  ///< why these numbers; only for limits chosen here
};

/// A number that the note of a claim shows: value / over.
struct NamedQuantity {
  std::string name;  ///< in the note: {name}
  Quantity value;
  std::optional<Quantity> over;
};

/// A statement and the number that tests it. The statement holds if
///
///   at_least <= value / over - minus <= at_most
///
/// where `over`, `minus` and either limit may be absent. Limits that the publication states are in `paper`,
/// those chosen here in `ours`; both apply. With `each_run` the number is evaluated for every run of `value`
/// by itself, e.g. for every seed, and the statement holds if it holds for every run.
struct Claim {
  std::string source;  ///< section and figure
  std::string quote;   ///< sentence of the publication, word for word; empty for a statement of our own
  std::string says;    ///< the statement
  std::string number;  ///< the number in words
  std::string unit;
  /// Remark in which {value}, {over}, {minus}, {message} (of the solver, first run) and the names in `also`
  /// stand for values. It contains no digits, so that every number comes from the runs.
  std::string note;
  bool open = false;  ///< no limits: the number is shown without a verdict
  bool each_run = false;
  Quantity value;
  std::optional<Quantity> over, minus;
  std::vector<NamedQuantity> also;
  ClaimLimits paper, ours;
};

/// Names of the placeholders {name} in a text, in order.
std::vector<std::string> placeholders(const std::string& text);

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
