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

/// The table as part of an HTML page, with its style.
std::string claims_html(const std::vector<Claim>& claims, const std::vector<ClaimResult>& results);

/// The figures with the pictures from the folders `runs`/RUN/post, below a heading; "" if there are none. A
/// picture that does not exist yet is reported by name.
std::string figures_html(const std::vector<ClaimFigure>& figures, const std::string& runs);

}  // namespace cupola
