#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assembly/base/named_enum.hpp"
#include "postproc/claims/claim.hpp"

namespace cupola {

/// Outcome of a claim. A statement of the publication is reproduced or not; one of our own holds or does not.
enum class Verdict : std::uint8_t {
  reproduced,
  not_reproduced,
  holds,
  does_not_hold,
  not_solved,  ///< a run did not reach its requested accuracy, so its numbers are not used
  open,        ///< the claim has no limits: the number is shown without a verdict
  not_run,     ///< a run has no results yet
};
constexpr auto enum_names(Verdict) {
  return std::array{"reproduced", "not reproduced", "holds", "does not hold", "not reproduced: not solved",
                    "open",       "not run"};
}

struct ClaimResult {
  Verdict verdict = Verdict::not_run;
  std::optional<double> number;  ///< with `each_run` the mean over the runs
  std::vector<double> numbers;   ///< one per run with `each_run`, otherwise one; empty without a number
  std::string reason;            ///< the runs that are missing or not solved, or outside the limits
  std::string note;              ///< of the claim, with its values filled in
};

/// Evaluates the claims on the finished runs in the folders `out`/RUN, in the order of `claims`. Throws
/// InputError if a finished run lacks a key, table or column that a claim reads.
std::vector<ClaimResult> evaluate_claims(const std::vector<Claim>& claims, const std::string& out);

}  // namespace cupola
