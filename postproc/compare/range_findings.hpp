#pragma once

#include <string>
#include <vector>

#include "postproc/tables/post_summary.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// For each quantity that two or more runs have a range of, one sentence: the ranges, and where it is
/// narrowest.
std::vector<std::string> range_findings(const std::vector<PostSummary>& runs,
                                        const std::vector<std::string>& labels);

/// The ranges of each run.
std::vector<std::vector<ForceRange>> ranges_of(const std::vector<PostSummary>& runs);

/// Appends a row for each quantity to a table with a column per run.
void add_range_rows(const std::vector<PostSummary>& runs, Table* table);

}  // namespace cupola
