#pragma once

#include <string>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// What is certain about a quantity, and what the compliances choose, in one sentence with the numbers. The
/// limits are those that the search proves where they differ from the values attained by more than 0.1 %.
std::string range_sentence(const ForceRange& range);

/// What the ranges hold for and what they leave open, one sentence per item.
std::vector<std::string> range_conditions(const Evaluation& evaluation);

/// The section that leads the report of a range analysis: a table of the ranges, their figure `picture`
/// (HTML), and the sentences. "" without ranges.
std::string ranges_section(const Evaluation& evaluation, const std::string& picture);

}  // namespace cupola
