#pragma once

#include <string>
#include <vector>

#include "assembly/case/case.hpp"

namespace cupola {

/// Reads a case file strictly: `extends` resolved, `--set key.path=value` applied, every key known, every
/// value of the right type and in range. Throws InputError with file, line, column, key path, the rule and
/// the nearest valid key.
Case read_case(const std::string& path, const std::vector<std::string>& set_options = {});

/// Table of every key: path, type, unit, range, default, meaning (`--schema`).
std::string case_schema();

}  // namespace cupola
