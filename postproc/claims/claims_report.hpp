#pragma once

#include <string>
#include <vector>

#include "postproc/claims/verdict.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// Claim, number and verdict, one row per claim.
Table claims_table(const std::vector<Claim>& claims, const std::vector<ClaimResult>& results);

/// The same for a terminal, followed by the counts of each verdict.
std::string claims_text(const std::vector<Claim>& claims, const std::vector<ClaimResult>& results);

/// The same as one HTML page that opens anywhere, followed by the figures, whose pictures are those of the
/// runs below `runs`; one that was not made yet is named.
std::string claims_html(const ClaimsFile& file, const std::vector<ClaimResult>& results,
                        const std::string& runs);

}  // namespace cupola
