#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cupola {

/// A number that a reader looks for first.
struct KeyNumber {
  std::string name;                  ///< "Outward thrust"
  std::string value;                 ///< with its unit, or a range of values
  std::vector<std::string> details;  ///< what it means, where, and how certain it is: a clause each

  /// In one line.
  std::string detail() const { return fmt::format("{}", fmt::join(details, "; ")); }
};

}  // namespace cupola
