#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "postproc/claims/claim.hpp"

namespace cupola {

enum class Verdict : std::uint8_t {
  reproduced,
  not_reproduced,
  open,        ///< the text leaves it open: the number stands alone
  not_solved,  ///< a run did not reach the accuracy it asked for: its numbers prove nothing
  not_run,     ///< a run has no results yet
};
std::string to_string(Verdict verdict);

struct ClaimResult {
  Verdict verdict = Verdict::not_run;
  std::optional<double> number;
  std::string reason;  ///< the runs that are missing or not solved
};

/// Evaluates the claims, in their order, on the folders `out/RUN` that Makefile.cases fills. A key, table or
/// column that a finished run does not have is an InputError.
std::vector<ClaimResult> evaluate_claims(const std::vector<Claim>& claims, const std::string& out);

/// Every run that the claims and the figures draw on, once, in the order of first use.
std::vector<std::string> needed_runs(const ClaimsFile& file);

/// Reduces values, which must not be empty; `against` serves linearity.
double reduce(Take take, const std::vector<double>& values, const std::vector<double>& against = {});

}  // namespace cupola
