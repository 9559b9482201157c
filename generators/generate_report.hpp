#pragma once

#include <string>

#include "assembly/model/assembly.hpp"
#include "generators/generate.hpp"

namespace cupola {

/// The stereotomy report of a model: counts, volumes compared with the smooth shell, errors found by the
/// checks, block sizes by kind and by ring, and the number of convex parts of each imported block.
std::string report_json(const Assembly& assembly, const GenerateReport& report);
std::string report_text(const Assembly& assembly, const GenerateReport& report);

}  // namespace cupola
