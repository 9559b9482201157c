#pragma once

#include <string>
#include <vector>

namespace cupola {

/// A bar for each warning, in their order. Of many that differ only in blocks and numbers, one bar that opens,
/// at the place of the first.
std::string warnings_html(const std::vector<std::string>& warnings);

/// The same for the terminal, a line each: of many alike the first and their number.
std::vector<std::string> warning_lines(const std::vector<std::string>& warnings);

}  // namespace cupola
