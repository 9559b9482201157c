#pragma once

#include <string>

#include "assembly/model/assembly.hpp"
#include "generators/generate.hpp"

namespace cupola {

/// The stereotomy report of a model: counts, volumes against the smooth shell, errors of the checks, the
/// sizes of the blocks by kind and by ring, and for imported blocks what was done to each.
std::string report_json(const Assembly& assembly, const GenerateReport& report);
std::string report_text(const Assembly& assembly, const GenerateReport& report);

}  // namespace cupola
