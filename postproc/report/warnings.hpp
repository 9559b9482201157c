#pragma once

#include <string>
#include <vector>

namespace cupola {

/// A bar for each warning, in their order. Of many that differ only in blocks and numbers, one bar that opens,
/// at the place of the first.
std::string warnings_html(const std::vector<std::string>& warnings);

}  // namespace cupola
