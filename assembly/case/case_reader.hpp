#pragma once

#include <string>
#include <vector>

#include "assembly/case/case.hpp"

namespace cupola {

/// Reads a case file: resolves `extends`, applies `--set key.path=value`, and checks that every key is known
/// and every value has the right type and range. Throws InputError with file, line, column, key path, the
/// rule broken and the nearest valid key.
Case read_case(const std::string& path, const std::vector<std::string>& set_options = {});

/// Table of all keys: path, type, unit, range, default, meaning (`--schema`).
std::string case_schema();

}  // namespace cupola
