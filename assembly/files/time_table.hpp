#pragma once

#include <string>

#include "assembly/model/time_function.hpp"

namespace cupola {

/// Reads two columns of numbers (separated by commas, blanks or tabs; `#` starts a comment) with increasing
/// times. Throws InputError with file and line.
TableInTime read_time_table(const std::string& path);

}  // namespace cupola
