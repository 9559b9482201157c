#pragma once

#include <string>

namespace cupola {

/// A number that a reader looks for first.
struct KeyNumber {
  std::string name;    ///< "Outward thrust"
  std::string value;   ///< with its unit, or a range of values
  std::string detail;  ///< what it means, or between which limits it is certain
};

}  // namespace cupola
