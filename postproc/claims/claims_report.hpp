#pragma once

#include <string>
#include <vector>

#include "postproc/claims/verdict.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// One row per claim: source, claim, number, limits and verdict.
Table claims_table(const std::vector<Claim>& claims, const std::vector<ClaimResult>& results);

/// The table as text for a terminal, followed by the number of claims with each verdict.
std::string claims_text(const std::vector<Claim>& claims, const std::vector<ClaimResult>& results);

/// The table as a self-contained HTML page, followed by the figures with the pictures from the folders
/// `runs`/RUN/post. A picture that does not exist yet is reported by name.
std::string claims_html(const ClaimsFile& file, const std::vector<ClaimResult>& results,
                        const std::string& runs);

}  // namespace cupola
