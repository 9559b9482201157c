#pragma once

#include <optional>
#include <string>
#include <vector>

#include "postproc/claims/quantity.hpp"

namespace cupola {

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
  std::string copy;     ///< file of the documentation that is replaced by the picture; empty: none
};

/// The quantities that a claim reads.
std::vector<const Quantity*> quantities(const Claim& claim);

void declare_claim(Section& s, Claim& claim);
void declare_figure(Section& s, ClaimFigure& figure);

/// The runs that claims and figures read, each once, in the order of first use.
std::vector<std::string> needed_runs(const std::vector<Claim>& claims,
                                     const std::vector<ClaimFigure>& figures);

}  // namespace cupola
